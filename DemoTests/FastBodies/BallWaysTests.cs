using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.FastBodies;

/// <summary>Impacts of balls in closed form are those that a sweep finds in rounds.</summary>
public unsafe class BallWaysTests
{
    const int Count = 4000;
    const double Touching = 1e-4;
    const double Dt = .01;

    struct All : ISweepFilter
    {
        public readonly bool AllowTest(int childA, int childB) => true;
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void TheyMeetWhereASweepSaysSo(bool isPlane)
    {
        var random = new Random(6);
        var (hits, overlaps) = (0, 0);
        var pool = new BufferPool();
        var filter = new All();
        for (int i = 0; i < Count; ++i)
        {
            var (a, b) = (new Sphere(.05f + random.NextSingle() * .2f), new Sphere(.05f + random.NextSingle() * .2f));
            var half = new HalfSpace(Vector3.Transform(Vector3.UnitY, TestWorld.Turn(random)));
            var orientation = TestWorld.Turn(random);
            // Thinner by a part, as cores are; the ball that loses most is the smaller one.
            var part = i % 3 * .3;
            var motion = new SweepMotion
            {
                OrientationA = DoubleMatrix3x3.FromQuaternion(Quaternion.Identity),
                OrientationB = DoubleMatrix3x3.FromQuaternion(orientation),
                LinearA = new(TestWorld.Scatter(random, 100)),
                LinearB = isPlane ? default : new(TestWorld.Scatter(random, 100)),
                OffsetB = new(TestWorld.Scatter(random, 1)),
                MaximumT = Dt,
                Accuracy = ImpactAccuracy.Default with { TouchingDistance = Touching },
                ThinnerPart = part,
                MostThinnerOf = isPlane ? a.Radius : Math.Min(a.Radius, b.Radius),
            };
            var (typeB, shapeB) = isPlane ? (HalfSpace.Id, (nint)(&half)) : (Sphere.Id, (nint)(&b));
            SweepPairs.Test(motion, Sphere.Id, &a, typeB, (void*)shapeB, ref filter, null!, pool, out var hit);
            var ways = new BallWays();
            Assert.True(ways.TrySet(Sphere.Id, &a, typeB, (void*)shapeB, orientation, moves: !isPlane));
            // What tells quickly that there is nothing to find lets all pass that there is.
            if (hit.Overlaps || hit.Exists)
            {
                Assert.True(isPlane || ways.MayMeet(motion.OffsetB, motion.LinearA - motion.LinearB, Dt, Touching));
                Assert.True(ways.ApartUntil(motion.OffsetB, motion.LinearA, motion.LinearB, Touching) <= (hit.Overlaps ? 0 : hit.T + 1e-9));
            }
            var isApart = ways.TryFind(part, motion.OffsetB, motion.LinearA, motion.LinearB, Touching, out var time);
            Assert.Equal(hit.Overlaps, !isApart);
            if (hit.Overlaps)
            {
                ++overlaps;
                continue;
            }
            // What counts as touching is a distance: a way that grazes is within it or not by where a sweep stops.
            double radii = Thin(a) + (isPlane ? 0 : Thin(b));
            var up = isPlane ? DoubleMatrix3x3.FromQuaternion(orientation).Turn(new(half.Normal)) : default;
            if (hit.Exists != time <= Dt)
            {
                Assert.InRange(Clearance(motion, hit.Exists ? hit.T : time, radii, up), 0, 1.001 * Touching);
                continue;
            }
            if (!hit.Exists)
                continue;
            ++hits;
            var between = motion.OffsetB - (motion.LinearA - motion.LinearB) * time;
            ways.Touch(part, between, out var normal, out var armA, out var armB);
            Assert.InRange(Clearance(motion, time, radii, up), 0, 1.001 * Touching);
            // Along what grazes, the way for a distance is the root of that.
            var slack = Math.Sqrt(2 * Touching * .5);
            Assert.InRange((normal - hit.Normal).Length, 0, slack / .1);
            Assert.InRange((armA - (hit.Place - motion.LinearA * hit.T)).Length, 0, slack);
            Assert.InRange((armB - (hit.Place - motion.OffsetB - motion.LinearB * hit.T)).Length, 0, slack);
            Assert.InRange((armA - armB - between).Length, 0, 1e-12);

            double Thin(in Sphere ball) => ball.Radius - part * Math.Min(ball.Radius, motion.MostThinnerOf);
        }
        Assert.True(hits > Count / 20, $"{hits} hits");
        Assert.True(overlaps > Count / 50, $"{overlaps} overlaps");
    }

