using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using Demos.References;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>What a history promises: it gives contacts only while no point of the smaller shape has moved far, and then the right ones.</summary>
public class PairHistoryTests
{
    const float ReachA = 2;
    const float ReachB = 0.5f;
    const float Margin = 0.01f;
    static readonly ShapeIdentity shapeA = new(new TypedIndex(2, 7), 1);
    static readonly ShapeIdentity shapeB = new(new TypedIndex(5, 3), 1);

    // One contact, 2 mm deep, found with both bodies turned.
    sealed class Found
    {
        public RigidPose A = new(new Vector3(3, -2, 5), Turn(new Vector3(0.2f, 0.5f, -0.3f)));
        public RigidPose B;
        public Vector3 Normal = Exact.Normalize(new Vector3(0.3f, -0.9f, 0.2f));
        public Vector3 PointA, PointB;
        public PairHistory History;

        public Found(bool touching = true, float depth = 0.002f, int leastCarriedCount = 1, bool bIsLarger = false, HistoryLane lane = default)
        {
            B = new(new Vector3(3.4f, 0.3f, 4.8f), Turn(new Vector3(-0.4f, 0.1f, 0.6f)));
            // The surface points lie half the depth to either side of the contact, A's towards B.
            var contact = new Vector3(3.2f, -0.1f, 4.9f);
            PointA = contact - Normal * (depth / 2);
            PointB = contact + Normal * (depth / 2);
            var manifold = new ConvexContactManifold { Count = touching ? 1 : 0, OffsetB = B.Position - A.Position, Normal = Normal };
            manifold.Contact0 = new ConvexContact { Offset = contact - A.Position, Depth = depth, FeatureId = 42 };
            History.Identify(shapeA, shapeB);
            var measures = new PairMeasures { Depth = depth, ReachA = bIsLarger ? ReachB : ReachA, ReachB = bIsLarger ? ReachA : ReachB };
            lane.Record(ref History, manifold, measures, A.Orientation, B.Orientation, Margin, leastCarriedCount);
        }

        public bool Reuse(in RigidPose a, in RigidPose b, out ConvexContactManifold manifold, float margin = Margin)
        {
            manifold = default;
            return History.TryReuse(b.Position - a.Position, a.Orientation, b.Orientation, margin, ref manifold);
        }
    }

    [Fact]
    public void Bodies_that_stay_keep_their_contact()
    {
        var found = new Found();

        Assert.True(found.Reuse(found.A, found.B, out var manifold));

        Assert.Equal((1, 42), (manifold.Count, manifold.Contact0.FeatureId));
        Assert.Equal(0.002f, manifold.Contact0.Depth, 1e-6f);
        AssertNear((found.PointA + found.PointB) / 2 - found.A.Position, manifold.Contact0.Offset);
        AssertNear(found.Normal, manifold.Normal);
    }

    /// <summary>Whichever lane of a bundle recorded it, in whichever order, from whichever of the four contacts.</summary>
    [Theory]
    [InlineData(false, 0, false, 0)]
    [InlineData(true, 0, false, 0)]
    [InlineData(false, 2, true, 3)]
    [InlineData(true, 3, true, 1)]
    public void A_pair_that_moves_as_one_body_takes_its_contact_along(bool bIsLarger, int lane, bool flipped, int slot)
    {
        var found = new Found(bIsLarger: bIsLarger, lane: new HistoryLane(lane, flipped, slot));
        // Far more than the tolerance, but the same for both.
        var motion = new RigidPose(new Vector3(20, 7, -9), Turn(new Vector3(1, 2, -0.5f)));
        var a = Moved(found.A, motion);
        var b = Moved(found.B, motion);

        Assert.True(found.Reuse(a, b, out var manifold));

        Assert.Equal((1, 42), (manifold.Count, manifold.Contact0.FeatureId));
        Assert.Equal(0.002f, manifold.Contact0.Depth, 1e-5f);
        AssertNear(Exact.Rotate(found.Normal, motion.Orientation), manifold.Normal);
        var contact = Transform((found.PointA + found.PointB) / 2, motion);
        AssertNear(contact - a.Position, manifold.Contact0.Offset, 1e-5f);
    }

