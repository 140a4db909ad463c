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
using Xunit.Abstractions;

namespace DemoTests.Constraints;

/// <summary>Random trees of every type of joint, of bodies of very different masses, hung up and let go: none may be a source of energy.</summary>
/// <remarks>
/// Twelve trees of each; PHYSICS_FULL_TESTS: a thousand, or as many as it says if that is more than one. PHYSICS_FIRST_TREE: the number of the first,
/// for fresh ones.
/// </remarks>
public class JointTreeTests(ITestOutputHelper output)
{
    static readonly int firstTree = int.TryParse(Environment.GetEnvironmentVariable("PHYSICS_FIRST_TREE"), out var first) ? first : 0;
    static readonly int treeCount = Environment.GetEnvironmentVariable("PHYSICS_FULL_TESTS") is not { Length: > 0 } full ? 12
        : int.TryParse(full, out var count) && count > 1 ? count : 1000;
    const int StepCount = 120;
    // Part of the greatest kinetic energy so far.
    const double GreatestGain = 0.05;
    static readonly Vector3 gravity = new(0, -9.81f, 0);
    static readonly Box box = new(0.4f, 0.3f, 0.5f);

    // What part of their trees may gain: known not to hold this yet. Light bodies with heavy ones at the end of arms that are several times their size turn
    // further in a substep than these rows can follow. They are damped there (JointTurn): joints of points where their load says so, others where their error
    // does; what was tried is in Docs/decisions/long-arms.md. What is not in this list keeps its energy in the same trees.
    static readonly Dictionary<string, double> gaining = new()
    {
        [nameof(Hinge)] = .02,
        [nameof(BallSocket)] = .01,
        [nameof(SwivelHinge)] = .01,
        [nameof(BallSocketServo)] = .01,
        [nameof(DistanceServo)] = .01,
        [nameof(Weld)] = .005,
        [nameof(Slider)] = .01,
        [nameof(BallSocketMotor)] = .01,
        [nameof(Pulley)] = .02,
    };
    // The same of trees in which each joint is of another type, solved at once: by those that are not, pulleys above all.
    const double PartOfAllTypes = .015;

    public static TheoryData<int, int, int> Cases
    {
        get
        {
            var cases = new TheoryData<int, int, int>();
            foreach (var type in JointTypes.All)
            {
                cases.Add(type.Id, 4, 0);
                cases.Add(type.Id, 8, 0);
                cases.Add(type.Id, 4, 1);
            }
            return cases;
        }
    }

    [Theory, MemberData(nameof(Cases))]
    public void It_gains_no_energy(int typeId, int substeps, int relaxations) =>
        LetGo(typeId, treeCount, substeps, relaxations, DirectJointsChoice.Off);

    /// <summary>Nor where those that sweeps do not hold go over to be solved at once, and back; three times as many trees, as few gain.</summary>
    [Theory, MemberData(nameof(TypesHeldBothWays))]
    public void It_gains_no_energy_where_the_solver_chooses(int typeId) =>
        LetGo(typeId, 3 * treeCount, 4, 0, DirectJointsChoice.WhereNeeded);

    public static TheoryData<int> TypesHeldBothWays => new(HeldBothWays());

    static int[] HeldBothWays()
    {
        using var world = new TestWorld();
        return [.. JointTypes.All.Select(type => type.Id).Where(world.Solver.MayAsk)];
    }

    /// <summary>Nor where all of them are solved at once.</summary>
    [Theory, MemberData(nameof(CasesHeldBothWays))]
    public void It_gains_no_energy_at_once(int typeId, int substeps, int relaxations) =>
        LetGo([TypeOf(typeId)], RandomDescriptions.NameOf(typeId), treeCount, substeps, relaxations, DirectJointsChoice.Always, part: 0);

    static JointType TypeOf(int typeId) => JointTypes.All.Single(type => type.Id == typeId);

    public static TheoryData<int, int, int> CasesHeldBothWays
    {
        get
        {
            var cases = new TheoryData<int, int, int>();
            foreach (var typeId in HeldBothWays())
            {
                cases.Add(typeId, 4, 0);
                cases.Add(typeId, 8, 0);
                cases.Add(typeId, 4, 1);
            }
            return cases;
        }
    }

    /// <summary>Nor trees of all types, each joint of another.</summary>
    [Theory]
    [InlineData(4, 0, DirectJointsChoice.Always)]
    [InlineData(8, 0, DirectJointsChoice.Always)]
    [InlineData(4, 1, DirectJointsChoice.Always)]
    [InlineData(4, 0, DirectJointsChoice.WhereNeeded)]
    public void Trees_of_all_types_gain_no_energy(int substeps, int relaxations, DirectJointsChoice directJoints) =>
        LetGo(JointTypes.All, "all types", treeCount, substeps, relaxations, directJoints, PartOfAllTypes);

