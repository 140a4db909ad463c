using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>How far a convex shape is from a shape of any type.</summary>
static unsafe class DistancePairs
{
    /// <summary>Looks at all parts of a shape.</summary>
    /// <param name="motion">Where the bodies are.</param>
    /// <param name="a">The convex shape, which is no half-space.</param>
    /// <param name="typeB">Type of the other shape.</param>
    /// <param name="b">The other shape.</param>
    /// <param name="filter">Chooses children.</param>
    /// <param name="shapes">Shapes that children refer to.</param>
    /// <param name="pool">Source of temporary memory.</param>
    /// <param name="nearest">The nearest part; goes on from what it is.</param>
    public static void Test<TFilter>(in SweepMotion motion, ref ImpactBody a, int typeB, void* b, ref TFilter filter,
        Shapes shapes, BufferPool pool, ref NearestPart nearest) where TFilter : ISweepFilter
    {
        var distance = new ContainerDistance<TFilter>(motion, ref a, ref filter, shapes, pool, ref nearest);
        if (!ContainerTypes.TryUse(typeB, b, shapes, ref distance))
            nearest.Test(motion, ref a, ImpactCore.Of(typeB, b, shapes), RigidPose.Identity, 0);
    }
}
