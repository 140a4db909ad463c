using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>What a shape of a game's own that is made of children may answer with if it has nothing better.</summary>
public static unsafe partial class HomogeneousCompound
{
    /// <summary>
    /// Tests a ray against the children that the handler allows, those first whose boxes it meets first, as far as <paramref name="maximumT"/> goes by
    /// then. They are found by <see cref="IHomogeneousCompoundShape{TChildShape, TChildShapeWide}.FindLocalOverlaps"/>, with boxes around bits of the ray.
    /// </summary>
    /// <param name="shape">The shape.</param>
    /// <param name="pose">Its pose.</param>
    /// <param name="ray">Ray in the world.</param>
    /// <param name="maximumT">Farthest t of interest; the handler may lower it.</param>
    /// <param name="pool">Source of temporary memory; used by the calling thread only.</param>
    /// <param name="hitHandler">Receives the hits.</param>
    public static void RayTest<TShape, TChildShape, TChildShapeWide, TRayHitHandler>(
        in TShape shape, in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler)
        where TShape : unmanaged, IHomogeneousCompoundShape<TChildShape, TChildShapeWide>
        where TChildShape : unmanaged, IConvexShape where TChildShapeWide : unmanaged, IShapeWide<TChildShape>
        where TRayHitHandler : struct, IShapeRayHitHandler
    {
        // Known by its own bounds alone, which need no other shapes.
        ref var container = ref Unsafe.As<TShape, HomogeneousContainer<TShape, TChildShape, TChildShapeWide>>(ref Unsafe.AsRef(in shape));
        NodeChild root;
        if (container.Open(0, null!, &root) == 0)
            return;
        RigidPose.TransformByInverse(ray.Origin, pose, out var origin);
        var direction = Exact.RotateByInverse(ray.Direction, pose.Orientation);
        var visitor = new Visitor<TShape, TChildShape, TChildShapeWide, TRayHitHandler>
        {
            Shape = ref Unsafe.AsRef(in shape),
            Pose = pose,
            Ray = ray,
            Origin = origin,
            Direction = direction,
            MaximumT = ref maximumT,
            Handler = ref hitHandler,
        };
        // A point in the frame of the shape is rounded by the size of its coordinates.
        var pad = (Vector3.Abs(root.Min) + Vector3.Abs(root.Max) + Vector3.Abs(origin)) * BoxMath.ReachRounding;
        root.Min -= pad;
        root.Max += pad;
        ContainerReach.Visit(container, new SlabTest(origin - pad, origin + pad, direction), root, ref visitor, null!, pool);
    }

    /// <summary>
    /// Puts the children that were found into the order of their numbers, each once. A game may have found them in any order, another one each time, or one of
    /// them twice; nothing is to depend on that.
    /// </summary>
    internal static void PutInOrder(ref QuickList<int> found, int first)
    {
        var children = found.AsSpan()[first..];
        children.Sort();
        var count = 0;
        foreach (var child in children)
        {
            if (count == 0 || children[count - 1] != child)
                children[count++] = child;
        }
        found.Count = first + count;
    }

    ref struct Visitor<TShape, TChildShape, TChildShapeWide, TRayHitHandler> : IReachVisitor
        where TShape : unmanaged, IHomogeneousCompoundShape<TChildShape, TChildShapeWide>
        where TChildShape : unmanaged, IConvexShape where TChildShapeWide : unmanaged, IShapeWide<TChildShape>
        where TRayHitHandler : struct, IShapeRayHitHandler
    {
        public ref TShape Shape;
        public RigidPose Pose;
        public RayData Ray;
        public Vector3 Origin, Direction;
        public ref float MaximumT;
        public ref TRayHitHandler Handler;

        public readonly float Maximum => MathHelper.Min(MaximumT, float.MaxValue);

        public readonly bool IsDone => false;

        public readonly void Visit(int index)
        {
            if (!Handler.AllowTest(index))
                return;
            Shape.GetPosedLocalChild(index, out var child, out var place);
            if (child.RayTest(place, Origin, Direction, out var t, out var normal) && t <= MaximumT)
                Handler.OnRayHit(Ray, ref MaximumT, t, Exact.Rotate(normal, Pose.Orientation), index);
        }
    }
}
