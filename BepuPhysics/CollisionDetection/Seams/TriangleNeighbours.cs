using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Keeps the normals of triangles of a surface between those of their neighbours.</summary>
/// <remarks>
/// A triangle that is tested as if it were alone is touched at its edges from all around. In a surface the part of these directions that is beyond the
/// neighbour's normal is the neighbour's, and there is none at an edge at which the surface is flat or bends towards the front. What is touched from such
/// a direction is touched along the one of least depth of those that there are: the triangle's normal, those of the neighbours, and the one between them
/// that is nearest. If it is not over the triangle then, it touches a neighbour, and not this.
/// </remarks>
static class TriangleNeighbours
{
    // Sine by which a direction may be beyond a neighbour's.
    const float Beyond = 1e-4f;
    // A direction as steep to the triangle's normal as this cosine says is the neighbours'.
    const float LeastCosine = 0.05f;
    // Bounds that meet at a corner are gone over until none is left, or it is seen that they cannot all be met.
    const int MaximumClampCount = 4;

    // A triangle as it lies in the world.
    struct Surface
    {
        public Vector3 Normal;
        // Directions in its plane out of each edge; bounds of directions at each edge.
        public Vector3 Out0, Out1, Out2, Bound0, Bound1, Bound2;
        // Corners, less the first.
        readonly Vector3 corner1, corner2;
        public readonly bool IsA;

        public Surface(in Triangle triangle, in Quaternion orientation, in TriangleCone cone, bool isA)
        {
            IsA = isA;
            var ab = Exact.Rotate(triangle.B - triangle.A, orientation);
            var bc = Exact.Rotate(triangle.C - triangle.B, orientation);
            var ca = Exact.Rotate(triangle.A - triangle.C, orientation);
            (corner1, corner2) = (ab, -ca);
            Normal = Exact.Normalize(Exact.Cross(ab, ca));
            Out0 = Exact.Normalize(Exact.Cross(Normal, ab));
            Out1 = Exact.Normalize(Exact.Cross(Normal, bc));
            Out2 = Exact.Normalize(Exact.Cross(Normal, ca));
            Bound0 = (cone.FreeMask & 1) != 0 ? default : Out0 * cone.Cosines.X - Normal * cone.Sines.X;
            Bound1 = (cone.FreeMask & 2) != 0 ? default : Out1 * cone.Cosines.Y - Normal * cone.Sines.Y;
            Bound2 = (cone.FreeMask & 4) != 0 ? default : Out2 * cone.Cosines.Z - Normal * cone.Sines.Z;
        }

        // The direction of the bound that a direction is farthest beyond; zero where it is beyond none.
        public readonly Vector3 Violated(in Vector3 direction)
        {
            // What touches the triangle elsewhere is not at an edge: where the triangle is obtuse, it may lean beyond that all the same.
            var (reach1, reach2) = (Exact.Dot(direction, corner1), Exact.Dot(direction, corner2));
            var farthest = MathHelper.Max(0, MathHelper.Max(reach1, reach2)) - Beyond * MathHelper.Max(Exact.Length(corner1), Exact.Length(corner2));
            var (most, bound) = (Beyond, default(Vector3));
            if (IsAtEdge(0, reach1, reach2, farthest) && Exact.Dot(direction, Bound0) is var first && first > most)
                (most, bound) = (first, Bound0);
            if (IsAtEdge(reach1, reach2, 0, farthest) && Exact.Dot(direction, Bound1) is var second && second > most)
                (most, bound) = (second, Bound1);
            if (IsAtEdge(reach2, 0, reach1, farthest) && Exact.Dot(direction, Bound2) > most)
                bound = Bound2;
            return bound;
        }

        // Whether the farthest point is one of an edge, by how far its ends and the corner opposite are: not that corner, unless the edge is as far as a whole.
        static bool IsAtEdge(float a, float b, float opposite, float farthest) => opposite < farthest || (a >= farthest && b >= farthest);
    }

