using System;
using System.Diagnostics.CodeAnalysis;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics.Constraints.Contact;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// A parent with one child that has nobody to agree with: its child waits for a test, and what that finds becomes a patch as soon as it is found. It needs
/// neither memory of its own nor a place where its child finds it.
/// </summary>
struct LoneChild
{
    // The patch comes first, as in the results of other parents.
    ChildResult patch;
    /// <summary>What the test has found.</summary>
    public ChildResult Child;
    /// <summary>Position of the parent's B less that of its A.</summary>
    public Vector3 OffsetB;
    /// <summary>Id that the parent was added with.</summary>
    public int PairId;
    /// <summary>Number of contacts from which on they may be carried along while the shapes hardly move.</summary>
    public int LeastCarriedContactCount;

    /// <summary>Begins anew; the manifold is the test's to write.</summary>
    /// <param name="pair">The parent.</param>
    /// <param name="ids">The child.</param>
    /// <param name="keepsHistory">Whether its test keeps a history.</param>
    /// <param name="shapes">Its shapes.</param>
    public void Begin(in ParentPair pair, ChildIds ids, bool keepsHistory, in ChildShapes shapes)
    {
        Child.Children = ids;
        Child.KeepsHistory = keepsHistory;
        Child.IsLeftToNeighbours = false;
        Child.Lever = FaceLever.OfOneFace;
        Child.OffsetA = shapes.OffsetA;
        OffsetB = pair.OffsetB;
        PairId = pair.PairId;
        LeastCarriedContactCount = PlacedChildren.IsRound(pair.NameA.Type) || PlacedChildren.IsRound(pair.NameB.Type)
            ? 1 : PlacedChildren.FindLeastCarriedContactCount(shapes.TypeA, shapes.TypeB);
    }

    /// <summary>Whether the contacts may be carried along.</summary>
    public readonly bool MayCarry => Child.Manifold.Count >= LeastCarriedContactCount;

    /// <summary>Makes a patch of the contacts, of which there are some.</summary>
    /// <param name="known">Patches of the last step.</param>
    public void BuildPatch(in KnownPatches known) => PatchSet.BuildOfOne(ref Child, known, ref patch);

    /// <summary>The patch, if there is one, and the child.</summary>
    /// <param name="hasPatch">Whether there is one.</param>
    [UnscopedRef]
    public Span<ChildResult> Results(bool hasPatch) => hasPatch
        ? MemoryMarshal.CreateSpan(ref patch, 2)
        : MemoryMarshal.CreateSpan(ref Child, 1);
}
