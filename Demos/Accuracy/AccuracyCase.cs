using System;

namespace Demos.Accuracy;

/// <summary>A case of the suite: a scene whose truth is known, at one effort.</summary>
/// <param name="Id">The family, as C5.</param>
/// <param name="Scene">What is simulated.</param>
/// <param name="Effort">What the run pays; null for a case that is about settings of its own.</param>
/// <param name="Run">Simulates it with settings and adds figures to a result.</param>
sealed record AccuracyCase(string Id, string Scene, Effort? Effort, Action<AccuracySettings, CaseResult> Run)
{
    /// <summary>How it is simulated: those of the effort, if the case is not about others.</summary>
    public AccuracySettings Settings { get; init; } = AccuracySettings.For(Effort ?? Accuracy.Effort.Default);

    /// <summary>Whether the case is about how rotation is integrated, so that its row says it.</summary>
    public bool ShowsAngularMode { get; init; }

    public string SettingsText => ShowsAngularMode ? $"{Settings} {Settings.AngularMode}" : Settings.ToString();

    public string Name => $"{Id} {Scene}, {SettingsText}";

    /// <summary>Simulates it.</summary>
    public CaseResult Measure()
    {
        var result = new CaseResult(Id, Scene, SettingsText);
        Run(Settings, result);
        return result;
    }
}