    /// <summary>What is a given distance apart all the time stays apart by that, and not by more.</summary>
    [Fact]
    public void TheyStayApartByWhatIsToSpare()
    {
        var ball = new Sphere(.1f);
        var ways = new BallWays();
        ways.TrySet(Sphere.Id, &ball, Sphere.Id, &ball, Quaternion.Identity, moves: true);
        // They pass each other at .3 m, surfaces .1 m apart.
        DoubleVector3 offset = new(1, .3, 0), linear = new(200, 0, 0);
        Assert.True(ways.ApartUntil(offset, linear, default, .0999) > Dt);
        Assert.False(ways.ApartUntil(offset, linear, default, .1001) > Dt);
        Assert.True(ways.ApartUntil(offset, linear, default, .1001) > .003);
        var floor = new HalfSpace(Vector3.UnitY);
        ways.TrySet(Sphere.Id, &ball, HalfSpace.Id, &floor, Quaternion.Identity, moves: false);
        // From .5 m to .3 m above it.
        DoubleVector3 below = new(0, -.5, 0), falling = new(50, -20, 0);
        Assert.True(ways.ApartUntil(below, falling, default, .1999) > Dt);
        Assert.False(ways.ApartUntil(below, falling, default, .2001) > Dt);
    }

    /// <summary>What is beside the way, too slow for it, or on its way away does not meet; what is farther apart than a margin is known to be.</summary>
    [Fact]
    public void WhatIsFarIsToldAtOnce()
    {
        var ball = new Sphere(.1f);
        var ways = new BallWays();
        ways.TrySet(Sphere.Id, &ball, Sphere.Id, &ball, Quaternion.Identity, moves: true);
        Assert.True(ways.MayMeet(new(1, .199, 0), new(200, 0, 0), Dt, Touching));
        Assert.False(ways.MayMeet(new(1, .201, 0), new(200, 0, 0), Dt, Touching));
        Assert.True(ways.MayMeet(new(1, 0, 0), new(80.1, 0, 0), Dt, Touching));
        Assert.False(ways.MayMeet(new(1, 0, 0), new(79.9, 0, 0), Dt, Touching));
        Assert.False(ways.MayMeet(new(1, 0, 0), new(-200, 0, 0), Dt, Touching));
        Assert.True(ways.AreFartherApartThan(new(.4, .3, 0), .299f));
        Assert.False(ways.AreFartherApartThan(new(.4, .3, 0), .301f));
        var floor = new HalfSpace(Vector3.UnitY);
        ways.TrySet(Sphere.Id, &ball, HalfSpace.Id, &floor, Quaternion.Identity, moves: false);
        Assert.True(ways.AreFartherApartThan(new(0, -.5, 0), .399f));
        Assert.False(ways.AreFartherApartThan(new(0, -.5, 0), .401f));
        Assert.False(new BallWays().AreFartherApartThan(new(0, -.5, 0), 0));
    }

    // Between the cores at a time: above a plane, or between two balls.
    static double Clearance(in SweepMotion motion, double time, double radii, in DoubleVector3 up)
    {
        var between = motion.OffsetB - (motion.LinearA - motion.LinearB) * time;
        return (up.Length > 0 ? -DoubleVector3.Dot(up, between) / up.Length : between.Length) - radii;
    }
}
