using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

// Rays against a mesh.
public unsafe partial struct Mesh
{
    /// <summary>Tests a ray and reports each triangle that it hits to a handler, in no order that means anything.</summary>
    /// <param name="pose">Pose of the mesh.</param>
    /// <param name="ray">Ray in the world.</param>
    /// <param name="maximumT">Farthest t of interest; the handler may lower it.</param>
    /// <param name="pool">Not used: a ray takes no memory.</param>
    /// <param name="hitHandler">Asked for each triangle near the ray, and told of the hits; children are triangles.</param>
    public readonly void RayTest<TRayHitHandler>(in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler)
        where TRayHitHandler : struct, IShapeRayHitHandler
    {
        var hits = new HandlerHits<TRayHitHandler>(ref hitHandler, ray, pose.Orientation);
        MeshRay.Cast(this, pose, ray.Origin, ray.Direction, ref maximumT, ref hits);
    }

    /// <summary>Finds the first triangle that a ray hits; of several at the same place that with the lowest number.</summary>
    /// <remarks>A ray within a triangle's plane misses it. Between triangles that share corners no ray passes.</remarks>
    /// <param name="pose">Pose of the mesh.</param>
    /// <param name="origin">Start of the ray in the world, m.</param>
    /// <param name="direction">Direction of the ray, of any length; zero hits nothing.</param>
    /// <param name="maximumT">Farthest t of interest.</param>
    /// <param name="t">At a hit, the point is origin + direction * t, and t is at least zero. Zero without a hit.</param>
    /// <param name="normal">At a hit, the unit normal of the side that was met: it opposes the direction. Zero without a hit.</param>
    /// <param name="triangleIndex">At a hit, the number of the triangle; else -1.</param>
    /// <returns>Whether the ray hits a front, or either side of a two-sided mesh.</returns>
    public readonly bool RayTest(in RigidPose pose, Vector3 origin, Vector3 direction, float maximumT, out float t, out Vector3 normal, out int triangleIndex)
    {
        var nearest = new NearestHit { Triangle = -1 };
        MeshRay.Cast(this, pose, origin, direction, ref maximumT, ref nearest);
        triangleIndex = nearest.Triangle;
        t = nearest.T;
        normal = triangleIndex < 0 ? default : Exact.Rotate(nearest.Normal, pose.Orientation);
        return triangleIndex >= 0;
    }

    struct NearestHit : IMeshHits
    {
        public int Triangle;
        public float T;
        public Vector3 Normal;

        public readonly bool Allows(int triangle) => true;

        public void Add(int triangle, float t, Vector3 normal, ref float maximumT)
        {
            if (Triangle >= 0 && t == T && triangle > Triangle)
                return;
            Triangle = triangle;
            T = t;
            Normal = normal;
            maximumT = t;
        }
    }

    ref struct HandlerHits<THandler>(ref THandler handler, in RayData ray, in Quaternion orientation) : IMeshHits where THandler : struct, IShapeRayHitHandler
    {
        readonly ref THandler handler = ref handler;
        readonly ref readonly RayData ray = ref ray;
        readonly ref readonly Quaternion orientation = ref orientation;

        public readonly bool Allows(int triangle) => handler.AllowTest(triangle);

        public readonly void Add(int triangle, float t, Vector3 normal, ref float maximumT) =>
            handler.OnRayHit(ray, ref maximumT, t, Exact.Rotate(normal, orientation), triangle);
    }
}
