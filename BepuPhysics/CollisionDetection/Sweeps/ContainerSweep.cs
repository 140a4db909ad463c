using System;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>A convex part of a body against the children of another one, those first whose boxes it meets first.</summary>
/// <remarks>
/// In the frame that the container has at first the part moves along a line. Around all places that it gets to by turning, and that the
/// container does, there is a box, and only children whose boxes that box meets are tested, up to the first impact that is known.
/// </remarks>
/// <param name="motion">How the bodies move.</param>
/// <param name="part">The part of A.</param>
/// <param name="partIndex">Its number.</param>
/// <param name="filter">Chooses children.</param>
/// <param name="isFlipped">Whether the filter knows A as B.</param>
/// <param name="shapes">Shapes that children refer to.</param>
/// <param name="pool">Source of temporary memory.</param>
/// <param name="hit">The first impact.</param>
ref struct ContainerSweep<TFilter>(in SweepMotion motion, ref ImpactBody part, int partIndex, ref TFilter filter, bool isFlipped,
    Shapes shapes, BufferPool pool, ref SweepHit hit) : IContainerUser, IChildVisitor<SlabTest> where TFilter : ISweepFilter
{
    // Beyond anything that has a place.
    const double Farthest = 1e15;

    readonly ref readonly SweepMotion motion = ref motion;
    readonly ref ImpactBody part = ref part;
    readonly ref TFilter filter = ref filter;
    readonly ref SweepHit hit = ref hit;

    public void Use<TContainer>(in TContainer container) where TContainer : unmanaged, IContainer
    {
        if (ContainerWalk.IsInside(motion, part, container))
            hit.Overlap();
        else
            ContainerWalk.Visit<TContainer, SlabTest, ContainerSweep<TFilter>>(container, ref this, shapes, pool);
    }

    public readonly float Maximum => (float)Math.Min(hit.LatestT(motion), float.MaxValue);

    public readonly bool IsDone => hit.Overlaps;

    public readonly bool Allows(int index) => isFlipped ? filter.AllowTest(index, partIndex) : filter.AllowTest(partIndex, index);

    public readonly unsafe void Visit(int index, in ContainerChild child)
    {
        var core = motion.CoreOf(child.TypeId, child.Shape, shapes);
        part.Restart();
        if (!motion.BallsMeet(part, core, child.Pose.Position, hit.LatestT(motion)))
            return;
        var body = new ImpactBody(core, child.Pose, motion.OrientationB, motion.AngularB);
        hit.Test(motion, ref part, ref body, partIndex, index);
    }

    // The place of the part in the container's frame, and its way there. A half-space is everywhere, and meets everything at once.
    public readonly SlabTest CreateTest(Buffer<NodeChild> root, int count)
    {
        if (part.Core.IsPlane)
            return new SlabTest(new((float)-Farthest), new((float)Farthest), default);
        var relative = motion.LinearA - motion.LinearB;
        SweepBounds.InContainer(motion, part, root, count, relative.Length, out var min, out var max);
        return new SlabTest(min, max, motion.OrientationB.TurnBack(relative).ToSingle());
    }
}
