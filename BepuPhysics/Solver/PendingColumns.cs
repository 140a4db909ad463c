namespace BepuPhysics.Constraints;

/// <summary>What is left to be done in a type batch, while that is deferred. It goes with the type batch when that is emptied.</summary>
struct PendingColumns
{
    /// <summary>One more than the index of the first change; 0 where there is none.</summary>
    public int FirstChange;
    /// <summary>One more than the index of the last change.</summary>
    public int LastChange;
    /// <summary>Number of constraints before the first change: those are in their places, and no others.</summary>
    public int ConstraintCount;
    /// <summary>Whether the type batch is in the list of those in which something is left to be done.</summary>
    public bool IsListed;
}