    [Fact]
    public void A_contact_follows_the_points_of_both_surfaces()
    {
        var found = new Found();
        var motion = new RigidPose(new Vector3(1e-4f, -1e-4f, 2e-4f), Turn(new Vector3(1e-4f, 2e-4f, -1e-4f)));
        var b = new RigidPose(found.B.Position + motion.Position, Exact.Concatenate(found.B.Orientation, motion.Orientation));

        Assert.True(found.Reuse(found.A, b, out var manifold));

        Double3 pointB = (Double3)b.Position + ((DoubleQuaternion)motion.Orientation).Rotate((Double3)found.PointB - found.B.Position);
        var depth = Double3.Dot(pointB - found.PointA, found.Normal);
        // The larger shape is A and has not moved, so the normal is what it was.
        AssertNear(found.Normal, manifold.Normal);
        Assert.Equal(depth, manifold.Contact0.Depth, 1e-6);
        Assert.NotEqual(0.002, depth, 1e-5);
    }

    [Fact]
    public void The_normal_turns_with_the_larger_shape()
    {
        var found = new Found(bIsLarger: true);
        var motion = new RigidPose(new Vector3(5e-5f, -1e-4f, 5e-5f), Turn(new Vector3(2.5e-5f, 7.5e-5f, -5e-5f)));
        var b = new RigidPose(found.B.Position + motion.Position, Exact.Concatenate(found.B.Orientation, motion.Orientation));

        Assert.True(found.Reuse(found.A, b, out var manifold));

        var normal = ((DoubleQuaternion)motion.Orientation).Rotate((Double3)found.Normal);
        Double3 pointB = (Double3)b.Position + ((DoubleQuaternion)motion.Orientation).Rotate((Double3)found.PointB - found.B.Position);
        AssertNear(Narrow(normal), manifold.Normal);
        Assert.Equal(Double3.Dot(pointB - found.PointA, normal), manifold.Contact0.Depth, 1e-6);
        AssertNear(Narrow((pointB + found.PointA) * 0.5 - found.A.Position), manifold.Contact0.Offset);
        Assert.NotEqual(0.002, manifold.Contact0.Depth, 1e-5);
    }

    /// <summary>Whatever the motion: if any point of the smaller shape moves beyond the tolerance, the pair is tested again.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void No_point_moves_beyond_the_tolerance_unnoticed(int seed)
    {
        var random = new Random(seed);
        int reused = 0, refused = 0;
        for (int i = 0; i < 2000; ++i)
        {
            var found = new Found();
            var allowed = RetestBound.Tolerance * ReachB;
            var scale = allowed * MathF.Pow(10, random.NextSingle() * 4 - 2.5f);
            var translation = Direction(random) * scale * random.NextSingle();
            var turn = Turn(Direction(random) * (scale / ReachB * random.NextSingle()));
            var b = new RigidPose(found.B.Position + translation, Exact.Concatenate(found.B.Orientation, turn));
            if (!found.Reuse(found.A, b, out _))
            {
                ++refused;
                continue;
            }
            ++reused;
            for (int j = 0; j < 20; ++j)
            {
                var point = Direction(random) * ReachB;
                var way = translation + Exact.Rotate(point, turn) - point;
                Assert.True(Exact.Length(way) < allowed * 1.01f, $"moved {Exact.Length(way)} of {allowed}");
            }
        }
        Assert.True(reused > 200 && refused > 200, $"{reused} reused, {refused} refused");
    }

    [Theory]
    [InlineData(0.3f, 0.28f, true)]
    [InlineData(0.3f, 0.295f, false)]
    [InlineData(0.3f, 0.31f, false)]
    public void Shapes_that_are_apart_have_no_contact_until_they_can_have_met(float distance, float approach, bool apart)
    {
        var found = new Found(touching: false, depth: -distance);
        var b = found.B;
        b.Position += new Vector3(0, -approach, 0);

        Assert.Equal(apart, found.Reuse(found.A, b, out var manifold));

        Assert.Equal(0, manifold.Count);
    }