    /// <summary>Trees that did, each by a cause that was found: none is to come back.</summary>
    // Impulses of the substep before on a twist that its axes had left behind; corrections of rows between points and along lines that turn light bodies far;
    // loads along lines and of motors, which no substep can follow; gaps that were closed while what hangs in them whirls; and light links between heavy
    // bodies, whose gaps are held harder once they have turned.
    [Theory]
    [InlineData(nameof(Rack), 20131, DirectJointsChoice.Off)]
    [InlineData(nameof(Rack), 20029, DirectJointsChoice.Off)]
    [InlineData(nameof(Rack), 20115, DirectJointsChoice.WhereNeeded)]
    [InlineData(AllHeldBothWays, 20017, DirectJointsChoice.Off)]
    [InlineData(AllHeldBothWays, 20037, DirectJointsChoice.Off)]
    [InlineData(nameof(DistanceServo), 20005, DirectJointsChoice.Off)]
    [InlineData(nameof(DistanceServo), 20013, DirectJointsChoice.Off)]
    [InlineData(nameof(DistanceLimit), 20044, DirectJointsChoice.Off)]
    [InlineData(nameof(Pulley), 20006, DirectJointsChoice.Off)]
    [InlineData(nameof(Pulley), 20029, DirectJointsChoice.Off)]
    [InlineData(nameof(PointOnLineServo), 20143, DirectJointsChoice.Off)]
    [InlineData(nameof(Slider), 20066, DirectJointsChoice.Off)]
    [InlineData(nameof(BallSocketMotor), 20009, DirectJointsChoice.Off)]
    [InlineData(nameof(Hinge), 20087, DirectJointsChoice.Off)]
    [InlineData(nameof(Hinge), 20154, DirectJointsChoice.Off)]
    [InlineData(nameof(Hinge), 20193, DirectJointsChoice.Off)]
    [InlineData(nameof(SwivelHinge), 20103, DirectJointsChoice.Off)]
    [InlineData(nameof(SwivelHinge), 20148, DirectJointsChoice.Off)]
    [InlineData(nameof(SwivelHinge), 20081, DirectJointsChoice.Off)]
    [InlineData(nameof(Hinge), 20038, DirectJointsChoice.Off)]
    [InlineData(nameof(BallSocketMotor), 20020, DirectJointsChoice.Off)]
    [InlineData(nameof(BallSocketServo), 20138, DirectJointsChoice.Off)]
    [InlineData(nameof(BallSocketServo), 20163, DirectJointsChoice.Off)]
    [InlineData(nameof(Hinge), 20020, DirectJointsChoice.WhereNeeded)]
    [InlineData(nameof(Hinge), 20202, DirectJointsChoice.WhereNeeded)]
    [InlineData(nameof(BallSocket), 20256, DirectJointsChoice.WhereNeeded)]
    public void A_tree_that_gained_energy_gains_none(string type, int seed, DirectJointsChoice directJoints)
    {
        var types = type == AllHeldBothWays ? [.. HeldBothWays().Select(TypeOf)] : JointTypes.All.Where(other => other.Name == type).ToArray();
        LetGo(types, type, [seed], 4, 0, directJoints, part: 0);
    }

    const string AllHeldBothWays = "all that hold both ways";

    void LetGo(int typeId, int treeCount, int substeps, int relaxations, DirectJointsChoice directJoints)
    {
        var type = TypeOf(typeId);
        LetGo([type], type.Name, treeCount, substeps, relaxations, directJoints, gaining.GetValueOrDefault(type.Name));
    }

    void LetGo(
        IReadOnlyList<JointType> types, string name, int treeCount, int substeps, int relaxations, DirectJointsChoice directJoints, double part) =>
        LetGo(types, name, [.. Enumerable.Range(firstTree, treeCount)], substeps, relaxations, directJoints, part);

    void LetGo(
        IReadOnlyList<JointType> types, string name, int[] seeds, int substeps, int relaxations, DirectJointsChoice directJoints, double part)
    {
        var joints = 0;
        var gains = new List<string>();
        foreach (var seed in seeds)
        {
            using var world = new TestWorld(new AccuracySettings
            {
                Gravity = gravity,
                Contacts = ContactScope.None,
                SubstepCount = substeps,
                RelaxationCount = relaxations,
                DirectJoints = directJoints,
            });
            var masses = new Dictionary<BodyHandle, float>();
            joints += Grow(world, types, new JointSamples(seed * 1000 + types[0].Id), masses, out var lift);
            var start = Energy(world, masses, out _) + lift;
            var fastest = 0.0;
            var greatest = 0.0;
            for (int step = 0; step < StepCount; ++step)
            {
                world.Step();
                var energy = Energy(world, masses, out var kinetic);
                fastest = Math.Max(fastest, kinetic);
                Assert.True(double.IsFinite(energy), $"{name}, tree {seed}: not finite at step {step}.");
                greatest = Math.Max(greatest, (energy - start) / (fastest + 0.01));
            }
            if (greatest > GreatestGain)
                gains.Add(FormattableString.Invariant($"tree {seed} by {greatest:0.00}"));
        }
        output.WriteLine($"{name}, {substeps} substeps, {relaxations} relaxations, joints at once {directJoints}: " +
            $"{gains.Count} of {seeds.Length} gained. {string.Join(", ", gains)}");
        var most = (int)(part * seeds.Length);
        Assert.True(gains.Count <= most, $"{name}: {gains.Count} of {seeds.Length} trees gained energy: {string.Join(", ", gains)} of their motion.");
        Assert.True(joints > seeds.Length, $"Only {joints} joints.");
    }

