namespace BepuPhysics.Constraints;

/// <summary>What is left to be done to the columns of a type batch, while that is deferred. It goes with the type batch when that is emptied.</summary>
struct PendingColumns
{
    /// <summary>One more than the index of the first move; 0 where there is none.</summary>
    public int FirstMove;
    /// <summary>One more than the index of the last move.</summary>
    public int LastMove;
    /// <summary>Whether a bundle came into use, in which some lanes may have been written by nobody.</summary>
    public bool HasNewBundle;
    /// <summary>Whether the type batch is in the list of those in which something is left to be done.</summary>
    public bool IsListed;
    /// <summary>Of a listed type batch, how many of its bundles held something before: what has been added since is not written yet.</summary>
    public int WrittenBundleCount;
}
