using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.Running;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.DirectJoints;

/// <summary>Equal structures are solved side by side, each in a lane. None may notice that others are beside it.</summary>
public class SideBySideTests
{
    // Beyond one island of any machine.
    const int Count = 11;

    static AccuracySettings Settings(bool always) =>
        new() { DirectJoints = always ? DirectJointsChoice.Always : DirectJointsChoice.WhereNeeded };

    /// <summary>
    /// A trunk with limbs in sockets with limits, hinges with servos and motors, springs, and loops: of the same structure for all seeds, with other numbers.
    /// </summary>
    static List<BodyHandle> Add(TestWorld world, int seed)
    {
        var random = new Random(seed);
        float Next(float least, float most) => least + (most - least) * random.NextSingle();
        Vector3 NextVector(float most) => new(Next(-most, most), Next(-most, most), Next(-most, most));
        var bodies = new List<BodyHandle>();
        var start = new Vector3(0, 0, 60 * seed);
        bodies.Add(world.AddKinematic(new Box(.3f, .3f, .3f), new RigidPose(start)));
        for (int i = 1; i <= 8; ++i)
        {
            var parent = bodies[(i - 1) / 2];
            var offset = new Vector3(i % 2 == 0 ? 1 : -1, -1, Next(-.2f, .2f));
            var pose = new RigidPose(world.Bodies[parent].Pose.Position + offset);
            var body = world.AddDynamic(new Box(.4f, .7f, .3f), MathF.Pow(10, Next(-1, 1.5f)), pose, new(NextVector(6), NextVector(12)));
            bodies.Add(body);
            // Springs in some of them only.
            var spring = i == 3 && seed % 3 == 0 ? new SpringSettings(Next(5, 30), 1) : default;
            if (i % 4 == 1)
            {
                world.Solver.Add(parent, body, new Hinge
                {
                    LocalOffsetA = offset / 2,
                    LocalOffsetB = -offset / 2,
                    LocalHingeAxisA = Vector3.UnitX,
                    LocalHingeAxisB = Vector3.UnitX,
                });
                var motor = new MotorSettings(Next(.1f, 40), 0);
                world.Solver.Add(parent, body, new AngularAxisMotor { LocalAxisA = Vector3.UnitX, TargetVelocity = Next(-5, 5), Settings = motor });
                continue;
            }
            world.Solver.Add(parent, body, new BallSocket { LocalOffsetA = offset / 2, LocalOffsetB = -offset / 2, SpringSettings = spring });
            if (i % 4 == 2)
            {
                var servo = new ServoSettings(Next(1, 10), 0, Next(.1f, 60));
                world.Solver.Add(parent, body, new AngularServo { TargetRelativeRotationLocalA = Quaternion.Identity, ServoSettings = servo });
                continue;
            }
            world.Solver.Add(parent, body, new SwingLimit { AxisLocalA = Vector3.UnitY, AxisLocalB = Vector3.UnitY, MaximumSwingAngle = Next(.1f, 1) });
            world.Solver.Add(parent, body, new TwistLimit
            {
                LocalBasisA = Quaternion.Identity,
                LocalBasisB = Quaternion.Identity,
                MinimumAngle = -Next(.05f, .5f),
                MaximumAngle = Next(.05f, .5f),
            });
        }
        world.Solver.Add(bodies[7], bodies[8], new DistanceLimit(default, default, .5f, Next(1.5f, 2.5f), default));
        return bodies;
    }

    // A body with three limbs of three parts each, whose limits are near.
    static List<BodyHandle> AddThrown(TestWorld world, int seed)
    {
        var random = new Random(seed);
        float Next(float most) => most * (2 * random.NextSingle() - 1);
        var bodies = new List<BodyHandle>();
        for (int i = 0; i < 10; ++i)
        {
            var parent = i < 4 ? 0 : i - 3;
            var offset = i == 0 ? new Vector3(0, 0, 40 * seed) : new Vector3(0, i < 4 ? i - 2 : 0, i < 4 ? 0 : 1);
            var place = i == 0 ? offset : world.Bodies[bodies[parent]].Pose.Position + offset;
            BodyVelocity velocity = new(new(Next(5), Next(5), Next(5)), new(Next(9), Next(9), Next(9)));
            bodies.Add(world.AddDynamic(new Box(.3f, .5f, .7f), MathF.Pow(10, Next(1)), new RigidPose(place), velocity));
            if (i == 0)
                continue;
            world.Solver.Add(bodies[parent], bodies[i], new BallSocket { LocalOffsetA = offset / 2, LocalOffsetB = -offset / 2 });
            var swing = new SwingLimit { AxisLocalA = Vector3.UnitZ, AxisLocalB = Vector3.UnitZ, MaximumSwingAngle = .2f };
            world.Solver.Add(bodies[parent], bodies[i], swing);
            world.Solver.Add(bodies[parent], bodies[i], new TwistLimit
            {
                LocalBasisA = Quaternion.Identity,
                LocalBasisB = Quaternion.Identity,
                MinimumAngle = -.1f,
                MaximumAngle = .2f,
            });
        }
        return bodies;
    }

