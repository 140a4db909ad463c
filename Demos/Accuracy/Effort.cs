namespace Demos.Accuracy;

/// <summary>What a run pays. Both are judged by the same limits.</summary>
public enum Effort
{
    /// <summary>What a game gets without thinking about it.</summary>
    Default,

    /// <summary>Sixteen relaxed substeps, the angular mode that conserves, contacts and joints as stiff as they go.</summary>
    Accurate,
}