    // Each body is joined to as many of those before it as the type connects; the first ones are fixed. It is put where the joint has no error.
    // Lift is what may be gained of a start that is not quite where the joints hold it.
    static int Grow(
        TestWorld world, IReadOnlyList<JointType> types, JointSamples samples, Dictionary<BodyHandle, float> masses, out double lift)
    {
        var handles = new List<BodyHandle>();
        var errors = new List<StartError>();
        for (int i = 0; i < Math.Max(1, types.Max(type => type.BodyCount) - 1); ++i)
            handles.Add(world.AddKinematic(box, new RigidPose(new Vector3(i % 2, i / 2, i % 3), samples.Rotation())));
        var count = (int)samples.Uniform(2, 12.99f);
        var joints = 0;
        for (int i = 0; i < count; ++i)
        {
            var type = types.Count == 1 ? types[0] : types[(int)samples.Uniform(0, types.Count - .01f)];
            var mass = MathF.Exp(samples.Uniform(0, MathF.Log(1000)));
            var inertia = box.ComputeInertia(mass);
            var inverse = inertia.InverseInertiaTensor.XX;
            var parents = handles.OrderBy(_ => samples.Uniform(0, 1)).Take(type.BodyCount - 1).ToArray();
            var child = samples.Body() with
            {
                Linear = default,
                Angular = default,
                InverseMass = inertia.InverseMass,
                // As if it were the same about all axes: it is only put in place with this.
                InverseInertia = new() { XX = inverse, YY = inverse, ZZ = inverse },
            };
            if (parents.Length > 0)
                child.Position += world.Bodies[parents[0]].Pose.Position;
            var column = Still(type, samples);
            SampleBody[] bodies =
            [
                .. parents.Select(parent => world.Bodies[parent].Pose)
                    .Select(pose => new SampleBody { Position = pose.Position, Orientation = pose.Orientation }),
                child,
            ];
            using var bench = new RowBench(type.Id, column, bodies);
            RowTests.Settle(bench);
            var pose = bench.Poses[^1];
            // A place that was not found is no start.
            var rows = bench.Rows(new Substep(0, TestWorld.Dt));
            if (rows.Any(row => Math.Abs(row.PositionError) > 1e-3f) || pose.Position.Length() > 50)
                continue;
            var handle = world.AddDynamic(box, mass, pose);
            type.AddTo(world.Solver, [.. parents, handle], column);
            handles.Add(handle);
            masses.Add(handle, mass);
            errors.Add(StartError.Of(bench, rows, handle, parents));
            ++joints;
        }
        lift = -gravity.Y * StartError.Lift(errors, world, masses);
        return joints;
    }

    // Rigid, without limits of force, and motors that are brakes.
    static float[] Still(JointType type, JointSamples samples)
    {
        var column = RandomDescriptions.Joint(type.Description, samples);
        if (type.PlaceOf<SpringSettings>() is var spring and >= 0)
            new float[2].CopyTo(column, spring);
        if (type.PlaceOf<ServoSettings>() is var servo and >= 0)
            new[] { float.MaxValue, 0, float.MaxValue }.CopyTo(column, servo);
        foreach (var name in new[] { "TargetVelocity", "TargetVelocityLocalA" })
        {
            if (type.PlaceOf(name, out var length) is var place and >= 0)
                new float[length].CopyTo(column, place);
        }
        return column;
    }

    static double Energy(TestWorld world, Dictionary<BodyHandle, float> masses, out double kinetic)
    {
        kinetic = 0;
        double potential = 0;
        foreach (var (handle, mass) in masses)
        {
            var body = world.Bodies[handle];
            var velocity = new DoubleVector(body.Velocity.Linear);
            var spin = DoubleRotation.From(body.Pose.Orientation).Inverse * new DoubleVector(body.Velocity.Angular);
            var inverse = body.LocalInertia.InverseInertiaTensor;
            kinetic += 0.5 * mass * DoubleVector.Dot(velocity, velocity) +
                0.5 * (spin.X * spin.X / inverse.XX + spin.Y * spin.Y / inverse.YY + spin.Z * spin.Z / inverse.ZZ);
            potential -= mass * gravity.Y * body.Pose.Position.Y;
        }
        return kinetic + potential;
    }
}
