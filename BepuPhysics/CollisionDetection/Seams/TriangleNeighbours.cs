using System.Numerics;
using System.Runtime.CompilerServices;
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
    // A direction as steep to the triangle's normal as this cosine says is the neighbours'.
    public const float LeastCosine = 0.05f;
    // Part of the sizes by which a feature must be beside a triangle to have nothing over it: far above the rounding of the test that looks for it.
    public const float Beside = 1e-4f;
    // Bounds that meet at a corner are gone over until none is left, or it is seen that they cannot all be met.
    public const int MaximumClampCount = 4;

    /// <summary>Finds for all sets that begin along which directions their triangles are touched, but for those that touch triangles.</summary>
    /// <param name="memory">The sets; receives the directions, in the order of the children that touch.</param>
    /// <param name="pool">Source of memory.</param>
    public static unsafe void FindDirections(ref SeamMemory memory, BufferPool pool)
    {
        Unsafe.SkipInit(out NeighbourLanes lanes);
        lanes.Clear();
        memory.Directions.EnsureCapacity(memory.Touching.Count, pool);
        var directions = memory.Directions.Span.Memory;
        foreach (ref var set in memory.Sets.AsSpan())
        {
            for (int i = set.First; set.Stage == SeamStage.DirectionsOfB && i < set.First + set.Count; ++i)
            {
                var slot = memory.Touching[i].Slot;
                ref var placed = ref set.Placed[slot];
                if (placed.AreTriangles || (!IsSurface(placed, isA: false) && !IsSurface(placed, isA: true)))
                    continue;
                lanes.Add(placed, set.Results[slot].Manifold.Normal, placed.TypeA == Triangle.Id, i);
                if (lanes.IsFull)
                    lanes.Find(directions);
            }
        }
        lanes.Find(directions);
    }

    /// <summary>Looks children that were touched beyond their neighbours up along the direction of least depth of those that there are.</summary>
    /// <param name="memory">Receives the directions.</param>
    /// <param name="view">The children.</param>
    /// <param name="isA">Whether the triangles are those of A.</param>
    /// <param name="pool">Source of memory.</param>
    public static void AddDirections(ref SeamMemory memory, in SeamView view, bool isA, BufferPool pool)
    {
        for (int i = 0; i < view.Ranked.Length; ++i)
        {
            ref var child = ref view.Ranked[i];
            ref var placed = ref view.Placed(child);
            if (child.IsOfNeighbours || !IsSurface(placed, isA))
                continue;
            if (placed.AreTriangles)
            {
                ref var manifold = ref view.Result(child).Manifold;
                if (manifold.Count > 0)
                    AddDirections(ref memory.Tests, placed, manifold.Normal, isA, i, ref child, pool);
                continue;
            }
            ref var found = ref memory.Directions.Span[view.Set.First + i];
            if (found.Side == TouchedSide.Own)
                continue;
            child.Class = 1;
            child.IsOfNeighbours = found.Side == TouchedSide.Neighbours;
            if (!child.IsOfNeighbours)
                memory.Tests.Add(placed, isA ? -found.Direction : found.Direction, float.MaxValue, placed.SpeculativeMargin, i, pool);
        }
    }

    /// <summary>Takes what was found along these directions.</summary>
    /// <param name="tests">What was found, in the order of children.</param>
    /// <param name="view">The children.</param>
    public static void Take(in DirectedTests tests, in SeamView view)
    {
        var last = view.Set.Tests;
        for (int i = last.First; i < last.End; ++i)
        {
            ref var test = ref tests[i];
            ref var child = ref view.Ranked[test.Owner];
            child.IsOfNeighbours = test.Manifold.Count == 0;
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
    public static void Settle(in SeamView view)
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
    static bool IsOfNobody(in SeamView view, int count)
    {
        var deepest = 0f;
        foreach (ref var child in view.Ranked)
        {
            if (!child.IsOfNeighbours && view.Result(child).Manifold.Count > 0)
                return false;
            if (child.IsOfNeighbours)
                deepest = MathHelper.Max(deepest, view.Result(child).Manifold.GreatestDepth);
        }
        return (count > 1 || view.Set.LeavesToNeighbours) && deepest > 0;
    }

    /// <summary>Whether what touches along a normal touches a neighbour of one of two children.</summary>
    public static bool Has(in PlacedChildren placed, in Vector3 normal) => IsBeyond(placed, normal, isA: true) || IsBeyond(placed, normal, isA: false);

    static bool IsBeyond(in PlacedChildren placed, in Vector3 normal, bool isA)
    {
        if (!IsSurface(placed, isA))
            return false;
        Place(placed, isA, out var surface);
        surface.Bound(isA ? placed.ConeA : placed.ConeB);
        return surface.Violated(isA ? -normal : normal) != default;
    }

    // Nothing is next to what is no triangle of a surface.
    static bool IsSurface(in PlacedChildren placed, bool isA) =>
        placed.AreKnown && (isA ? placed.TypeA : placed.TypeB) == Triangle.Id && (isA ? placed.ConeA : placed.ConeB).Cosines != default;

    static void Place(in PlacedChildren placed, bool isA, out TriangleSurface surface)
    {
        Unsafe.SkipInit(out surface);
        ref readonly var shape = ref isA ? ref placed.ShapeA : ref placed.ShapeB;
        surface.Place(shape.Read<Triangle>(), isA ? placed.OrientationA : placed.OrientationB);
    }

    /// <summary>A vector along the normal of a triangle.</summary>
    public static Vector3 FaceVector(in PlacedChildren placed, bool isA)
    {
        Place(placed, isA, out var surface);
        return surface.Face;
    }

    // Along the triangle's normal, as faces touch. No bound leans towards the normal, so that what is as near to it is beyond none.
    static bool IsFaceNormal(in Vector3 face, in Vector3 direction)
    {
        const float beyond = TriangleSurface.Beyond;
        var along = Exact.Dot(direction, face);
        var across = Exact.Cross(direction, face);
        // All but the square of the sine of the angle between the two.
        return along > 0 && Exact.Dot(across, across) < beyond * beyond / 4 * Exact.Dot(face, face);
    }

    static void AddDirections(ref DirectedTests tests, in PlacedChildren placed, in Vector3 normal, bool isA, int owner, ref RankedChild child, BufferPool pool)
    {
        var direction = isA ? -normal : normal;
        // Two triangles that face each other do not meet any more once one has sunk into the other. What holds them then are the triangles beside them,
        // which stand on the face of the other mesh with their edges, along its normal.
        Place(placed, isA, out var surface);
        if (IsFaceNormal(surface.Face, direction) || (placed.AreTriangles && IsFaceNormal(FaceVector(placed, !isA), -direction)))
            return;
        ref readonly var cone = ref isA ? ref placed.ConeA : ref placed.ConeB;
        surface.Bound(cone);
        // What is at the back of a triangle that has two sides has other neighbours there. In the plane of the triangle the sign is rounding.
        if (Exact.Dot(direction, surface.Normal) < -TriangleFeature.BehindSine)
            return;
        var bound = surface.Violated(direction);
        if (bound == default)
            return;
        ref readonly var triangle = ref isA ? ref placed.ShapeA : ref placed.ShapeB;
        ref readonly var shape = ref isA ? ref placed.ShapeB : ref placed.ShapeA;
        surface.PlaceCorners(triangle.Read<Triangle>(), isA ? placed.OrientationA : placed.OrientationB);
        var other = new ShapeReach(isA ? placed.TypeB : placed.TypeA, shape, isA ? placed.OrientationB : placed.OrientationA);
        var center = isA ? -placed.OffsetB : placed.OffsetB;
        var best = new LeastDirection(surface.Normal, DepthAlong(surface.Normal, surface, other, center));
        if (cone.Sines != default)
        {
            var clamped = direction;
            for (int i = 0; i < MaximumClampCount && bound != default; ++i)
            {
                clamped = Exact.Normalize(clamped - bound * Exact.Dot(clamped, bound));
                bound = surface.Violated(clamped);
            }
            if (bound == default)
                best.Add(clamped, DepthAlong(clamped, surface, other, center));
            for (int edge = 0; edge < 3; ++edge)
            {
                var (cosine, sine) = (cone.Cosines[edge], cone.Sines[edge]);
                if (sine > 0 && surface.IsBound(edge))
                {
                    var neighbours = surface.Normal * cosine + surface.Outwards(edge) * sine;
                    best.Add(neighbours, DepthAlong(neighbours, surface, other, center));
                }
            }
        }
        child.Class = 1;
        if (HasNone(best, placed, surface, other, center))
            child.IsOfNeighbours = true;
        else
            tests.Add(placed, isA ? -best.Direction : best.Direction, float.MaxValue, placed.SpeculativeMargin, owner, pool);
    }

    // By how much the two are in each other along a direction out of the triangle.
    static float DepthAlong(in Vector3 direction, in TriangleSurface surface, in ShapeReach other, in Vector3 center) =>
        Exact.Dot(center, direction) + surface.Along(direction) + other.Along(-direction);

    // Whether there are no contacts for sure, without a test: the direction is the neighbours', or what touches is beside the triangle. What is near to that is
    // tested. What is a triangle too may have gone through the neighbour, and be seen by nobody else.
    static bool HasNone(in LeastDirection best, in PlacedChildren placed, in TriangleSurface surface, in ShapeReach other, in Vector3 center)
    {
        if (placed.AreTriangles)
            return false;
        if (Exact.Dot(best.Direction, surface.Normal) < LeastCosine)
            return true;
        if (!other.TryFindFeature(-best.Direction, out var feature))
            return false;
        var tolerance = Beside * (other.Size + surface.Size + Exact.Length(center));
        return best.Depth < -placed.SpeculativeMargin - tolerance || surface.IsBeside(best.Direction, feature, center, tolerance);
    }

    // The direction of least depth of those that there are.
    struct LeastDirection(in Vector3 direction, float depth)
    {
        public Vector3 Direction = direction;
        public float Depth = depth;

        public void Add(in Vector3 direction, float depth)
        {
            if (depth < Depth)
                (Direction, Depth) = (direction, depth);
        }
    }
}