    /// <summary>Looks children that were touched beyond their neighbours up along the directions that there are.</summary>
    /// <param name="tests">Receives the directions.</param>
    /// <param name="view">The children.</param>
    /// <param name="isA">Whether the triangles are those of A.</param>
    /// <param name="pool">Source of memory.</param>
    public static void AddDirections(ref DirectedTests tests, SeamView view, bool isA, BufferPool pool)
    {
        for (int i = 0; i < view.Ranked.Length; ++i)
        {
            ref var placed = ref view.Placed(view.Ranked[i]);
            ref var manifold = ref view.Result(view.Ranked[i]).Manifold;
            if (manifold.Count > 0 && !view.Ranked[i].IsOfNeighbours && IsSurface(placed, isA))
                AddDirections(ref tests, placed, manifold.Normal, isA, i, pool);
        }
    }

    /// <summary>Looks for contacts along the direction of least depth of each child.</summary>
    /// <param name="tests">The directions, in the order of children, and then these.</param>
    /// <param name="view">The children.</param>
    /// <param name="pool">Source of memory.</param>
    public static void AddChoice(ref DirectedTests tests, SeamView view, BufferPool pool)
    {
        var last = view.Set.Tests;
        for (int i = last.First; i < last.End; ++i)
        {
            var best = i;
            for (; i + 1 < last.End && tests[i + 1].Owner == tests[best].Owner; ++i)
                best = tests[i + 1].Depth < tests[best].Depth ? i + 1 : best;
            var owner = tests[best].Owner;
            ref var placed = ref view.Placed(view.Ranked[owner]);
            tests.Add(placed, tests[best].Normal, float.MaxValue, placed.SpeculativeMargin, owner, pool);
        }
    }

    /// <summary>Takes what was found along the chosen directions.</summary>
    /// <param name="tests">What was found.</param>
    /// <param name="view">The children.</param>
    /// <param name="isA">Whether the triangles are those of A.</param>
    public static void Take(in DirectedTests tests, SeamView view, bool isA)
    {
        for (int i = view.Set.Tests.First; i < view.Set.Tests.End; ++i)
        {
            ref var test = ref tests[i];
            ref var child = ref view.Ranked[test.Owner];
            child.Class = 1;
            // What is a triangle too may have gone through the neighbour, and be seen by nobody else.
            child.IsOfNeighbours = test.Manifold.Count == 0 || (!view.Placed(child).AreTriangles &&
                Exact.Dot(isA ? -test.Normal : test.Normal, Exact.Normalize(FaceVector(view.Placed(child), isA))) < LeastCosine);
            if (!child.IsOfNeighbours)
                view.Result(child).Replace(test);
        }
    }

    /// <summary>Leaves out what is the neighbours', if a neighbour has it.</summary>
    /// <remarks>
    /// At a corner of a saddle no direction is within the bounds of any triangle, as the surface bends away along one line and to the front along another.
    /// Each of several may take what is in it for one of the others' then: where none is left, all are as they were found.
    /// </remarks>
    /// <param name="view">The children that touch.</param>
    public static void Settle(SeamView view)
    {
        var count = 0;
        foreach (ref var child in view.Ranked)
            count += child.IsOfNeighbours ? 1 : 0;
        if (count == 0 || IsOfNobody(view, count))
            return;
        foreach (ref var child in view.Ranked)
        {
            if (child.IsOfNeighbours)
                view.Result(child).Manifold.Count = 0;
        }
    }

    // What has no depth yet may be the neighbours' that are not near enough.
    static bool IsOfNobody(SeamView view, int count)
    {
        var deepest = 0f;
        foreach (ref var child in view.Ranked)
        {
            if (!child.IsOfNeighbours && view.Result(child).Manifold.Count > 0)
                return false;
            if (child.IsOfNeighbours)
                deepest = MathHelper.Max(deepest, view.Result(child).Manifold.GreatestDepth);
        }
        return count > 1 && deepest > 0;
    }

    /// <summary>Whether what touches along a normal touches a neighbour of one of two children.</summary>
    public static bool Has(in PlacedChildren placed, in Vector3 normal) => IsBeyond(placed, normal, isA: true) || IsBeyond(placed, normal, isA: false);

    static bool IsBeyond(in PlacedChildren placed, in Vector3 normal, bool isA) =>
        IsSurface(placed, isA) && Create(placed, isA).Violated(isA ? -normal : normal) != default;

