using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace BepuPhysics.CollisionDetection;

/// <summary>Which child of A touches which child of B, zero for a shape that has none; or a patch of several.</summary>
readonly record struct ChildIds(int A, int B)
{
    const int PatchMark = -2;

    /// <summary>Those of two convex shapes, which have no children.</summary>
    public static ChildIds None => new(-1, -1);

    /// <summary>A patch of a pair, by a number that it keeps.</summary>
    public static ChildIds Patch(int number) => new(PatchMark, number);

    /// <summary>Whether this is a patch; <see cref="B"/> is its number.</summary>
    public bool IsPatch => A == PatchMark;

    /// <summary>What the order of all patches is below.</summary>
    public static ulong EndOfPatches => new ChildIds(PatchMark + 1, 0).Order;

    /// <summary>Number by which the manifolds of a pair are in order: patches, then children.</summary>
    public ulong Order => (ulong)((uint)A ^ 1u << 31) << 32 | (uint)B;

    /// <summary>A feature of these children, which those of others do not have as far as 32 bits can tell.</summary>
    public int Mix(int featureId) => featureId ^ CollidablePairComparer.Hash((uint)A, (uint)B);
}

/// <summary>Feature ids of up to four contacts.</summary>
[InlineArray(4)]
struct FeatureIds
{
    int first;
}

/// <summary>What is remembered of a manifold: contacts that share a normal, in one contact constraint.</summary>
struct CachedManifold
{
    /// <summary>The contact constraint; means nothing where there is none.</summary>
    public ConstraintHandle Constraint;
    /// <summary>Type id of that constraint, which tells the number of contacts; <see cref="NoConstraint"/> where there is none.</summary>
    public int ConstraintTypeId;
    /// <summary>Feature ids of the contacts, by which impulses find their contacts from step to step.</summary>
    public FeatureIds Features;
    /// <summary>Index of the history of the two convex shapes; negative for shapes whose test keeps none.</summary>
    public int History;

    /// <summary>Type id of a manifold without contacts.</summary>
    public const int NoConstraint = -1;

    /// <summary>A manifold without contacts and history.</summary>
    public static CachedManifold Empty => new() { ConstraintTypeId = NoConstraint, History = PairInput.NoHistory };

    /// <summary>Whether there are contacts.</summary>
    public readonly bool HasConstraint => ConstraintTypeId >= 0;
}

/// <summary>One manifold of a pair of shapes of which one at least is made of children: a patch, or two children with their history.</summary>
// As large as a cache line, so that none lies across two.
[StructLayout(LayoutKind.Sequential, Size = 64)]
struct ChildManifold
{
    public CachedManifold Manifold;
    public ChildIds Children;
    /// <summary>Index of the pair's next manifold, in their order; <see cref="PairRecords{T}.None"/> after the last.</summary>
    public int Next;
    /// <summary>What a patch is found by in the next step.</summary>
    public PatchMemory Patch;
}

/// <summary>What is remembered of a pair that has contacts, or a history: one manifold, or a list of them.</summary>
// 32 bytes, so that none lies across two cache lines.
struct CachedPair
{
    /// <summary>
    /// The manifold of a pair of convex shapes. Of other pairs the type id says that they are such, and the history is that of the pair as a whole.
    /// </summary>
    public CachedManifold Single;
    /// <summary>Index of the first of several manifolds; <see cref="PairRecords{T}.None"/> where there is none.</summary>
    public int FirstManifold;

    // This, less one for each manifold that has contacts: whoever looks for a type or for no contacts finds neither.
    const int Several = CachedManifold.NoConstraint - 1;

    /// <summary>A pair without manifolds.</summary>
    /// <param name="ofChildren">Whether its manifolds are those of children.</param>
    public CachedPair(bool ofChildren)
    {
        Single = CachedManifold.Empty;
        if (ofChildren)
            Single.ConstraintTypeId = Several;
    }

    /// <summary>Whether the manifolds are those of children, in a list.</summary>
    public readonly bool IsOfChildren => Single.ConstraintTypeId <= Several;

    /// <summary>Of a pair with manifolds of children: number of patches in its history that may be carried along.</summary>
    // Of none there is nothing to be read. Where features of a single manifold would be.
    public int CarriedPatchCount
    {
        readonly get => Single.Features[0];
        set => Single.Features[0] = value;
    }

    /// <summary>Number of manifolds of children that have contacts.</summary>
    public int ChildConstraintCount
    {
        readonly get => Several - Single.ConstraintTypeId;
        set => Single.ConstraintTypeId = Several - value;
    }
}
