using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>A convex shape and the children of a container, those first whose boxes are nearest.</summary>
/// <param name="motion">Where the bodies are.</param>
/// <param name="a">The convex shape.</param>
/// <param name="filter">Chooses children.</param>
/// <param name="shapes">Shapes that children refer to.</param>
/// <param name="pool">Source of temporary memory.</param>
/// <param name="nearest">The nearest part.</param>
ref struct ContainerDistance<TFilter>(in SweepMotion motion, ref ImpactBody a, ref TFilter filter, Shapes shapes, BufferPool pool,
    ref NearestPart nearest) : IContainerUser, IChildVisitor<GapTest> where TFilter : ISweepFilter
{
    readonly ref readonly SweepMotion motion = ref motion;
    readonly ref ImpactBody a = ref a;
    readonly ref TFilter filter = ref filter;
    readonly ref NearestPart nearest = ref nearest;

    public void Use<TContainer>(in TContainer container) where TContainer : unmanaged, IContainer
    {
        if (ContainerWalk.IsInside(motion, a, container))
            nearest.Overlap();
        else
            ContainerWalk.Visit<TContainer, GapTest, ContainerDistance<TFilter>>(container, ref this, shapes, pool);
    }

    public readonly float Maximum => Rounded.Up(nearest.Maximum);

    public readonly bool IsDone => nearest.Found.Overlaps;

    public readonly bool Allows(int index) => filter.AllowTest(0, index);

    public readonly unsafe void Visit(int index, in ContainerChild child) =>
        nearest.Test(motion, ref a, ImpactCore.Of(child.TypeId, child.Shape, shapes), child.Pose, index);

    public readonly GapTest CreateTest(Buffer<NodeChild> root, int count)
    {
        SweepBounds.InContainer(motion, a, root, count, 0, out var min, out var max);
        return new GapTest(min, max);
    }
}
