using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>A shape made of other shapes, which it names.</summary>
public interface ICompoundShape : IDisposableShape
{
    /// <summary>Number of children.</summary>
    int ChildCount { get; }

    /// <summary>A child, in the memory of the compound.</summary>
    /// <param name="compoundChildIndex">Number of the child, less than <see cref="ChildCount"/>.</param>
    ref CompoundChild GetChild(int compoundChildIndex);

    /// <summary>Box around the compound when its centre is at the origin: around the boxes of all children.</summary>
    /// <param name="orientation">Rotation from the compound's frame to the world; unit length.</param>
    /// <param name="shapeBatches">Shapes that the children refer to.</param>
    /// <param name="min">Corner with the least coordinates, m.</param>
    /// <param name="max">Corner with the greatest coordinates, m.</param>
    void ComputeBounds(Quaternion orientation, Shapes shapeBatches, out Vector3 min, out Vector3 max);

    /// <summary>Tests a ray against the children that the handler allows, and reports hits with the numbers of their convex pieces.</summary>
    /// <param name="pose">Pose of the compound.</param>
    /// <param name="ray">Ray in the world.</param>
    /// <param name="maximumT">Farthest t of interest; the handler may lower it.</param>
    /// <param name="shapeBatches">Shapes that the children refer to.</param>
    /// <param name="pool">Source of temporary memory; used by the calling thread only.</param>
    /// <param name="hitHandler">Receives the hits; copied in and copied back.</param>
    void RayTest<TRayHitHandler>(in RigidPose pose, in RayData ray, ref float maximumT, Shapes shapeBatches, BufferPool pool,
        ref TRayHitHandler hitHandler) where TRayHitHandler : struct, IShapeRayHitHandler;
}