    static List<Vector3> Motion(TestWorld world, List<BodyHandle> bodies)
    {
        var numbers = new List<Vector3>();
        foreach (var handle in bodies)
        {
            var body = world.Bodies[handle];
            var turned = new Vector3(body.Pose.Orientation.X, body.Pose.Orientation.Y, body.Pose.Orientation.Z);
            numbers.AddRange([body.Pose.Position, turned, body.Velocity.Linear, body.Velocity.Angular]);
        }
        return numbers;
    }

    static List<List<Vector3>> MotionOf(IEnumerable<int> seeds, bool always, int threads = 1, bool keepsFactors = true)
    {
        using var world = new TestWorld(Settings(always), threads);
        world.Solver.KeepsDirectFactors = keepsFactors;
        var structures = seeds.Select(seed => Add(world, seed)).ToList();
        world.Step(90);
        return [.. structures.Select(bodies => Motion(world, bodies))];
    }

    static void AssertSameBits(List<Vector3> expected, List<Vector3> actual)
    {
        static IEnumerable<int> Bits(List<Vector3> vectors) => vectors.SelectMany(v => new[] { v.X, v.Y, v.Z }).Select(BitConverter.SingleToInt32Bits);
        Assert.Equal(Bits(expected), Bits(actual));
    }

    /// <summary>A structure alone is solved in numbers of its own.</summary>
    [Theory]
    [InlineData(true, 1)]
    [InlineData(true, 2)]
    [InlineData(false, 1)]
    public void Others_beside_it_change_no_bit_of_a_structure(bool always, int threads)
    {
        var together = MotionOf(Enumerable.Range(0, Count), always, threads);
        for (int seed = 0; seed < Count; ++seed)
            AssertSameBits(MotionOf([seed], always)[0], together[seed]);
    }

    [Theory]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(5)]
    [InlineData(8)]
    public void Neither_does_the_lane_nor_how_many_there_are(int count)
    {
        var inOrder = MotionOf(Enumerable.Range(0, count), always: true);
        var reversed = MotionOf(Enumerable.Range(0, count).Reverse(), always: true);
        for (int seed = 0; seed < count; ++seed)
            AssertSameBits(inOrder[seed], reversed[count - 1 - seed]);
    }

    /// <summary>When limits and servos change sides only what depends on them is factored anew: the same as if all were.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Factors_that_stay_are_those_that_would_come(bool always)
    {
        for (int first = 0; first < 96; first += 2 * Count)
        {
            var together = Enumerable.Range(first, Count);
            var (kept, anew) = (MotionOf(together, always), MotionOf(together, always, keepsFactors: false));
            for (int i = 0; i < Count; ++i)
                AssertSameBits(anew[i], kept[i]);
            // In numbers of its own.
            AssertSameBits(MotionOf([first], always, keepsFactors: false)[0], MotionOf([first], always)[0]);
        }
    }

    /// <summary>A ragdoll for each seed, with its limits near, thrown.</summary>
    [Fact]
    public void Factors_of_ragdolls_that_stay_are_those_that_would_come()
    {
        List<Vector3> Thrown(bool keepsFactors)
        {
            using var world = new TestWorld(Settings(always: true));
            world.Solver.KeepsDirectFactors = keepsFactors;
            var bodies = new List<BodyHandle>();
            for (int seed = 0; seed < 3 * Count; ++seed)
                bodies.AddRange(AddThrown(world, seed));
            world.Step(120);
            return Motion(world, bodies);
        }
        AssertSameBits(Thrown(false), Thrown(true));
    }

    [Fact]
    public void Equal_structures_are_one_island_others_are_not()
    {
        using var world = new TestWorld(Settings(always: true));
        for (int seed = 0; seed < Count; ++seed)
            Add(world, seed);
        world.Step();
        var lanes = DirectPlan.Lanes;
        // Two hang from each kinematic trunk.
        Assert.Equal(2 * ((Count + lanes - 1) / lanes), world.Solver.DirectIslandCount);
        // One link more, one of another type, and the same joints between others of the bodies.
        var islands = world.Solver.DirectIslandCount;
        DirectStructures.AddChain(world, new Vector3(100, 0, 0), 3);
        DirectStructures.AddChain(world, new Vector3(200, 0, 0), 4);
        DirectStructures.AddLoose(world, new Vector3(300, 0, 0), 4);
        var hub = DirectStructures.AddChain(world, new Vector3(400, 0, 0), 2);
        var last = world.AddDynamic(new Sphere(.1f), 1, new RigidPose(new Vector3(401, 1, 0)));
        world.Solver.Add(hub[1], last, new BallSocket { LocalOffsetA = new(0, .5f, 0), LocalOffsetB = new(0, -.5f, 0) });
        world.Step();
        Assert.Equal(islands + 4, world.Solver.DirectIslandCount);
    }

    /// <summary>When one of them goes, the others come to lie in other lanes.</summary>
    [Fact]
    public void One_that_goes_changes_no_bit_of_the_others()
    {
        List<Vector3> Last(bool withOthers)
        {
            using var world = new TestWorld(Settings(always: true));
            var first = withOthers ? Add(world, 0) : [];
            var second = withOthers ? Add(world, 1) : [];
            var last = Add(world, 2);
            world.Step(20);
            foreach (var body in first)
                world.Bodies.Remove(body);
            world.Step(20);
            if (withOthers)
                world.Bodies.Remove(second[8]);
            world.Step(20);
            return Motion(world, last);
        }
        AssertSameBits(Last(false), Last(true));
    }
}
