using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.FastBodies;

/// <summary>What is told of a sweep before it is made is true.</summary>
public unsafe class SweepShortcutTests
{
    struct All : ISweepFilter
    {
        public readonly bool AllowTest(int childA, int childB) => true;
    }

    /// <summary>
    /// A ball against a compound of balls that flies and turns: what is left out, since they cannot meet on their arcs, is not met at any of many times.
    /// </summary>
    [Fact]
    public void Children_that_turn_are_met_where_their_arcs_lead()
    {
        const int steps = 400;
        const double touching = 1e-5;
        var random = new Random(8);
        var pool = new BufferPool();
        var shapes = new Shapes(pool, 4);
        var ball = new Sphere(.2f);
        var child = shapes.Add(ball);
        var (hits, misses) = (0, 0);
        var filter = new All();
        for (int i = 0; i < 1500; ++i)
        {
            pool.Take<CompoundChild>(3, out var children);
            for (int j = 0; j < children.Length; ++j)
                children[j] = new CompoundChild(new RigidPose(j == 0 ? Vector3.Zero : TestWorld.Scatter(random, 1)), child);
            var compound = new Compound(children);
            var orientation = DoubleMatrix3x3.FromQuaternion(TestWorld.Turn(random));
            var motion = new SweepMotion
            {
                OrientationA = DoubleMatrix3x3.FromQuaternion(Quaternion.Identity),
                OrientationB = orientation,
                LinearA = new(TestWorld.Scatter(random, 5)),
                LinearB = new(TestWorld.Scatter(random, 5)),
                AngularB = new(TestWorld.Scatter(random, i % 2 == 0 ? 3 : 30)),
                OffsetB = new(TestWorld.Scatter(random, 2)),
                MaximumT = .3,
                Accuracy = ImpactAccuracy.Default with { TouchingDistance = touching },
            };
            SweepPairs.Test(motion, Sphere.Id, &ball, Compound.Id, &compound, ref filter, shapes, pool, out var hit);
            if (!hit.Overlaps)
            {
                // Before the impact, or all the way, no child comes nearer than two radii.
                var end = hit.Exists ? hit.T : motion.MaximumT;
                for (int step = 0; step <= steps; ++step)
                    Assert.True(Clearance(motion, children, end * step / steps) > -1e-6, $"Sweep {i} passes through a child.");
                if (hit.Exists)
                    Assert.InRange(Clearance(motion, children, end), -1e-6, 2 * touching);
                (hits, misses) = hit.Exists ? (hits + 1, misses) : (hits, misses + 1);
            }
            compound.Dispose(pool);
        }
        Assert.True(hits > 100 && misses > 300, $"{hits} hits, {misses} misses");
        shapes.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }

    static double Clearance(in SweepMotion motion, Buffer<CompoundChild> children, double time)
    {
        var speed = motion.AngularB.Length;
        var turn = DoubleMatrix3x3.FromAxis(motion.AngularB * (1 / speed), Math.Sin(speed * time), Math.Cos(speed * time));
        var least = double.MaxValue;
        for (int i = 0; i < children.Length; ++i)
        {
            var arm = turn.Turn(motion.OrientationB.Turn(new(children[i].LocalPosition)));
            var between = motion.OffsetB + (motion.LinearB - motion.LinearA) * time + arm;
            least = Math.Min(least, between.Length - .4);
        }
        return least;
    }

    /// <summary>
    /// Shapes of many children that both fly and turn: of all children of the one against all of the other, each pair asked for itself, none meets earlier than
    /// the sweep says, which looks at few.
    /// </summary>
    [Theory]
    [InlineData(1, .004)]
    [InlineData(2, .05)]
    [InlineData(3, .6)]
    public void What_is_left_out_of_two_that_turn_meets_nowhere(int seed, double length)
    {
        var random = new Random(seed);
        var pool = new BufferPool();
        var shapes = new Shapes(pool, 4);
        TypedIndex[] parts = [shapes.Add(new Sphere(.15f)), shapes.Add(new Capsule(.08f, .3f)), shapes.Add(new Box(.2f, .1f, .3f))];
        var filter = new All();
        var (hits, overlaps, misses) = (0, 0, 0);
        for (int i = 0; i < 1200; ++i)
        {
            var a = new Compound(Scattered(random, parts, 2 + random.Next(6), pool));
            var b = new BigCompound(Scattered(random, parts, 2 + random.Next(12), pool), shapes, pool);
            var (spinA, spinB) = (new DoubleVector3(TestWorld.Scatter(random, 20)), new DoubleVector3(TestWorld.Scatter(random, i % 3 == 0 ? 0 : 20)));
            var motion = new SweepMotion
            {
                OrientationA = DoubleMatrix3x3.FromQuaternion(TestWorld.Turn(random)),
                OrientationB = DoubleMatrix3x3.FromQuaternion(TestWorld.Turn(random)),
                LinearA = new DoubleVector3(TestWorld.Scatter(random, 2)) * (1 / length),
                LinearB = new DoubleVector3(TestWorld.Scatter(random, 2)) * (1 / length),
                AngularA = spinA,
                AngularB = spinB,
                OffsetB = new(TestWorld.Scatter(random, 4)),
                MaximumT = length,
                Accuracy = ImpactAccuracy.Default with { TouchingDistance = 1e-4 },
                ReachOfB = i % 2 == 0 ? 0 : FarthestOf(b, shapes),
            };
            SweepPairs.Test(motion, Compound.Id, &a, BigCompound.Id, &b, ref filter, shapes, pool, out var hit);
            SweepHit each = default;
            for (int childA = 0; childA < a.ChildCount; ++childA)
            {
                for (int childB = 0; childB < b.ChildCount; ++childB)
                {
                    var bodyA = BodyOf(a.Children[childA], shapes, motion.OrientationA, spinA);
                    var bodyB = BodyOf(b.Children[childB], shapes, motion.OrientationB, spinB);
                    each.Test(motion, ref bodyA, ref bodyB, childA, childB);
                }
            }
            Assert.Equal((each.Exists, each.Overlaps, each.T), (hit.Exists, hit.Overlaps, hit.T));
            (hits, overlaps, misses) = hit.Overlaps ? (hits, overlaps + 1, misses) : hit.Exists ? (hits + 1, overlaps, misses) : (hits, overlaps, misses + 1);
            a.Dispose(pool);
            b.Dispose(pool);
        }
        Assert.True(hits > 50 && overlaps > 20 && misses > 50, $"{hits} hits, {overlaps} overlaps, {misses} misses");
        shapes.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }

