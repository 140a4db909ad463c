using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>Keeps the middle between bodies A and B where the middle between C and D is: a joint of four bodies that a game could make.</summary>
public struct Balance : IFourBodyConstraintDescription<Balance>
{
    /// <summary>Stiffness of the connection; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    public static int ConstraintTypeId => 111;

    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        FourBodies, BalanceWide, Rows3, JointConstraint<FourBodies, BalanceWide, BalanceGeometry, Rows3, RowMatrix3, BalanceJoint>>();

    public static void Validate(in Balance description)
    {
        if (!SpringSettings.Validate(description.SpringSettings))
            throw new ArgumentException($"{nameof(SpringSettings)} must be finite and not negative.", nameof(description));
    }
}

/// <summary>A bundle of <see cref="Balance"/>.</summary>
public struct BalanceWide : IWide<Balance>
{
    public SpringSettingsWide SpringSettings;
}

/// <summary>Nothing: the rows are the axes of the world.</summary>
public struct BalanceGeometry;

/// <summary>Rows of <see cref="Balance"/>.</summary>
// C = (xA + xB - xC - xD) / 2
// J = [ I, 0, I, 0, -I, 0, -I, 0 ] / 2   over (vA, wA, vB, wB, vC, wC, vD, wD)
// K = (1/mA + 1/mB + 1/mC + 1/mD) / 4 I
public readonly struct BalanceJoint : IJoint<FourBodies, BalanceWide, BalanceGeometry, Rows3, RowMatrix3>
{
    public static void Prepare(in FourBodies bodies, in BalanceWide prestep, out BalanceGeometry geometry) => geometry = default;

    public static void PositionError(in FourBodies bodies, in BalanceWide prestep, in BalanceGeometry geometry, out Rows3 error) =>
        error.V = ((bodies.A.Position - bodies.C.Position) + (bodies.B.Position - bodies.D.Position)) * new Vector<float>(0.5f);

    public static void RelativeVelocity(in BalanceGeometry geometry, in FourBodies bodies, out Rows3 velocity) =>
        velocity.V = ((bodies.A.Linear - bodies.C.Linear) + (bodies.B.Linear - bodies.D.Linear)) * new Vector<float>(0.5f);

    public static void ApplyImpulse(in BalanceGeometry geometry, ref FourBodies bodies, in Rows3 impulse)
    {
        var half = impulse.V * new Vector<float>(0.5f);
        bodies.A.Linear += half * bodies.A.InverseMass;
        bodies.B.Linear += half * bodies.B.InverseMass;
        bodies.C.Linear -= half * bodies.C.InverseMass;
        bodies.D.Linear -= half * bodies.D.InverseMass;
    }

    public static void InverseEffectiveMass(in BalanceGeometry geometry, in FourBodies bodies, out RowMatrix3 inverseMass) =>
        inverseMass.M = Symmetric3x3Wide.AddDiagonal(
            default, (bodies.A.InverseMass + bodies.B.InverseMass + bodies.C.InverseMass + bodies.D.InverseMass) * 0.25f);

    public static SpringSettingsWide Spring(in BalanceWide prestep) => prestep.SpringSettings;
}

public class BalanceTests : JointTests<Balance>
{
    private protected override Balance Describe(JointSamples samples, SpringSettings spring) => new() { SpringSettings = spring };

    // The middles are held wherever they are, with an arm between them.
    private protected override bool KeepsAngularMomentum => false;

    private protected override double[] Error(Balance d, DoublePose[] poses) =>
        ((poses[0].Position + poses[1].Position - poses[2].Position - poses[3].Position) * 0.5).ToArray();

    private protected override IEnumerable<(string, Balance, SampleBody[])> DegenerateCases(JointSamples samples)
    {
        yield return ("As anywhere", default, NewBodies(samples));
    }

    /// <summary>A heavy pair and a light one fall freely together, their middles in one place, and their momentum is the weight's.</summary>
    [Fact]
    public void Middles_of_two_pairs_stay_together()
    {
        using var world = new TestWorld(new AccuracySettings { Contacts = ContactScope.None });
        Span<BodyHandle> bodies = stackalloc BodyHandle[4];
        for (int i = 0; i < 4; ++i)
        {
            var velocity = new BodyVelocity(new Vector3(i, 2 - i, i == 3 ? 4 : 0));
            bodies[i] = world.AddDynamic(new Sphere(0.5f), 1 + i, new RigidPose(new Vector3(i % 2 == 0 ? -1 - i : 1 + i - i % 2, 0, 0)), velocity);
        }
        world.Solver.Add(bodies, new Balance());
        world.Step(60);
        var middle = default(Vector3);
        var momentum = default(Vector3);
        for (int i = 0; i < 4; ++i)
        {
            middle += world.Bodies[bodies[i]].Pose.Position * (i < 2 ? 0.5f : -0.5f);
            momentum += world.Bodies[bodies[i]].Velocity.Linear * (1 + i);
        }
        Assert.True(middle.Length() < 1e-3f, $"{middle}");
        // At the start sum m v = (0 + 2 + 6 + 12, 2 + 2 + 0 - 4, 16); 10 kg fall for a second.
        Assert.True((momentum - new Vector3(20, -98.1f, 16)).Length() < 0.05f, $"{momentum}");
    }
}
