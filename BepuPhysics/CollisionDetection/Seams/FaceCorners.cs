using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// The contacts that a face with many corners would have on one endless plane in place of the flush faces that it slides over: each is a contact with that of
/// them which it is over.
/// </summary>
/// <remarks>
/// Of such a face each pair knows four contacts of its own, and at a seam the best four of all are not always among these. As the seam goes through
/// below, others would be the best in each step: the load jumps, the body is tilted, and hops. What hardly moves keeps what it has. If one of the four is
/// over none of the faces, or at another height, there is no such plane.
/// </remarks>
static unsafe class FaceCorners
{
    // Parts of the mover's inner radius: way within a step from which on it slides; by how much a face may be above or below the plane.
    const float LeastWay = 1e-2f;
    const float Level = 2e-4f;
    // Radius of the balls that find out what is below a corner, as a part of that, and how far the plane reaches.
    const float BallRadius = 1e-2f;
    const float PlaneReach = 16;
    // Cosine of 1e-2 rad. What leans a little has the normal of its own face here, and that of the floor there.
    const float SameNormal = 1 - 5e-5f;
    // Fewer are an edge, or a point.
    const int LeastCount = 3;

    /// <summary>Asks for the contacts with the plane, if a set is that of a face that slides over several with one normal.</summary>
    /// <param name="tests">Room for the tests.</param>
    /// <param name="view">The children that touch, in their order.</param>
    /// <param name="number">Number of the set.</param>
    /// <param name="pool">Source of memory.</param>
    public static void AddPlane(ref DirectedTests tests, in SeamView view, int number, BufferPool pool)
    {
        if (!IsOneFloor(view))
            return;
        Sort(view);
        ref var first = ref First(view);
        var normal = view.Result(first).Manifold.Normal;
        var plane = view.Placed(first);
        var size = PlaneReach * (MathF.Sqrt(Exact.LengthSquared(plane.OffsetB)) + 1);
        var box = new Box(size, size, size);
        plane.TypeB = Box.Id;
        plane.ShapeB.Write(Box.Id, &box);
        plane.OrientationB = QuaternionEx.GetQuaternionBetweenNormalizedVectors(Vector3.UnitY, normal);
        var deepest = Deepest(view);
        plane.OffsetB = deepest.Offset - view.Result(first).OffsetA + normal * (.5f * deepest.Depth - .5f * size);
        tests.Add(plane, normal, float.MaxValue, plane.SpeculativeMargin, number, pool);
    }

    /// <summary>Asks what is below each of the contacts with the plane.</summary>
    /// <param name="tests">Room for the tests.</param>
    /// <param name="view">The children that touch, in their order.</param>
    /// <param name="plane">The contacts with the plane.</param>
    /// <param name="pool">Source of memory.</param>
    public static void AddBalls(ref DirectedTests tests, in SeamView view, in DirectedPair plane, BufferPool pool)
    {
        if (plane.Manifold.Count < LeastCount)
            return;
        var ball = new Sphere(BallRadius * view.Placed(view.Ranked[0]).InnerRadius());
        for (int i = 0; i < view.Ranked.Length; ++i)
        {
            for (int j = 0; j < plane.Manifold.Count && view.Result(view.Ranked[i]).Manifold.Count > 0; ++j)
            {
                var contact = plane.Manifold.Read(j);
                var place = contact.Offset + plane.Normal * (ball.Radius - .5f * contact.Depth);
                var placed = view.Placed(view.Ranked[i]);
                placed.TypeA = Sphere.Id;
                placed.ShapeA.Write(Sphere.Id, &ball);
                placed.OffsetB -= place;
                tests.Add(placed, plane.Normal, float.MaxValue, placed.SpeculativeMargin, i, pool);
            }
        }
    }

