using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;

namespace DemoTests.CollisionDetection.Children;

/// <summary>Says whose a contact with a triangle of a surface is, in double precision: who shares which edge is told by corners in the same place.</summary>
sealed class TriangleOwners
{
    // A step of the angles that a mesh keeps, rad.
    const double AngleStep = .013;

    readonly Triangle[] triangles;
    readonly Dictionary<(Vector3 From, Vector3 To), int> edges = [];

    public TriangleOwners(Triangle[] triangles)
    {
        this.triangles = triangles;
        for (int i = 0; i < triangles.Length; ++i)
        {
            for (int edge = 0; edge < 3; ++edge)
                edges[Edge(i, edge)] = i;
        }
    }

    (Vector3 From, Vector3 To) Edge(int triangle, int edge)
    {
        ref var t = ref triangles[triangle];
        return edge switch { 0 => (t.A, t.B), 1 => (t.B, t.C), _ => (t.C, t.A) };
    }

    /// <summary>Whether a direction out of a triangle is beyond the normal of a neighbour.</summary>
    public bool IsOfNeighbour(int triangle, Vector3 direction)
    {
        var sides = new TriangleSides(triangles[triangle]);
        double Along(int side) => sides.Along(side, direction.X, direction.Y, direction.Z);
        for (int edge = 0; edge < 3; ++edge)
        {
            var (from, to) = Edge(triangle, edge);
            if (!edges.TryGetValue((to, from), out var other))
                continue;
            var next = new TriangleSides(triangles[other]);
            double Dot(int side) => sides.Along(side, next.Along(3, 1, 0, 0), next.Along(3, 0, 1, 0), next.Along(3, 0, 0, 1));
            var (cosine, sine) = Dot(edge) > 0 ? (Dot(3), Dot(edge)) : (1, 0);
            if (Along(edge) * cosine - Along(3) * sine > -AngleStep)
                return true;
        }
        return false;
    }

    /// <summary>What a shape and a triangle of the surface have, tested as if it were alone.</summary>
    /// <param name="shapes">Shapes.</param>
    /// <param name="registry">What tests them.</param>
    /// <param name="pool">Source of memory.</param>
    /// <param name="mover">The shape.</param>
    /// <param name="pose">Where it is, as the surface sees it.</param>
    /// <param name="margin">Greatest distance at which a contact exists, m.</param>
    /// <param name="triangle">The triangle.</param>
    public ConvexContactManifold Test(
        Shapes shapes, CollisionTaskRegistry registry, BufferPool pool, TypedIndex mover, RigidPose pose, float margin, int triangle)
    {
        var center = (triangles[triangle].A + triangles[triangle].B + triangles[triangle].C) / 3;
        var alone = shapes.Add(new Triangle(triangles[triangle].A - center, triangles[triangle].B - center, triangles[triangle].C - center));
        var found = new ConvexContactManifold[1];
        var batcher = new CollisionBatcher<Keeper>(pool, shapes, registry, 1 / 60f, new(found));
        batcher.Add(mover, alone, center - pose.Position, pose.Orientation, Quaternion.Identity, margin, new(0));
        batcher.Flush();
        shapes.Remove(alone);
        return found[0];
    }

    /// <summary>Whether children that agree lose nothing if a triangle is not tested: it is apart, and what is near enough is a neighbour's.</summary>
    /// <param name="alone">What the two have alone; the shape is A.</param>
    /// <param name="triangle">The triangle.</param>
    /// <param name="turn">Rotation from the surface to what the contacts are in.</param>
    public bool HasNothing(in ConvexContactManifold alone, int triangle, Quaternion? turn = null)
    {
        var normal = Vector3.Transform(alone.Normal, Quaternion.Conjugate(turn ?? Quaternion.Identity));
        var deepest = float.MinValue;
        for (int i = 0; i < alone.Count; ++i)
            deepest = float.Max(deepest, alone.GetDepth(i));
        return alone.Count == 0 || (deepest < 0 && IsOfNeighbour(triangle, normal));
    }

    readonly struct Keeper(ConvexContactManifold[] found) : ICollisionCallbacks
    {
        public bool AllowCollisionTesting(int pairId, int childA, int childB) => true;

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) { }

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> =>
            found[0] = (ConvexContactManifold)(object)manifold;
    }
}