    // Nothing is next to what is no triangle of a surface.
    static bool IsSurface(in PlacedChildren placed, bool isA) =>
        placed.AreKnown && (isA ? placed.TypeA : placed.TypeB) == Triangle.Id && (isA ? placed.ConeA : placed.ConeB).Cosines != default;

    static Surface Create(in PlacedChildren placed, bool isA) => isA
        ? new(placed.ShapeA.Read<Triangle>(), placed.OrientationA, placed.ConeA, isA)
        : new(placed.ShapeB.Read<Triangle>(), placed.OrientationB, placed.ConeB, isA);

    /// <summary>A vector along the normal of a triangle, by the operations that its surface finds it by.</summary>
    public static Vector3 FaceVector(in PlacedChildren placed, bool isA)
    {
        var triangle = isA ? placed.ShapeA.Read<Triangle>() : placed.ShapeB.Read<Triangle>();
        var orientation = isA ? placed.OrientationA : placed.OrientationB;
        return Exact.Cross(Exact.Rotate(triangle.B - triangle.A, orientation), Exact.Rotate(triangle.A - triangle.C, orientation));
    }

    // Along the triangle's normal, as faces touch. No bound leans towards the normal, so that what is as near to it is beyond none.
    static bool IsFaceNormal(in PlacedChildren placed, in Vector3 direction, bool isA)
    {
        var normal = FaceVector(placed, isA);
        var along = Exact.Dot(direction, normal);
        var across = Exact.Cross(direction, normal);
        // All but the square of the sine of the angle between the two.
        return along > 0 && Exact.Dot(across, across) < Beyond * Beyond / 4 * Exact.Dot(normal, normal);
    }

    static void AddDirections(ref DirectedTests tests, in PlacedChildren placed, in Vector3 normal, bool isA, int owner, BufferPool pool)
    {
        var direction = isA ? -normal : normal;
        // Two triangles that face each other do not meet any more once one has sunk into the other. What holds them then are the triangles beside them,
        // which stand on the face of the other mesh with their edges, along its normal.
        if (IsFaceNormal(placed, direction, isA) || (placed.AreTriangles && IsFaceNormal(placed, -direction, !isA)))
            return;
        var surface = Create(placed, isA);
        // What is at the back of a triangle that has two sides has other neighbours there. In the plane of the triangle the sign is rounding.
        if (Exact.Dot(direction, surface.Normal) < -TriangleFeature.BehindSine || surface.Violated(direction) == default)
            return;
        Add(ref tests, placed, surface.Normal, isA, owner, pool);
        var cone = isA ? placed.ConeA : placed.ConeB;
        if (cone.Sines == default)
            return;
        var clamped = direction;
        for (int i = 0; i < MaximumClampCount && surface.Violated(clamped) is var bound && bound != default; ++i)
            clamped = Exact.Normalize(clamped - bound * Exact.Dot(clamped, bound));
        if (surface.Violated(clamped) == default)
            Add(ref tests, placed, clamped, isA, owner, pool);
        AddNeighbour(ref tests, placed, surface, surface.Out0, surface.Bound0, cone.Cosines.X, cone.Sines.X, owner, pool);
        AddNeighbour(ref tests, placed, surface, surface.Out1, surface.Bound1, cone.Cosines.Y, cone.Sines.Y, owner, pool);
        AddNeighbour(ref tests, placed, surface, surface.Out2, surface.Bound2, cone.Cosines.Z, cone.Sines.Z, owner, pool);
    }

    static void AddNeighbour(ref DirectedTests tests, in PlacedChildren placed, in Surface surface, in Vector3 outwards, in Vector3 bound,
        float cosine, float sine, int owner, BufferPool pool)
    {
        if (bound != default && sine > 0)
            Add(ref tests, placed, surface.Normal * cosine + outwards * sine, surface.IsA, owner, pool);
    }

    static void Add(ref DirectedTests tests, in PlacedChildren placed, in Vector3 direction, bool isA, int owner, BufferPool pool) =>
        tests.Add(placed, isA ? -direction : direction, float.MinValue, placed.SpeculativeMargin, owner, pool);
}
