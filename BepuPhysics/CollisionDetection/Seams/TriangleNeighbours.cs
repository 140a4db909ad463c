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
static unsafe class TriangleNeighbours
{
    /// <summary>Finds for all sets that begin along which directions their triangles are touched.</summary>
    /// <param name="memory">The sets; receives the directions, in the order of the children that touch.</param>
    /// <param name="pool">Source of memory.</param>
    public static void FindDirections(ref SeamMemory memory, BufferPool pool)
    {
        Unsafe.SkipInit(out NeighbourLanes lanes);
        lanes.Clear();
        memory.Directions.EnsureCapacity(memory.Touching.Count, pool);
        foreach (ref var set in memory.Sets.AsSpan())
        {
            if (set.Stage == SeamStage.DirectionsOfB)
                FindDirections(ref memory, set, isAgain: false, ref lanes);
        }
        lanes.Find(memory.Directions.Span.Memory);
    }

    // Where both are triangles, B is first, and then A along what is found with that.
    static void FindDirections(ref SeamMemory memory, in SeamSet set, bool isAgain, ref NeighbourLanes lanes)
    {
        for (int i = set.First; i < set.First + set.Count; ++i)
        {
            var slot = memory.Touching[i].Slot;
            ref var placed = ref set.Placed[slot];
            var isA = isAgain || placed.TypeB != Triangle.Id;
            if ((isAgain && !placed.AreTriangles) || !IsSurface(placed, isA) || set.Results[slot].Manifold.Count == 0)
                continue;
            lanes.Add(placed, set.Results[slot].Manifold.Normal, isA, i);
            if (lanes.IsFull)
                lanes.Find(memory.Directions.Span.Memory);
        }
    }

    /// <summary>Looks children that were touched beyond their neighbours up along the direction of least depth of those that there are.</summary>
    /// <param name="memory">Receives the directions.</param>
    /// <param name="view">The children.</param>
    /// <param name="isA">Whether the triangles are those of A.</param>
    /// <param name="pool">Source of memory.</param>
    public static void AddDirections(ref SeamMemory memory, in SeamView view, bool isA, BufferPool pool)
    {
        var isAgain = false;
        for (int i = 0; i < view.Ranked.Length; ++i)
        {
            ref var child = ref view.Ranked[i];
            ref var placed = ref view.Placed(child);
            if (child.IsOfNeighbours || !IsSurface(placed, isA) || view.Result(child).Manifold.Count == 0)
                continue;
            if (isA && placed.AreTriangles && !isAgain)
            {
                isAgain = true;
                FindDirectionsAgain(ref memory, view.Set);
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

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void FindDirectionsAgain(ref SeamMemory memory, in SeamSet set)
    {
        Unsafe.SkipInit(out NeighbourLanes lanes);
        lanes.Clear();
        FindDirections(ref memory, set, isAgain: true, ref lanes);
        lanes.Find(memory.Directions.Span.Memory);
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
            if (!child.IsOfNeighbours)
                continue;
            view.Result(child).Manifold.Count = 0;
            view.Result(child).IsLeftToNeighbours = true;
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
}
