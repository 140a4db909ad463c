using System.Diagnostics;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>How the two bodies of a pair move.</summary>
/// <param name="A">Velocity of A.</param>
/// <param name="B">Velocity of B.</param>
/// <param name="MaximumExpansion">Greatest distance by which these expand the bounds of children, m.</param>
record struct PairMotion(BodyVelocity A, BodyVelocity B, float MaximumExpansion);

/// <summary>A pair that is to be expanded, in the order of the caller.</summary>
struct ParentPair
{
    public Vector3 OffsetB;
    public Quaternion OrientationA, OrientationB;
    public PairMotion Motion;
    public float SpeculativeMargin;
    public int PairId;
    /// <summary>Whether the caller's A is of the second type of the task.</summary>
    public bool Flipped;
    /// <summary>Names of the two shapes; none for those that are not in <see cref="Shapes"/>.</summary>
    public TypedIndex NameA, NameB;
}

/// <summary>Two children of a parent that may touch, by the index of the parent in its batch.</summary>
struct FoundChild(int parent, ChildIds children)
{
    public int Parent = parent;
    public ChildIds Children = children;
    /// <summary>Whether one is inside of the other's solid, and is to meet the way out in place of a triangle.</summary>
    public bool LeadsOut;
    /// <summary>Whether the triangle of the two is touched beyond a neighbour only, if at all.</summary>
    public bool IsOfNeighbour;
    /// <summary>Whether they touch for sure; said of one of those of a parent that has children of neighbours.</summary>
    public bool Touches;
    /// <summary>Whether it is known that they are to be tested.</summary>
    public bool IsAllowed;
    /// <summary>Whether triangles beside this one were left out, of which what is near the other shape is a neighbour's.</summary>
    public bool LeavesToNeighbours;

    /// <summary>Writes one in place: what is made elsewhere first is copied as a whole, and waits for its parts.</summary>
    public void Write(int parent, ChildIds children)
    {
        Parent = parent;
        Children = children;
        LeadsOut = IsOfNeighbour = Touches = IsAllowed = LeavesToNeighbours = false;
    }
}

/// <summary>The convex shapes of two children, and where they are. A shape without children is its own.</summary>
unsafe struct ChildShapes
{
    public int TypeA, TypeB;
    /// <summary>The shapes, which stay in place until the next two are asked for; that of A goes on where the next two have the same.</summary>
    public void* ShapeA, ShapeB;
    /// <summary>By what histories know the shapes.</summary>
    public TypedIndex NameA, NameB;
    /// <summary>Their centres less that of the parent's A, world axes. Zero for an A without children.</summary>
    public Vector3 OffsetA, OffsetB;
    public Quaternion OrientationA, OrientationB;
    /// <summary>What is next to a triangle of a surface; nothing for all else.</summary>
    public TriangleCone ConeA, ConeB;
    /// <summary>Whether one is a plane that leads out of a solid: what the triangle's tests keep is not of use to it.</summary>
    public bool LeadsOut;
}

/// <summary>Expands pairs of which one shape at least is made of children into pairs of children, which are convex.</summary>
/// <remarks>
/// It says which children there are. Everything else is the batcher's: it brings them in order, asks the callbacks, adds them to the
/// tasks of their types and gathers what these find.
/// </remarks>
abstract unsafe class ExpandingTask : CollisionTask
{
    private protected ExpandingTask(int shapeTypeIndexA, int shapeTypeIndexB, string description)
        : base(shapeTypeIndexA, shapeTypeIndexB, description, keepsHistories: false, expands: true) { }

    /// <summary>Whether children agree on their normals, and their contacts become patches; each has a manifold of its own otherwise.</summary>
    internal virtual bool JoinsChildren => true;

    /// <summary>A pair of a batch, to be changed.</summary>
    internal abstract ref ParentPair Parent(in PairBatch batch, int index);

