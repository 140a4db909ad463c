using System.Numerics;
using System.Runtime.Intrinsics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

// Queries see the bounds as of the last update. Each is made of the same query on both trees; the callback goes along as a copy.
public sealed unsafe partial class BroadPhase
{
    /// <summary>Tells which collidables have bounds that a ray meets, active ones first, near ones of each kind first.</summary>
    /// <param name="origin">Where the ray starts.</param>
    /// <param name="direction">Direction of the ray, of any length.</param>
    /// <param name="maximumT">Length of the ray in units of its direction.</param>
    /// <param name="pool">Passed on to the callback; a pool of the calling thread.</param>
    /// <param name="rayTester">Receives the collidables on the calling thread; copied in and copied back.</param>
    /// <param name="id">The caller's number for the ray.</param>
    public void RayCast<TRayTester>(
        Vector3 origin, Vector3 direction, float maximumT, BufferPool pool, ref TRayTester rayTester, int id = 0)
        where TRayTester : IBroadPhaseRayTester
    {
        using var reading = world.Read("BroadPhase.RayCast");
        BoxMath.RequireFinite(origin);
        BoxMath.RequireFinite(direction);
        BoxMath.RequireLength(maximumT);
        CastRay(origin, direction, maximumT, pool, ref rayTester, id);
    }

    /// <summary>As a ray that was checked.</summary>
    internal void CastRay<TRayTester>(
        Vector3 origin, Vector3 direction, float maximumT, BufferPool pool, ref TRayTester rayTester, int id)
        where TRayTester : IBroadPhaseRayTester
    {
        var leafTester = new RayLeafTester<TRayTester> { RayTester = rayTester, Leaves = ActiveLeaves };
        var test = new SlabTest(origin, origin, direction);
        var ray = new RayData { Origin = origin, Id = id, Direction = direction };
        ActiveTree.RayCast(test, &ray, ref maximumT, pool, ref leafTester);
        leafTester.Leaves = StaticLeaves;
        StaticTree.RayCast(test, &ray, ref maximumT, pool, ref leafTester);
        rayTester = leafTester.RayTester;
    }

    /// <summary>As of each of some rays that were checked.</summary>
    internal void CastRays<TRayTester>(ref RayPacket packet, BufferPool pool, ref TRayTester rayTester) where TRayTester : IBroadPhaseRayTester
    {
        var leafTester = new RayLeafTester<TRayTester> { RayTester = rayTester, Leaves = ActiveLeaves };
        ActiveTree.RayCast(ref packet, pool, ref leafTester);
        leafTester.Leaves = StaticLeaves;
        StaticTree.RayCast(ref packet, pool, ref leafTester);
        rayTester = leafTester.RayTester;
    }

    /// <summary>Tells which collidables have bounds that a moving box meets, active ones first, near ones of each kind first.</summary>
    /// <param name="min">Lower corner of the box where it starts.</param>
    /// <param name="max">Upper corner of the box where it starts.</param>
    /// <param name="direction">Direction of the motion, of any length.</param>
    /// <param name="maximumT">Length of the sweep in units of its direction.</param>
    /// <param name="pool">Not used. Kept for callers.</param>
    /// <param name="sweepTester">Receives the collidables on the calling thread; copied in and copied back.</param>
    public void Sweep<TSweepTester>(
        Vector3 min, Vector3 max, Vector3 direction, float maximumT, BufferPool pool, ref TSweepTester sweepTester)
        where TSweepTester : IBroadPhaseSweepTester
    {
        using var reading = world.Read("BroadPhase.Sweep");
        SweepBox(min, max, direction, maximumT, pool, ref sweepTester);
    }

    internal void SweepBox<TSweepTester>(
        Vector3 min, Vector3 max, Vector3 direction, float maximumT, BufferPool pool, ref TSweepTester sweepTester)
        where TSweepTester : IBroadPhaseSweepTester
    {
        var leafTester = new SweepLeafTester<TSweepTester> { SweepTester = sweepTester, Leaves = ActiveLeaves };
        ActiveTree.Sweep(min, max, direction, ref maximumT, pool, ref leafTester);
        leafTester.Leaves = StaticLeaves;
        StaticTree.Sweep(min, max, direction, ref maximumT, pool, ref leafTester);
        sweepTester = leafTester.SweepTester;
    }

    /// <summary>Tells which collidables have bounds that are near to a box, active ones first, near ones of each kind first.</summary>
    /// <param name="min">Lower corner of the box.</param>
    /// <param name="max">Upper corner of the box.</param>
    /// <param name="maximumDistance">How near, m.</param>
    /// <param name="tester">Receives the collidables on the calling thread; copied in and copied back.</param>
    internal void FindNear<TTester>(Vector3 min, Vector3 max, float maximumDistance, ref TTester tester) where TTester : IBroadPhaseSweepTester
    {
        var leafTester = new SweepLeafTester<TTester> { SweepTester = tester, Leaves = ActiveLeaves };
        ActiveTree.FindNear(min, max, ref maximumDistance, ref leafTester);
        leafTester.Leaves = StaticLeaves;
        StaticTree.FindNear(min, max, ref maximumDistance, ref leafTester);
        tester = leafTester.SweepTester;
    }