    [Fact]
    public void A_wider_margin_than_that_of_the_test_asks_for_a_test()
    {
        var found = new Found();

        Assert.True(found.Reuse(found.A, found.B, out _, Margin));
        Assert.False(found.Reuse(found.A, found.B, out _, Margin * 2));
        // Contacts farther apart than the pair may move unnoticed are of no interest.
        Assert.True(found.Reuse(found.A, found.B, out _, RetestBound.Tolerance * ReachB * 0.5f));
    }

    [Fact]
    public void Contacts_of_what_may_roll_are_not_carried()
    {
        var rolling = new Found(leastCarriedCount: 3);
        var apart = new Found(touching: false, depth: -1, leastCarriedCount: 3);

        Assert.False(rolling.Reuse(rolling.A, rolling.B, out _));
        Assert.True(apart.Reuse(apart.A, apart.B, out _));
    }

    [Fact]
    public void A_history_ends()
    {
        var found = new Found();
        for (int i = 0; i < RetestBound.Lifetime; ++i)
            Assert.True(found.Reuse(found.A, found.B, out _));

        Assert.False(found.Reuse(found.A, found.B, out _));
    }

    [Fact]
    public void Other_shapes_have_no_history()
    {
        var found = new Found();
        found.History.Identify(shapeA, shapeB with { Generation = 2 });

        Assert.False(found.Reuse(found.A, found.B, out _));
        ConvexContactManifold manifold = default;
        Assert.False(default(PairHistory).TryReuse(default, Quaternion.Identity, Quaternion.Identity, 0, ref manifold));
    }

    // Bodies that sleep in all but name: nothing moves, so nothing may seem to.
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Whoever_does_not_move_has_not_moved_by_a_bit(bool flipped)
    {
        var random = new Random(3);
        for (int i = 0; i < 500; ++i)
        {
            var lane = new HistoryLane(i % Vector<float>.Count, flipped);
            var turnA = Turn(Direction(random) * 3);
            var turnB = Turn(Direction(random) * 3);
            var offset = Direction(random) * 5;
            var history = default(PairHistory);
            var measures = new PairMeasures { Depth = -1, ReachA = random.NextSingle(), ReachB = random.NextSingle() };
            lane.Record(ref history, new ConvexContactManifold { OffsetB = offset }, measures, turnA, turnB, 0, 1);
            // As far apart as the margin, less what rounding is allowed.
            var margin = MathF.BitDecrement(1 - 1e-5f * (measures.ReachA + measures.ReachB));
            ConvexContactManifold manifold = default;

            Assert.True(history.TryReuse(offset, turnA, turnB, margin, ref manifold));
        }
    }

    [Fact]
    public unsafe void A_history_is_four_cache_lines_and_its_search_begins_the_second()
    {
        Assert.Equal(256, sizeof(PairHistory));
        var history = default(PairHistory);
        Assert.Equal(64, (byte*)&history.Search - (byte*)&history);
    }

    static Vector3 Transform(Vector3 point, in RigidPose motion) => Exact.Rotate(point, motion.Orientation) + motion.Position;

    static Vector3 Narrow(Double3 v) => new((float)v.X, (float)v.Y, (float)v.Z);

    static RigidPose Moved(in RigidPose pose, in RigidPose motion) =>
        new(Transform(pose.Position, motion), Exact.Concatenate(pose.Orientation, motion.Orientation));

    static Quaternion Turn(Vector3 axisTimesAngle)
    {
        var angle = axisTimesAngle.Length();
        return angle == 0 ? Quaternion.Identity : Quaternion.CreateFromAxisAngle(axisTimesAngle / angle, angle);
    }

    static Vector3 Direction(Random random)
    {
        var v = new Vector3(random.NextSingle() - 0.5f, random.NextSingle() - 0.5f, random.NextSingle() - 0.5f);
        return v.Length() < 0.01f ? Vector3.UnitX : Vector3.Normalize(v);
    }

    static void AssertNear(Vector3 expected, Vector3 actual, float tolerance = 2e-6f) =>
        Assert.True(Vector3.Distance(expected, actual) < tolerance, $"expected {expected}, not {actual}");
}
