using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using DemoTests.Scenes;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.FastBodies;

/// <summary>The rounds in which times of impact are sought: they end soon whatever moves, and what is long does not count by its ends alone.</summary>
public sealed unsafe class BoundedWorkTests(ITestOutputHelper output)
{
    const double Spin = 6;

    /// <summary>A rod that turns about its middle comes to what lies beside it when the angle between them is that of their distance.</summary>
    [Theory]
    [InlineData(1e1f)]
    [InlineData(1e3f)]
    [InlineData(1e5f)]
    public void ALongRodComesToABallInTime(float halfLength)
    {
        const double away = 5, first = 1;
        var (rod, ball) = (new Capsule(.1f, 2 * halfLength), new Sphere(.5f));
        // The rod lies along Y, and turns towards -X.
        var offset = new DoubleVector3(-Math.Sin(first), Math.Cos(first), 0) * away;
        Check(ImpactCore.Of(Capsule.Id, &rod), ImpactCore.Of(Sphere.Id, &ball), offset, (first - Math.Asin(.6 / away)) / Spin);
    }

    /// <summary>As with a ball; of a box the corner is met that comes first.</summary>
    [Theory]
    [InlineData(1e1f)]
    [InlineData(1e3f)]
    [InlineData(1e5f)]
    public void ALongRodComesToABoxInTime(float halfLength)
    {
        var (rod, box) = (new Capsule(.1f, 2 * halfLength), new Box(1, 1, 1));
        double x = 4.5, y = .5;
        var time = (Math.Atan2(x, y) - Math.Asin(.1 / Math.Sqrt(x * x + y * y))) / Spin;
        Check(ImpactCore.Of(Capsule.Id, &rod), ImpactCore.Of(Box.Id, &box), new(-5, 0, 0), time);
    }

    void Check(in ImpactCore rod, in ImpactCore other, in DoubleVector3 offset, double expected)
    {
        const int most = 64;
        var axes = DoubleMatrix3x3.FromQuaternion(Quaternion.Identity);
        var turning = new ImpactBody(rod, axes, new(0, 0, Spin));
        var still = new ImpactBody(other, axes, default);
        Assert.True(ImpactPair.Find(ref turning, ref still, offset, default, 1, ImpactAccuracy.Default, out var impact));
        output.WriteLine($"{impact.RoundCount} rounds, {impact.T - expected:e2} s");
        Assert.InRange(impact.T, expected - 1e-6, expected);
        Assert.InRange(impact.RoundCount, 1, most);
        // The same the other way round: what is long is then the second one.
        Assert.True(ImpactPair.Find(ref still, ref turning, -offset, default, 1, ImpactAccuracy.Default, out impact));
        Assert.InRange(impact.T, expected - 1e-6, expected);
        Assert.InRange(impact.RoundCount, 1, most);
    }

    /// <summary>
    /// Balls that are stopped in a crowd push each other on by ever less, down to rounding: a pair is not stopped again in the same substep for a small part
    /// of the speed at which it was.
    /// </summary>
    [Fact]
    public void ACrowdIsStoppedInFewImpacts()
    {
        const float size = 2.5f;
        using var room = new ClosedRoom(Flyer.Ball, RoomWalls.HalfSpaces, 500, size, 50, 2);
        var restitution = room.Simulation.NarrowPhase.Restitution;
        var (impacts, pairs) = (0, 0);
        for (int i = 0; i < 10; ++i)
        {
            room.Step(1, TestWorld.Dt);
            Assert.Equal(0, room.OutsideCount);
            for (int j = 0; j < restitution.PairCount; ++j)
            {
                impacts += restitution.ImpactCountOf(j);
                pairs += restitution.ImpactCountOf(j) > 0 ? 1 : 0;
            }
        }
        output.WriteLine($"{impacts} impacts of {pairs} pairs");
        Assert.InRange(impacts, 1, 5 * pairs);
    }

    /// <summary>
    /// Rods and hammers that are stopped at a corner turn against the wall, as good as in touch with it, by many rad in a substep: each round is as short as
    /// the gap is small, and they come to thousands for each sweep where nothing ends them.
    /// </summary>
    [Theory]
    [InlineData(Shot.SpinningRod, Wall.Heavy, 100)]
    [InlineData(Shot.SpinningRod, Wall.Heavy, 1000)]
    [InlineData(Shot.Hammer, Wall.Heavy, 300)]
    [InlineData(Shot.Hammer, Wall.Heavy, 1000)]
    public void ShotsThatTurnAgainstAWallTakeFewRounds(Shot shot, Wall wall, int speed)
    {
        const int count = 40;
        using var world = new ThinWall(shot, wall, speed, ContinuousDetection.Continuous(), count, 3);
        output.WriteLine($"{world.GreatestRoundCount} rounds in a step");
        Assert.Equal(0, world.PassedCount);
        Assert.InRange(world.GreatestRoundCount, 1, 400 * count);
    }
}
