using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Trees;

public unsafe partial struct Tree
{
    /// <summary>A subtree or leaf that a query still has to visit, and when it gets there, or how far away it is.</summary>
    struct PendingVisit
    {
        public int Index;
        public float T;
    }

    /// <summary>Tells which leaves have boxes that a ray meets, near subtrees first.</summary>
    /// <param name="origin">Where the ray starts.</param>
    /// <param name="direction">Direction of the ray, of any length; zero tests the origin alone.</param>
    /// <param name="maximumT">Length of the ray in units of its direction; as the callback left it in the end.</param>
    /// <param name="pool">Passed on to the callback; the traversal itself needs no memory.</param>
    /// <param name="leafTester">Receives the leaves on the calling thread.</param>
    /// <param name="id">The caller's number for the ray.</param>
    public readonly void RayCast<TLeafTester>(
        Vector3 origin, Vector3 direction, ref float maximumT, BufferPool pool, ref TLeafTester leafTester, int id = 0)
        where TLeafTester : IRayLeafTester
    {
        BoxMath.RequireFinite(origin);
        BoxMath.RequireFinite(direction);
        BoxMath.RequireLength(maximumT);
        var test = new SlabTest(origin, origin, direction);
        var ray = new RayData { Origin = origin, Id = id, Direction = direction };
        RayCast(test, &ray, ref maximumT, pool, ref leafTester);
    }

    /// <summary>As a ray that was checked, and made ready for boxes: of one that is cast through several trees once.</summary>
    internal readonly void RayCast<TLeafTester>(in SlabTest test, RayData* ray, ref float maximumT, BufferPool pool, ref TLeafTester leafTester)
        where TLeafTester : IRayLeafTester
    {
        var length = maximumT;
        var visitor = new RayVisitor<TLeafTester> { Ray = ray, Pool = pool, Tester = ref leafTester };
        Traverse(test, ref length, ref visitor);
        maximumT = length;
    }

    /// <inheritdoc cref="RayCast{TLeafTester}(Vector3, Vector3, ref float, BufferPool, ref TLeafTester, int)"/>
    public readonly void RayCast<TLeafTester>(
        Vector3 origin, Vector3 direction, float maximumT, BufferPool pool, ref TLeafTester leafTester, int id = 0)
        where TLeafTester : IRayLeafTester =>
        RayCast(origin, direction, ref maximumT, pool, ref leafTester, id);

    /// <summary>Tells which leaves have boxes that a moving box meets, near subtrees first.</summary>
    /// <param name="min">Lower corner of the box where it starts.</param>
    /// <param name="max">Upper corner of the box where it starts.</param>
    /// <param name="direction">Direction of the motion, of any length; zero tests the start alone.</param>
    /// <param name="maximumT">Length of the sweep in units of its direction; as the callback left it in the end.</param>
    /// <param name="pool">Not used: the traversal needs no memory. Kept for callers.</param>
    /// <param name="sweepTester">Receives the leaves on the calling thread.</param>
    public readonly void Sweep<TLeafTester>(
        Vector3 min, Vector3 max, Vector3 direction, ref float maximumT, BufferPool pool, ref TLeafTester sweepTester)
        where TLeafTester : ISweepLeafTester
    {
        BoxMath.RequireBox(min, max);
        BoxMath.RequireFinite(direction);
        BoxMath.RequireLength(maximumT);
        var visitor = new SweepVisitor<TLeafTester> { Tester = ref sweepTester };
        Traverse(new SlabTest(min, max, direction), ref maximumT, ref visitor);
    }

    /// <inheritdoc cref="Sweep{TLeafTester}(Vector3, Vector3, Vector3, ref float, BufferPool, ref TLeafTester)"/>
    public readonly void Sweep<TLeafTester>(
        Vector3 min, Vector3 max, Vector3 direction, float maximumT, BufferPool pool, ref TLeafTester sweepTester)
        where TLeafTester : ISweepLeafTester =>
        Sweep(min, max, direction, ref maximumT, pool, ref sweepTester);

    /// <inheritdoc cref="Sweep{TLeafTester}(Vector3, Vector3, Vector3, ref float, BufferPool, ref TLeafTester)"/>
    public readonly void Sweep<TLeafTester>(
        in BoundingBox boundingBox, Vector3 direction, float maximumT, BufferPool pool, ref TLeafTester sweepTester)
        where TLeafTester : ISweepLeafTester =>
        Sweep(boundingBox.Min, boundingBox.Max, direction, maximumT, pool, ref sweepTester);

    /// <summary>Tells which leaves have boxes that are near to a box, near subtrees first.</summary>
    /// <param name="min">Lower corner of the box.</param>
    /// <param name="max">Upper corner of the box.</param>
    /// <param name="maximumDistance">How near, m; as the callback left it in the end.</param>
    /// <param name="leafTester">Receives the leaves on the calling thread.</param>
    internal readonly void FindNear<TLeafTester>(Vector3 min, Vector3 max, ref float maximumDistance, ref TLeafTester leafTester)
        where TLeafTester : ISweepLeafTester
    {
        var visitor = new SweepVisitor<TLeafTester> { Tester = ref leafTester };
        Traverse(new GapTest(min, max), ref maximumDistance, ref visitor);
    }

    interface ILeafVisitor
    {
        void Visit(int leafIndex, ref float maximumT);
    }

    ref struct RayVisitor<TLeafTester> : ILeafVisitor where TLeafTester : IRayLeafTester
    {
        public RayData* Ray;
        public BufferPool Pool;
        public ref TLeafTester Tester;

        public readonly void Visit(int leafIndex, ref float maximumT)
        {
            fixed (float* pointer = &maximumT)
                Tester.TestLeaf(leafIndex, Ray, pointer, Pool);
        }
    }

    ref struct SweepVisitor<TLeafTester> : ILeafVisitor where TLeafTester : ISweepLeafTester
    {
        public ref TLeafTester Tester;

        public readonly void Visit(int leafIndex, ref float maximumT) => Tester.TestLeaf(leafIndex, ref maximumT);
    }

    readonly void Traverse<TTest, TVisitor>(in TTest test, ref float maximumT, ref TVisitor visitor)
        where TTest : struct, IBoxTest where TVisitor : ILeafVisitor, allows ref struct
    {
        // One query goes through two trees: the first may have ended it.
        if (LeafCount == 0 || maximumT < 0)
            return;
        var children = Children;
        var stack = stackalloc PendingVisit[TraversalStackSize];
        var count = 0;
        var index = 0;
        while (true)
        {
            if (index < 0)
            {
                visitor.Visit(~index, ref maximumT);
            }
            else
            {
                // Branches, though they are coin tosses: without any, each node would wait for the one before, which is three times as long as
                // a guess costs in the mean.
                var a = children + 2 * index;
                var b = a + 1;
                var (meetsA, meetsB) = test.MeetsBoth(a, maximumT, out var tA, out var tB);
                if (meetsA)
                {
                    index = a->Index;
                    if (meetsB)
                    {
                        if (tA <= tB)
                        {
                            stack[count++] = new() { Index = b->Index, T = tB };
                        }
                        else
                        {
                            stack[count++] = new() { Index = index, T = tA };
                            index = b->Index;
                        }
                    }
                    continue;
                }
                if (meetsB)
                {
                    index = b->Index;
                    continue;
                }
            }
            // A callback may have shortened the query since these were put here.
            do
            {
                if (count == 0)
                    return;
                --count;
            }
            while (stack[count].T > maximumT);
            index = stack[count].Index;
        }
    }
}
