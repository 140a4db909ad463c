using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Robustness;

/// <summary>What callbacks say of a pair is checked before it is stored; what is accepted can be simulated.</summary>
public class CallbackValueTests
{
    // Index of the body whose pairs are wrong, in the middle of the field.
    const int Culprit = 205;

    static readonly Dictionary<string, (Func<Fault> Fault, string Message)> refused = MakeRefused();

    public static TheoryData<string, int> Refused
    {
        get
        {
            var data = new TheoryData<string, int>();
            foreach (var name in refused.Keys)
            {
                data.Add(name, 1);
                data.Add(name, 3);
            }
            return data;
        }
    }

    [Theory, MemberData(nameof(Refused))]
    public void A_value_that_cannot_be_simulated_ends_the_step_and_changes_nothing(string name, int threads)
    {
        var fault = refused[name].Fault();
        using var world = new FaultyWorld(fault, threads);
        fault.Body = world.Bodies[Culprit].Value;
        // The first failure meets pairs that are new, the second one pairs that have constraints.
        for (int round = 0; round < 2; ++round)
        {
            fault.Armed = true;
            var before = world.Simulation.StateHash();
            var error = Assert.Throws<InvalidOperationException>(world.Step);

            Assert.Contains(refused[name].Message, error.Message, StringComparison.Ordinal);
            Assert.Contains($"{world.Simulation.Bodies[world.Bodies[Culprit]].CollidableReference}", error.Message, StringComparison.Ordinal);
            Assert.Equal(before, world.Simulation.StateHash());
            world.Simulation.Validate();
            fault.Armed = false;
            for (int i = 0; i < 3; ++i)
                world.Step();
            world.Simulation.Validate();
        }
        world.AssertAllRest();
    }

    public static TheoryData<float, float, float, float> Accepted => new()
    {
        { float.MaxValue, 2, 0, 0 },
        { 1e-40f, 2, 0, 0 },
        { .5f, float.PositiveInfinity, 0, 0 },
        { .5f, float.MaxValue, 1e13f, 1e13f },
        { .5f, 2, 1e13f, 0 },
        { .5f, 2, 300, 1e13f },
        { 0, 2, 100, 2 },
    };

    // Rest is where the weight is carried: whatever the friction, and however stiff or damped the floor.
    [Theory, MemberData(nameof(Accepted))]
    public void Extreme_values_that_are_accepted_hold_bodies_up(float friction, float recovery, float frequency, float damping)
    {
        var fault = new Fault
        {
            Armed = true,
            Change = (ref _, ref material) => material = new PairMaterialProperties(friction, recovery, default)
            {
                SpringSettings = new SpringSettings { AngularFrequency = frequency, TwiceDampingRatio = damping },
            },
        };
        using var world = new FaultyWorld(fault, 1);
        for (int i = 0; i < 60; ++i)
            world.Step();
        world.Simulation.Validate();
        world.AssertAllRest();
    }