    /// <summary>Takes the contacts with the plane, if each of them is over one of the faces.</summary>
    /// <param name="tests">What was found: all corners of the first child, then those of the next.</param>
    /// <param name="view">The children that touch, in their order.</param>
    /// <param name="plane">The contacts with the plane.</param>
    public static void Take(in DirectedTests tests, in SeamView view, in DirectedPair plane)
    {
        if (view.Set.Tests.Count == 0)
            return;
        var count = plane.Manifold.Count;
        Span<int> owners = [-1, -1, -1, -1];
        Span<float> depths = stackalloc float[ConvexContactManifold.MaximumContactCount];
        var level = Level * view.Placed(view.Ranked[0]).InnerRadius();
        for (int k = view.Set.Tests.First; k < view.Set.Tests.End; ++k)
        {
            ref var found = ref tests[k];
            var corner = (k - view.Set.Tests.First) % count;
            if (found.Manifold.Count == 0 || owners[corner] >= 0)
                continue;
            owners[corner] = found.Owner;
            depths[corner] = found.Manifold.Contact0.Depth;
        }
        var (least, greatest) = (float.MaxValue, float.MinValue);
        for (int j = 0; j < count; ++j)
        {
            if (owners[j] < 0)
                return;
            var height = depths[j] - plane.Manifold.Read(j).Depth;
            (least, greatest) = (MathF.Min(least, height), MathF.Max(greatest, height));
        }
        if (greatest - least > level)
            return;
        view.Set.IsOnPlane = true;
        for (int i = 0; i < view.Ranked.Length; ++i)
        {
            ref var child = ref view.Ranked[i];
            ref var result = ref view.Result(child);
            child.HasYielded |= result.Manifold.Count > 0;
            result.Manifold.Count = 0;
            result.Manifold.Normal = plane.Normal;
            for (int j = 0; j < count; ++j)
            {
                if (owners[j] != i)
                    continue;
                var contact = plane.Manifold.Read(j);
                contact.Offset += result.OffsetA + plane.Normal * (.5f * (depths[j] - contact.Depth));
                contact.Depth = depths[j];
                ConvexContactManifold.GetConvexContactReference(ref result.Manifold, result.Manifold.Count++) = contact;
            }
        }
    }

    // Where all have one normal they were not brought in order yet.
    static void Sort(in SeamView view)
    {
        if (view.Set.Index >= 0)
            return;
        view.Set.Count = SeamMemory.Sort(view.Ranked, view.Set.Results);
        view.Set.Index = 0;
    }

    // A convex shape with many corners on several others that move alike, none of which is fixed, all with one normal.
    static bool IsOneFloor(in SeamView view)
    {
        var ranked = view.Ranked;
        if (ranked.Length < 2)
            return false;
        ref var first = ref First(view);
        ref var placed = ref view.Placed(first);
        var type = placed.MoverIsB ? placed.TypeB : placed.TypeA;
        // Within a pair a disc goes on with the corners that the pair remembers, and these are others. A box shows its corners on each of several boxes, but on
        // a triangle that cuts some of them off it shows others.
        var isOfPair = first.Pair == 0;
        if (placed.MoverIsB || (type != ConvexHull.Id && (type != Cylinder.Id || isOfPair) && (type != Box.Id || !isOfPair)))
            return false;
        var least = LeastWay * placed.InnerRadius();
        if (Exact.LengthSquared(placed.Motion.Way) < least * least)
            return false;
        ref var result = ref view.Result(first);
        var count = 0;
        for (int i = 0; i < ranked.Length; ++i)
        {
            ref var other = ref view.Result(ranked[i]);
            if (other.Manifold.Count == 0)
                continue;
            if (!view.Placed(ranked[i]).AreKnown || ranked[i].Group != first.Group || other.Children.A != result.Children.A ||
                Exact.Dot(other.Manifold.Normal, result.Manifold.Normal) < SameNormal)
                return false;
            ++count;
        }
        return count > 0;
    }

    // The first child that has contacts; any where none has.
    static ref RankedChild First(in SeamView view)
    {
        var first = 0;
        while (first + 1 < view.Ranked.Length && view.Result(view.Ranked[first]).Manifold.Count == 0)
            ++first;
        return ref view.Ranked[first];
    }

    static ConvexContact Deepest(in SeamView view)
    {
        var deepest = new ConvexContact { Depth = float.MinValue };
        foreach (ref var child in view.Ranked)
        {
            ref var manifold = ref view.Result(child).Manifold;
            for (int i = 0; i < manifold.Count; ++i)
                deepest = manifold.Read(i).Depth > deepest.Depth ? manifold.Read(i) : deepest;
        }
        return deepest;
    }
}