    static Buffer<CompoundChild> Scattered(Random random, TypedIndex[] parts, int count, BufferPool pool)
    {
        pool.Take<CompoundChild>(count, out var children);
        for (int i = 0; i < count; ++i)
            children[i] = new CompoundChild(new RigidPose(TestWorld.Scatter(random, 2), TestWorld.Turn(random)), parts[random.Next(parts.Length)]);
        return children;
    }

    static double FarthestOf(in BigCompound compound, Shapes shapes)
    {
        var farthest = 0.0;
        for (int i = 0; i < compound.ChildCount; ++i)
        {
            ref readonly var child = ref compound.Children[i];
            var core = ImpactCore.Of(child.ShapeIndex.Type, shapes.GetBatch(child.ShapeIndex.Type).GetPointer(child.ShapeIndex.Index));
            farthest = Math.Max(farthest, child.LocalPosition.Length() + core.Reach + core.Margin);
        }
        return farthest;
    }

    static ImpactBody BodyOf(in CompoundChild child, Shapes shapes, in DoubleMatrix3x3 orientation, in DoubleVector3 angular) => new(
        ImpactCore.Of(child.ShapeIndex.Type, shapes.GetBatch(child.ShapeIndex.Type).GetPointer(child.ShapeIndex.Index)),
        new RigidPose(child.LocalPosition, child.LocalOrientation), orientation, angular);

    /// <summary>What overlaps where it is thin overlaps where it is thicker: if the thinnest do there is no way for any.</summary>
    [Fact]
    public void Thinner_shapes_overlap_less()
    {
        ReadOnlySpan<double> parts = [.1, .15, .2, .25, .3, .35, .4, .5, .6, .7, .8, .9];
        var random = new Random(4);
        var pool = new BufferPool();
        var filter = new All();
        var (none, some, all) = (0, 0, 0);
        for (int i = 0; i < 3000; ++i)
        {
            var a = new Box(.2f + random.NextSingle(), .2f + random.NextSingle(), .2f + random.NextSingle());
            var b = new Cylinder(.1f + .5f * random.NextSingle(), .2f + random.NextSingle());
            var motion = new SweepMotion
            {
                OrientationA = DoubleMatrix3x3.FromQuaternion(TestWorld.Turn(random)),
                OrientationB = DoubleMatrix3x3.FromQuaternion(TestWorld.Turn(random)),
                OffsetB = new(TestWorld.Scatter(random, 1.2f)),
                Accuracy = ImpactAccuracy.Default with { TouchingDistance = 1e-4 },
                MostThinnerOf = .1,
            };
            var overlaps = 0;
            for (int j = 0; j < parts.Length; ++j)
            {
                motion.ThinnerPart = parts[j];
                SweepPairs.Test(motion, Box.Id, &a, Cylinder.Id, &b, ref filter, null!, pool, out var hit);
                Assert.True(!hit.Overlaps || overlaps == j, $"Pair {i} overlaps at {parts[j]}, and not where it is thicker.");
                overlaps += hit.Overlaps ? 1 : 0;
            }
            none += overlaps == 0 ? 1 : 0;
            all += overlaps == parts.Length ? 1 : 0;
            some += overlaps > 0 && overlaps < parts.Length ? 1 : 0;
        }
        Assert.True(none > 200 && all > 200 && some > 20, $"{none}, {some}, {all}");
        pool.AssertEmpty();
        pool.Clear();
    }
}
