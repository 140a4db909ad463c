using System;

namespace Demos.Accuracy;

/// <summary>A case of the suite: a scene whose truth is known, at one effort.</summary>
/// <param name="Id">The family, as C5.</param>
/// <param name="Scene">What is simulated.</param>
/// <param name="Effort">What the run pays.</param>
/// <param name="Run">Simulates it with settings and adds figures to a result.</param>
sealed record AccuracyCase(string Id, string Scene, Effort Effort, Action<AccuracySettings, CaseResult> Run)
{
    public string Name => $"{Id} {Scene}, {Effort}";

    /// <summary>Simulates it.</summary>
    public CaseResult Measure()
    {
        AccuracySettings settings = AccuracySettings.For(Effort);
        var result = new CaseResult(Id, Scene, settings);
        Run(settings, result);
        return result;
    }
}
