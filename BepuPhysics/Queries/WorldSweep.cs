using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;

namespace BepuPhysics;

/// <summary>Tests the shape of a collidable whose bounds a swept shape meets.</summary>
/// <typeparam name="THitHandler">Type of the handler.</typeparam>
unsafe struct WorldSweep<THitHandler> : IBroadPhaseSweepTester, ISweepFilter where THitHandler : ISweepHitHandler
{
    public WorldQuery Query;
    public THitHandler Handler;

    /// <inheritdoc/>
    public void Test(CollidableReference collidable, ref float maximumT)
    {
        if (!Query.MayMeet(collidable) || !Handler.AllowTest(collidable) || !Query.TryPlace(collidable, out var type, out var data))
            return;
        Query.Motion->MaximumT = maximumT;
        var hit = default(SweepHit);
        SweepPairs.TestPart(*Query.Motion, ref *Query.Shape, 0, type, data, ref this, false, Query.Simulation.Shapes, Query.Pool, ref hit);
        if (!hit.Exists)
            return;
        if (hit.Overlaps)
            Handler.OnHitAtZeroT(ref maximumT, collidable);
        else
            Handler.OnHit(ref maximumT, hit.EarliestT, (Query.Position + hit.Place).ToSingle(), hit.Normal.ToSingle(), collidable);
    }

    /// <inheritdoc/>
    public bool AllowTest(int childA, int childB) => Handler.AllowTest(Query.Collidable, childB);
}
