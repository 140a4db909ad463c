using System.Numerics;

namespace BepuPhysics.Collidables;

/// <summary>A convex shape, its centre of mass at the origin of its own frame.</summary>
public interface IConvexShape : IShape
{
    /// <summary>Inverse mass and inverse inertia of the solid shape, filled uniformly, in its own frame.</summary>
    /// <param name="mass">Mass, kg; finite and positive.</param>
    /// <exception cref="System.ArgumentException">
    /// The shape is not valid, or the mass is not positive or so extreme that an inverse leaves the range of a float.
    /// </exception>
    BodyInertia ComputeInertia(float mass);

    /// <summary>Finds where a ray enters the shape.</summary>
    /// <param name="pose">Pose of the shape.</param>
    /// <param name="origin">Start of the ray in the world, m.</param>
    /// <param name="direction">Direction of the ray, of any length; zero hits nothing.</param>
    /// <param name="t">
    /// At a hit, the point is origin + direction * t, and t is at least zero: exactly zero for a ray that starts inside.
    /// Zero without a hit.
    /// </param>
    /// <param name="normal">
    /// At a hit, the unit normal that points out of the shape; for a ray that starts inside, that of the nearest part of the surface.
    /// Where no part is nearest (the centre of a sphere) it opposes the direction. Zero without a hit.
    /// </param>
    /// <returns>Whether the ray hits. A ray that touches, or starts on the surface, may go either way within rounding.</returns>
    bool RayTest(in RigidPose pose, Vector3 origin, Vector3 direction, out float t, out Vector3 normal);

    /// <summary>Box around the shape when its centre is at the origin, exact to a few roundings of the shape's size.</summary>
    /// <param name="orientation">Rotation from the shape's frame to the world; unit length.</param>
    /// <param name="min">Corner with the least coordinates, relative to the centre, m.</param>
    /// <param name="max">Corner with the greatest coordinates, relative to the centre, m.</param>
    void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max);

    /// <summary>How far a rotation can carry the surface beyond the bounds of another orientation.</summary>
    /// <param name="maximumRadius">Distance from the centre to the farthest point, m: spin times it bounds surface speed.</param>
    /// <param name="maximumAngularExpansion">Maximum radius less the least distance from the centre to the surface, m.</param>
    void ComputeAngularExpansionData(out float maximumRadius, out float maximumAngularExpansion);
}
