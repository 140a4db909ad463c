using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;

namespace BepuPhysics;

/// <summary>Measures how near the shape of a collidable is whose bounds are.</summary>
/// <typeparam name="THandler">Type of the handler.</typeparam>
unsafe struct WorldProximity<THandler> : IBroadPhaseSweepTester, ISweepFilter where THandler : IProximityHandler
{
    public WorldQuery Query;
    public THandler Handler;

    /// <inheritdoc/>
    public void Test(CollidableReference collidable, ref float maximumT)
    {
        if (!Query.MayMeet(collidable) || !Handler.AllowTest(collidable) || !Query.TryPlace(collidable, out var type, out var data))
            return;
        var nearest = new NearestPart(maximumT);
        DistancePairs.Test(*Query.Motion, ref *Query.Shape, type, data, ref this, Query.Simulation.Shapes, Query.Pool, ref nearest);
        if (!nearest.Exists)
            return;
        ref readonly var found = ref nearest.Found;
        var proximity = new Proximity
        {
            Collidable = collidable,
            ChildIndex = nearest.Child,
            Overlaps = found.Overlaps,
            Distance = Rounded.Up(found.Distance),
        };
        if (!found.Overlaps)
        {
            proximity.Normal = found.Normal.ToSingle();
            proximity.Place = (Query.Position + found.Place).ToSingle();
        }
        Handler.OnProximity(ref maximumT, proximity);
    }

    /// <inheritdoc/>
    public bool AllowTest(int childA, int childB) => Handler.AllowTest(Query.Collidable, childB);
}
