using System;
using System.Numerics;
using BepuPhysics.Constraints;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>What is worked out once for all rigid joints of a substep has the bits of what is worked out for one lane beside a spring.</summary>
public class RigidSoftnessTests
{
    [Theory]
    [InlineData(1, 0, false)]
    [InlineData(1, 1, false)]
    [InlineData(1, 1, true)]
    [InlineData(3, 0, false)]
    [InlineData(8, 2, false)]
    public void Rigid_joints_are_as_soft_beside_a_spring_as_without_one(int iterations, int relaxations, bool isRelaxation)
    {
        var random = new Random(iterations);
        for (int i = 0; i < 200; ++i)
        {
            var dt = (.1f + random.NextSingle()) / 100;
            // Of a longer substep than usual as well, and of one that is solved with all others at once.
            var usual = random.Next(2) * dt * (.3f + random.NextSingle());
            var substep = new Substep(i % 3, dt, 1, iterations, relaxations, isRelaxation, usual);
            Check(substep, random);
            Check(substep.Directly(), random);
            Check(substep.DirectlyWithBounds(), random);
        }
    }

    static void Check(in Substep substep, Random random)
    {
        Span<int> hubs = stackalloc int[Vector<int>.Count];
        Span<float> damping = stackalloc float[Vector<int>.Count], frequency = stackalloc float[Vector<int>.Count];
        for (int lane = 0; lane < Vector<int>.Count; ++lane)
        {
            hubs[lane] = -random.Next(2);
            damping[lane] = random.NextSingle();
        }
        var rigid = new SpringSettingsWide { TwiceDampingRatio = new(damping) };
        frequency[0] = 30;
        var mixed = rigid with { AngularFrequency = new(frequency) };
        var mask = new Vector<int>(hubs);
        var coupling = new Vector<float>(random.Next(3) switch
        {
            0 => SpringSettingsWide.AloneCoupling,
            1 => SpringSettingsWide.HubCoupling,
            _ => SpringSettingsWide.ImplicitCoupling,
        });
        AssertSame(
            rigid.ForSubstep(substep, substep.Joints, substep.RigidJoints, mask, coupling),
            mixed.ForSubstep(substep, substep.Joints, substep.RigidJoints, mask, coupling));
        AssertSame(
            rigid.ForSubstep(substep, substep.Servos, substep.RigidServos, mask, coupling),
            mixed.ForSubstep(substep, substep.Servos, substep.RigidServos, mask, coupling));
    }

    static void AssertSame(in SoftnessWide expected, in SoftnessWide actual)
    {
        for (int lane = 1; lane < Vector<int>.Count; ++lane)
        {
            Assert.Equal(expected.ErrorToVelocity[lane], actual.ErrorToVelocity[lane]);
            Assert.Equal(expected.MassScale[lane], actual.MassScale[lane]);
            Assert.Equal(expected.ImpulseScale[lane], actual.ImpulseScale[lane]);
        }
    }
}
