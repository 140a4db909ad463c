using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Demos.References;
using DemoTests.Support;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>Along which directions triangles of surfaces are touched, against double precision and against the test that is spared.</summary>
public sealed unsafe class NeighbourLanesTests : IDisposable
{
    const int CaseCount = 400;

    readonly BufferPool pool = new();

    public void Dispose() => pool.Clear();

    public static TheoryData<ConvexKind> Kinds => new(Enum.GetValues<ConvexKind>());

    // A triangle, which is B, that another shape touches.
    sealed class Case
    {
        public PlacedChildren Placed;
        public Vector3 Normal;
        public required ConvexShape Other;
        public double Sizes;

        public TouchedDirection Find()
        {
            NeighbourLanes lanes = default;
            lanes.Add(Placed, Normal, isA: false, 0);
            TouchedDirection found;
            lanes.Find(&found);
            return found;
        }

        // By how much the two are in each other along a direction.
        public double DepthAlong(Double3 direction)
        {
            var corners = new Surface(Placed).Corners;
            var local = ConvexRotation.From(Placed.OrientationA).RotateBack(direction);
            return Double3.Dot(Placed.OffsetB, direction) + corners.Max(corner => Double3.Dot(corner, direction)) + Other.CoreExtent(-local) + Other.Rounding;
        }
    }

    // The triangle in double precision.
    sealed class Surface
    {
        public readonly Double3[] Corners, Edges = new Double3[3], Outwards = new Double3[3];
        public readonly Double3 Normal;

        // Height over length.
        public double Flatness => Double3.Cross(Edges[0], Edges[2]).Length / Edges.Max(edge => edge.LengthSquared);

        public Surface(in PlacedChildren placed)
        {
            var triangle = placed.ShapeB.Read<Triangle>();
            var rotation = ConvexRotation.From(placed.OrientationB);
            Corners = [rotation.Rotate(triangle.A), rotation.Rotate(triangle.B), rotation.Rotate(triangle.C)];
            for (int edge = 0; edge < 3; ++edge)
                Edges[edge] = Corners[(edge + 1) % 3] - Corners[edge];
            Normal = Unit(Double3.Cross(Edges[0], Edges[2]));
            for (int edge = 0; edge < 3; ++edge)
                Outwards[edge] = Unit(Double3.Cross(Normal, Edges[edge]));
        }
    }

    static Double3 Unit(Double3 v) => v * (1 / v.Length);

    Case Create(ConvexKind kind, ConvexRandom random)
    {
        var (sizeA, sizeB) = ConvexPoses.NextSizes(random);
        var a = DepthSearchShapes.Create(kind, ConvexGenerator.NextForm(random), sizeA, random, pool);
        var b = DepthSearchShapes.Create(ConvexKind.Triangle, ConvexGenerator.NextForm(random), sizeB, random, pool);
        var created = new Case { Other = a.Reference };
        ref var placed = ref created.Placed;
        placed.OrientationA = random.NextOrientation();
        placed.OrientationB = random.NextOrientation();
        placed.TypeA = DirectedPairTests.Write(ref placed.ShapeA, a);
        placed.TypeB = DirectedPairTests.Write(ref placed.ShapeB, b);
        placed.ConeB.FreeMask = random.Next(3) == 0 ? random.Next(8) : 0;
        for (int edge = 0; edge < 3; ++edge)
        {
            var angle = random.Next(4) == 0 || (placed.ConeB.FreeMask >> edge & 1) != 0 ? 0 : random.Next(.1, 1);
            placed.ConeB.Cosines[edge] = (float)Math.Cos(angle);
            placed.ConeB.Sines[edge] = (float)Math.Sin(angle);
        }
        created.Sizes = a.Reference.OuterRadius + a.Reference.Middle.Length + b.Reference.OuterRadius + b.Reference.Middle.Length;
        placed.SpeculativeMargin = (float)created.Sizes;
        var surface = new Surface(placed);
        // Leans out of an edge, so that it is beyond the neighbour there or not.
        var lean = surface.Outwards[random.Next(3)] * random.Next(.2, 3) + random.NextDirection() * .2;
        created.Normal = Vector3.Normalize(ConvexGenerator.ToVector(surface.Normal + lean));
        Place(created, created.Normal, random);
        return created;
    }

    // At any place near, a hundredth of the sizes deep along a direction.
    static void Place(Case placed, Vector3 direction, ConvexRandom random)
    {
        placed.Placed.OffsetB = ConvexGenerator.ToVector(random.NextDirection() * (.5 * placed.Sizes));
        var depth = placed.DepthAlong(direction);
        placed.Placed.OffsetB += direction * (float)(.01 * placed.Sizes - depth);
    }