    // Nothing carries a weight on a spring without stiffness, and nothing is NaN for it either.
    [Theory]
    [InlineData(0, 1e-38f, 0)]
    [InlineData(0, 1e-20f, 0)]
    [InlineData(2, 1e-30f, 1e13f)]
    [InlineData(2, 1e-38f, 1e-38f)]
    [InlineData(1e-38f, 1e-18f, 1e-10f)]
    public void Springs_of_next_to_no_stiffness_stay_finite(float recovery, float frequency, float damping)
    {
        var fault = new Fault
        {
            Armed = true,
            Change = (ref _, ref material) => material = new PairMaterialProperties(.5f, recovery, default)
            {
                SpringSettings = new SpringSettings { AngularFrequency = frequency, TwiceDampingRatio = damping },
            },
        };
        using var world = new FaultyWorld(fault, 1);
        for (int i = 0; i < 30; ++i)
            world.Step();
        world.Simulation.Validate();
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1e13f)]
    public void The_least_and_the_greatest_margin_find_what_touches(float margin)
    {
        var fault = new Fault { Armed = true, Margin = margin };
        using var world = new FaultyWorld(fault, 1);
        for (int i = 0; i < 30; ++i)
            world.Step();
        world.Simulation.Validate();
        world.AssertAllRest();
    }

    // Its own speed is nobody's mistake: the margin is limited, not refused.
    [Fact]
    public void Bodies_as_fast_as_bodies_may_be_have_a_margin()
    {
        using var world = new FaultyWorld(new Fault(), 1);
        ref var velocity = ref world.Simulation.Bodies[world.Bodies[7]].Velocity;
        velocity.Linear = new Vector3(1e12f, 0, 0);
        for (int i = 0; i < 3; ++i)
            world.Simulation.Timestep(1);
        world.Simulation.Validate();
    }

    [Theory]
    [InlineData(-1)]
    [InlineData(3)]
    [InlineData(int.MaxValue)]
    public void An_integration_mode_that_is_none_is_refused(int mode)
    {
        using var pool = new BufferPool();
        using var simulation = Simulation.Create(
            pool, new FaultyContacts(new Fault()), new ModeCallbacks((AngularIntegrationMode)mode), new SolveDescription(1, 4));
        simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(Vector3.Zero, 1, simulation.Shapes, new Box(1, 2, 3)));
        var before = simulation.StateHash();

        var error = Assert.Throws<InvalidOperationException>(() => simulation.Timestep(1 / 60f));

        Assert.Contains(mode.ToString(System.Globalization.CultureInfo.InvariantCulture), error.Message, StringComparison.Ordinal);
        Assert.Equal(before, simulation.StateHash());
        simulation.Validate();
    }

    static Dictionary<string, (Func<Fault> Fault, string Message)> MakeRefused()
    {
        Dictionary<string, (Func<Fault>, string)> cases = [];
        void Change(string what, float value, string message, ContactChange change) =>
            cases.Add($"{what} {value}", (() => new Fault { Change = change }, message));
        foreach (var value in new[] { float.NaN, float.PositiveInfinity, float.NegativeInfinity, -1e-3f, 1e30f })
        {
            Change("frequency", value, "spring's angular frequency of the pair", (ref _, ref m) => m.SpringSettings.AngularFrequency = value);
            Change("damping", value, "spring's twice damping ratio of the pair", (ref _, ref m) => m.SpringSettings.TwiceDampingRatio = value);
            Change("normal", value, "contact normal of the pair", (ref c, ref _) => c.Normal = new Vector3(0, value, 0));
            cases.Add($"margin {value}", (() => new Fault { Margin = value }, $"a speculative margin of {value}"));
            cases.Add($"restitution {value}", (() => new Fault { Restitution = value }, "coefficient of restitution of the pair"));
        }
        foreach (var value in new[] { float.NaN, float.PositiveInfinity, float.NegativeInfinity, -1e-3f })
            Change("friction", value, "coefficient of friction of the pair", (ref _, ref m) => m.FrictionCoefficient = value);
        foreach (var value in new[] { float.NaN, float.NegativeInfinity, -5f })
            Change("recovery", value, "maximum recovery velocity of the pair", (ref _, ref m) => m.MaximumRecoveryVelocity = value);
        foreach (var value in new[] { float.NaN, float.PositiveInfinity, float.NegativeInfinity, 1e30f, -1e30f })
        {
            Change("depth", value, "depth of contact 3 of the pair", (ref c, ref _) => c.Contact3.Depth = value);
            Change("offset", value, "offset of contact 1 of the pair", (ref c, ref _) => c.Contact1.Offset.Y = value);
            Change("offset of B", value, "offset of B of the pair", (ref c, ref _) => c.OffsetB.Z = value);
        }
        foreach (var count in new[] { 5, 7, -1, int.MaxValue, int.MinValue })
            Change("count", count, "number of contacts of the pair", (ref c, ref _) => c.Count = count);
        Change("normal", 0, "contact normal of the pair", (ref c, ref _) => c.Normal = default);
        return cases;
    }

    struct ModeCallbacks(AngularIntegrationMode mode) : IPoseIntegratorCallbacks
    {
        public readonly AngularIntegrationMode AngularIntegrationMode { get; } = mode;

        public readonly bool AllowSubstepsForUnconstrainedBodies => true;

        public readonly bool IntegrateVelocityForKinematics => false;

        public readonly void Initialize(Simulation simulation)
        {
        }

        public readonly void PrepareForIntegration(float dt)
        {
        }

        public readonly void IntegrateVelocity(
            Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia,
            Vector<int> integrationMask, int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity)
        {
        }
    }
}