    /// <inheritdoc cref="Sweep{TSweepTester}(Vector3, Vector3, Vector3, float, BufferPool, ref TSweepTester)"/>
    public void Sweep<TSweepTester>(
        in BoundingBox boundingBox, Vector3 direction, float maximumT, BufferPool pool, ref TSweepTester sweepTester)
        where TSweepTester : IBroadPhaseSweepTester =>
        Sweep(boundingBox.Min, boundingBox.Max, direction, maximumT, pool, ref sweepTester);

    /// <summary>Tells which collidables have bounds that overlap or touch a box, until the callback returns false.</summary>
    /// <param name="min">Lower corner of the box.</param>
    /// <param name="max">Upper corner of the box.</param>
    /// <param name="pool">Not used. Kept for callers.</param>
    /// <param name="overlapEnumerator">Receives the collidables on the calling thread; copied in and copied back.</param>
    public void GetOverlaps<TOverlapEnumerator>(Vector3 min, Vector3 max, BufferPool pool, ref TOverlapEnumerator overlapEnumerator)
        where TOverlapEnumerator : IBreakableForEach<CollidableReference>
    {
        using var reading = world.Read("BroadPhase.GetOverlaps");
        FindOverlapping(new(min, max), ref overlapEnumerator);
    }

    /// <inheritdoc cref="GetOverlaps{TOverlapEnumerator}(Vector3, Vector3, BufferPool, ref TOverlapEnumerator)"/>
    public void GetOverlaps<TOverlapEnumerator>(Vector3 min, Vector3 max, ref TOverlapEnumerator overlapEnumerator)
        where TOverlapEnumerator : IBreakableForEach<CollidableReference> =>
        GetOverlaps(min, max, null!, ref overlapEnumerator);

    internal void FindOverlapping<TOverlapEnumerator>(in BoundingBox bounds, ref TOverlapEnumerator overlapEnumerator)
        where TOverlapEnumerator : IBreakableForEach<CollidableReference>
    {
        var leafEnumerator = new OverlapLeafEnumerator<TOverlapEnumerator> { Enumerator = overlapEnumerator, Leaves = ActiveLeaves };
        Tree.RequireQuery(bounds.Min, bounds.Max);
        Vector128<float> min = bounds.Min.AsVector128(), max = bounds.Max.AsVector128();
        ActiveTree.FindOverlapping(min, max, ref leafEnumerator);
        if (!leafEnumerator.Stopped)
        {
            leafEnumerator.Leaves = StaticLeaves;
            StaticTree.FindOverlapping(min, max, ref leafEnumerator);
        }
        overlapEnumerator = leafEnumerator.Enumerator;
    }

    /// <inheritdoc cref="GetOverlaps{TOverlapEnumerator}(Vector3, Vector3, BufferPool, ref TOverlapEnumerator)"/>
    public void GetOverlaps<TOverlapEnumerator>(in BoundingBox boundingBox, BufferPool pool, ref TOverlapEnumerator overlapEnumerator)
        where TOverlapEnumerator : IBreakableForEach<CollidableReference> =>
        GetOverlaps(boundingBox.Min, boundingBox.Max, pool, ref overlapEnumerator);

    /// <inheritdoc cref="GetOverlaps{TOverlapEnumerator}(Vector3, Vector3, BufferPool, ref TOverlapEnumerator)"/>
    public void GetOverlaps<TOverlapEnumerator>(in BoundingBox boundingBox, ref TOverlapEnumerator overlapEnumerator)
        where TOverlapEnumerator : IBreakableForEach<CollidableReference> =>
        GetOverlaps(boundingBox.Min, boundingBox.Max, null!, ref overlapEnumerator);

    struct RayLeafTester<TRayTester> : IRayLeafTester where TRayTester : IBroadPhaseRayTester
    {
        public TRayTester RayTester;
        public Buffer<CollidableReference> Leaves;

        public void TestLeaf(int leafIndex, RayData* rayData, float* maximumT, BufferPool pool) =>
            RayTester.RayTest(Leaves[leafIndex], rayData, maximumT, pool);
    }

    struct SweepLeafTester<TSweepTester> : ISweepLeafTester where TSweepTester : IBroadPhaseSweepTester
    {
        public TSweepTester SweepTester;
        public Buffer<CollidableReference> Leaves;

        public void TestLeaf(int leafIndex, ref float maximumT) => SweepTester.Test(Leaves[leafIndex], ref maximumT);
    }

    struct OverlapLeafEnumerator<TEnumerator> : IBreakableForEach<int> where TEnumerator : IBreakableForEach<CollidableReference>
    {
        public TEnumerator Enumerator;
        public Buffer<CollidableReference> Leaves;
        public bool Stopped;

        public bool LoopBody(int leafIndex)
        {
            Stopped = !Enumerator.LoopBody(Leaves[leafIndex]);
            return !Stopped;
        }
    }
}