    /// <summary>A direction within bounds stays. Any other becomes that of least depth of the normal, those of the neighbours and the nearest within bounds.
    /// </summary>
    [Theory, MemberData(nameof(Kinds))]
    public void Directions_are_those_of_least_depth(ConvexKind kind)
    {
        const double near = 1e-3;
        var random = new ConvexRandom(ConvexPoses.DevelopmentSeed, (ulong)(400 + (int)kind));
        var (own, turned, between) = (0, 0, 0);
        for (int i = 0; i < CaseCount; ++i)
        {
            var created = Create(kind, random);
            var cone = created.Placed.ConeB;
            var surface = new Surface(created.Placed);
            var found = created.Find();
            var bounds = new Double3?[3];
            for (int edge = 0; edge < 3; ++edge)
            {
                if ((cone.FreeMask >> edge & 1) == 0)
                    bounds[edge] = surface.Outwards[edge] * cone.Cosines[edge] - surface.Normal * cone.Sines[edge];
            }
            // What leans out of an edge touches that edge, unless the triangle is obtuse.
            var beyond = Enumerable.Range(0, 3).Where(edge => bounds[edge] is Double3 bound && Double3.Dot(bound, created.Normal) > near).ToArray();
            if (beyond.Length == 0)
            {
                if (bounds.All(bound => bound is not Double3 known || Double3.Dot(known, created.Normal) < -near))
                    Assert.Equal(TouchedSide.Own, found.Side);
                ++own;
                continue;
            }
            if (found.Side == TouchedSide.Own)
            {
                Assert.Contains(Enumerable.Range(0, 3), edge => Double3.Dot(surface.Edges[edge], surface.Edges[(edge + 1) % 3]) > 0);
                continue;
            }
            ++turned;
            var depth = created.DepthAlong(found.Direction);
            Double3[] others = [surface.Normal, .. Enumerable.Range(0, 3).Where(edge => bounds[edge] != null && cone.Sines[edge] > 0)
                .Select(edge => surface.Normal * cone.Cosines[edge] + surface.Outwards[edge] * cone.Sines[edge])];
            Assert.Equal(1, found.Direction.Length(), 1e-5f);
            // Of a sliver the normal is as exact as its edges are against its height.
            var rounding = (2e-6 + 4e-7 / surface.Flatness) * created.Sizes;
            Assert.All(others, other => Assert.True(depth < created.DepthAlong(other) + rounding, $"{i}"));
            if (others.All(other => (other - found.Direction).Length > near))
            {
                // Between the neighbours: as near to what it was as the bounds allow, so on one of those.
                ++between;
                Assert.Contains(bounds, bound => bound is Double3 known && Math.Abs(Double3.Dot(known, found.Direction)) < near);
            }
        }
        Assert.True(own > CaseCount / 50 && turned > CaseCount / 2 && between > CaseCount / 50, $"{own}, {turned}, {between}");
    }

    /// <summary>Where a triangle is said to be beside what touches it, the test finds no contacts; and that is most of what has none.</summary>
    [Theory, MemberData(nameof(Kinds))]
    public void What_is_a_neighbours_has_no_contacts(ConvexKind kind)
    {
        var random = new ConvexRandom(ConvexPoses.DevelopmentSeed, (ulong)(200 + (int)kind));
        var tests = new DirectedTests();
        var sides = new TouchedSide[CaseCount];
        for (int i = 0; i < CaseCount; ++i)
        {
            var created = Create(kind, random);
            Place(created, created.Find() is { Side: not TouchedSide.Own } first ? first.Direction : created.Normal, random);
            var found = created.Find();
            sides[i] = found.Side;
            var direction = found.Side == TouchedSide.Own ? created.Normal : found.Direction;
            tests.Add(created.Placed, direction, float.MaxValue, created.Placed.SpeculativeMargin, i, pool);
        }
        tests.Execute();
        var (beside, without) = (0, 0);
        for (int i = 0; i < CaseCount; ++i)
        {
            Assert.False(sides[i] == TouchedSide.Neighbours && tests[i].Manifold.Count > 0, $"{i}");
            beside += sides[i] == TouchedSide.Neighbours ? 1 : 0;
            without += sides[i] != TouchedSide.Own && tests[i].Manifold.Count == 0 ? 1 : 0;
        }
        if (kind is ConvexKind.Hull or ConvexKind.Triangle)
            Assert.Equal(0, beside);
        else
            Assert.InRange(beside, Math.Max(1, without / 2), without);
        tests.Dispose(pool);
    }

    /// <summary>A lane has the same bits whatever is beside it, and in whichever lane it is; also where A is the triangle.</summary>
    [Fact]
    public void Lanes_are_as_alone()
    {
        var random = new ConvexRandom(ConvexPoses.DevelopmentSeed, 500);
        var kinds = Enum.GetValues<ConvexKind>();
        var cases = Enumerable.Range(0, 300).Select(i => Create(kinds[random.Next(kinds.Length)], random)).ToArray();
        var together = new TouchedDirection[cases.Length];
        NeighbourLanes lanes = default;
        fixed (TouchedDirection* found = together)
        {
            for (int i = 0; i < cases.Length; ++i)
            {
                var placed = cases[i].Placed;
                if (i % 3 == 0)
                    placed = Flip(placed);
                lanes.Add(placed, i % 3 == 0 ? -cases[i].Normal : cases[i].Normal, i % 3 == 0, i);
                if (lanes.IsFull)
                    lanes.Find(found);
            }
            lanes.Find(found);
        }
        for (int i = 0; i < cases.Length; ++i)
        {
            var alone = cases[i].Find();
            Assert.Equal(alone.Side, together[i].Side);
            if (alone.Side != TouchedSide.Own)
                Assert.Equal(alone.Direction, together[i].Direction);
        }
        Assert.InRange(together.Count(found => found.Side == TouchedSide.Neighbours), 20, 200);
    }

    static PlacedChildren Flip(PlacedChildren placed)
    {
        (placed.TypeA, placed.TypeB) = (placed.TypeB, placed.TypeA);
        (placed.ShapeA, placed.ShapeB) = (placed.ShapeB, placed.ShapeA);
        (placed.OrientationA, placed.OrientationB) = (placed.OrientationB, placed.OrientationA);
        (placed.ConeA, placed.ConeB) = (placed.ConeB, placed.ConeA);
        placed.OffsetB = -placed.OffsetB;
        return placed;
    }
}
