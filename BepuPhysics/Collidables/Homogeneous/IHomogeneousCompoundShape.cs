using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>
/// A shape of a game's own that is made of convex shapes of one type, its children, which it makes up when it is asked for them: a grid of voxels,
/// say, that keeps nothing but which of its cells are filled.
/// </summary>
/// <remarks>
/// <para>Its type is registered before the first step, by <see cref="CollisionDetection.CollisionTaskRegistry.RegisterHomogeneousCompound"/>. A body
/// turns around the origin of the shape, which must be its centre of mass.</para>
/// <para>Several threads may ask at once. What they are told must depend on the shape and on what is asked alone, not on who asked before, nor on the
/// width of vectors: the simulation is as repeatable as the answers are.</para>
/// </remarks>
/// <typeparam name="TChildShape">Type of the children; of 128 bytes at most.</typeparam>
/// <typeparam name="TChildShapeWide">Wide form of the children.</typeparam>
public interface IHomogeneousCompoundShape<TChildShape, TChildShapeWide> : IDisposableShape
    where TChildShape : unmanaged, IConvexShape where TChildShapeWide : unmanaged, IShapeWide<TChildShape>
{
    /// <summary>Number of children: their numbers are below it. Some of them may be nowhere, and are then never found.</summary>
    int ChildCount { get; }

    /// <summary>Box around all children when the shape's centre is at the origin. Asked for often: it should be known, or soon found out.</summary>
    /// <param name="orientation">Rotation from the shape's frame to the world; unit length. Not turned at all, nothing is to be rounded.</param>
    /// <param name="min">Corner with the least coordinates, m.</param>
    /// <param name="max">Corner with the greatest coordinates, m.</param>
    void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max);

    /// <summary>Gets a child.</summary>
    /// <param name="childIndex">Number of the child, one of those that were found.</param>
    /// <param name="childShape">The child, around its own centre.</param>
    /// <param name="childPose">Where that is in the frame of the shape; of unit length, as always.</param>
    void GetPosedLocalChild(int childIndex, out TChildShape childShape, out RigidPose childPose);

    /// <summary>
    /// Finds the children that overlap or touch a box, in any order, which changes nothing; one that is told of twice is one. More than these may be told
    /// of, but none that is missing is tested: where corners are rounded, it is outward. Told of from the least number on, they need not be put in order.
    /// </summary>
    /// <param name="min">Lower corner in the frame of the shape, m.</param>
    /// <param name="max">Upper corner, nowhere below the lower.</param>
    /// <param name="overlaps">Receives the numbers of the children, behind those that are in it.</param>
    /// <param name="pool">Source of the list's memory, and of temporary memory; a pool of the calling thread.</param>
    void FindLocalOverlaps(Vector3 min, Vector3 max, ref QuickList<int> overlaps, BufferPool pool);

    /// <summary>Tests a ray against the children that the handler allows, and reports hits with their numbers.</summary>
    /// <param name="pose">Pose of the shape.</param>
    /// <param name="ray">Ray in the world.</param>
    /// <param name="maximumT">Farthest t of interest; the handler may lower it.</param>
    /// <param name="pool">Source of temporary memory; used by the calling thread only.</param>
    /// <param name="hitHandler">Receives the hits; may be copied in and copied back.</param>
    void RayTest<TRayHitHandler>(in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler)
        where TRayHitHandler : struct, IShapeRayHitHandler;
}