    /// <summary>Finds the children of each parent of a batch that may touch within its margin.</summary>
    /// <param name="batch">The parents.</param>
    /// <param name="shapes">Shapes that children refer to.</param>
    /// <param name="dt">Time that velocities are extrapolated over, s.</param>
    /// <param name="found">Receives the children in the order of the parents, each two once; those of one parent in any order.</param>
    /// <param name="pool">Source of the list's memory.</param>
    internal abstract void FindChildren(in PairBatch batch, Shapes shapes, float dt, ref QuickList<FoundChild> found, BufferPool pool);

    /// <summary>Finds the shapes of two children that were found.</summary>
    /// <param name="batch">The parents.</param>
    /// <param name="shapes">Shapes that children refer to.</param>
    /// <param name="found">The two.</param>
    /// <param name="hasA">Whether <paramref name="children"/> are two of the same parent, asked for last, with the same child of A, and no way out.</param>
    /// <param name="children">Receives the two.</param>
    internal abstract void GetChildren(in PairBatch batch, Shapes shapes, in FoundChild found, bool hasA, ref ChildShapes children);

    internal sealed override void Execute<TCallbacks>(ref PairBatch batch, PairHistory* histories, ref TCallbacks callbacks) =>
        throw new UnreachableException();
}

/// <summary>Keeps the parents of two shape types.</summary>
/// <typeparam name="TShapeA">First shape; of any type id.</typeparam>
/// <typeparam name="TShapeB">Second shape.</typeparam>
abstract unsafe class ExpandingTask<TShapeA, TShapeB>() : ExpandingTask(TShapeA.TypeId, TShapeB.TypeId, Describe(typeof(TShapeA), typeof(TShapeB)))
    where TShapeA : unmanaged, IShape where TShapeB : unmanaged, IShape
{
    private protected struct Entry
    {
        public ParentPair Pair;
        public TShapeA A;
        public TShapeB B;
    }

    internal override int BatchByteCount => PairBatch.Capacity * sizeof(Entry);

    internal sealed override ref ParentPair Parent(in PairBatch batch, int index) => ref Entries(batch)[index].Pair;

    private protected static Entry* Entries(in PairBatch batch) => (Entry*)batch.Bundles.Memory;

    internal sealed override void Write(ref PairBatch batch, Shapes shapes, int shapeIndexA, int shapeIndexB, in Vector3 offsetB,
        in Quaternion orientationA, in Quaternion orientationB, in PairInput pair)
    {
        WriteDirectly(ref batch, Find(shapes, TShapeA.TypeId, shapeIndexA), Find(shapes, TShapeB.TypeId, shapeIndexB), offsetB, orientationA,
            orientationB, pair);
        ref var parent = ref Parent(batch, batch.Count - 1);
        parent.NameA = new(TShapeA.TypeId, shapeIndexA);
        parent.NameB = new(TShapeB.TypeId, shapeIndexB);
        if (parent.Flipped)
            (parent.NameA, parent.NameB) = (parent.NameB, parent.NameA);
    }

    // Not by its type, which is another one than that of the batch where it is a game's own.
    static void* Find(Shapes shapes, int typeId, int index) => shapes.GetBatch(typeId).GetPointer(index);

    internal sealed override void WriteDirectly(ref PairBatch batch, void* shapeA, void* shapeB, in Vector3 offsetB,
        in Quaternion orientationA, in Quaternion orientationB, in PairInput pair)
    {
        ref var entry = ref Entries(batch)[batch.Count++];
        entry.A = *(TShapeA*)shapeA;
        entry.B = *(TShapeB*)shapeB;
        var flipped = pair.FlipMask != 0;
        // Field by field: what is made elsewhere first is copied as a whole.
        ref var parent = ref entry.Pair;
        parent.OffsetB = offsetB;
        parent.OrientationA = flipped ? orientationB : orientationA;
        parent.OrientationB = flipped ? orientationA : orientationB;
        parent.Motion = default;
        parent.SpeculativeMargin = pair.SpeculativeMargin;
        parent.PairId = pair.PairId;
        parent.Flipped = flipped;
        parent.NameA = parent.NameB = default;
    }
}
