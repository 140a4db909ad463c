using System;
using System.Linq;
using Demos.JointTables;
using Demos.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.JointTables;

/// <summary>Pendulums and linkages beside integrators in double precision that share nothing with the engine.</summary>
public class LinkageTests(ITestOutputHelper output)
{
    const double Gravity = 9.81f;

    public static TheoryData<string> Names => new(LinkageLibrary.All.Select(linkage => linkage.Name));

    static Linkage Find(string name) => LinkageLibrary.All.Single(linkage => linkage.Name == name);

    /// <summary>Without friction energy stays, and what is held stays together.</summary>
    [Theory, MemberData(nameof(Names))]
    public void The_reference_keeps_energy_and_lengths(string name)
    {
        ConstrainedBodies reference = Find(name).CreateReference();
        // Single-precision places are off by their last digits, which the first step puts right.
        reference.Advance(1e-3, 1e-3);
        double start = reference.Energy, scale = LinkageTruth.Of(Find(name)).EnergyScale;
        for (int i = 0; i < 20; ++i)
        {
            reference.Advance(.1, 1e-3);
            Assert.True(Math.Abs(reference.Energy - start) <= 1e-9 * scale, $"Energy changed by {reference.Energy - start} J.");
            Assert.True(reference.GreatestError <= 1e-12, $"Off by {reference.GreatestError}.");
        }
    }

    [Fact]
    public void The_reference_swings_a_pendulum_in_its_closed_form()
    {
        // A bar of 1 m and a section of .1 m, held at its end.
        const double moment = (1 + .01) / 12 + .25;
        double expected = PendulumOracle.Period(moment / .5, Gravity, Math.PI / 2);

        Assert.Equal(expected, LinkageTruth.Of(Find("pendulum")).Period, 1e-6 * expected);
    }

    [Fact]
    public void The_reference_agrees_with_the_equations_of_Lagrange()
    {
        ConstrainedBodies reference = Find("double-pendulum").CreateReference();
        var lagrange = new DoublePendulum(1, (1 + .01) / 12, Gravity, Math.PI / 2, Math.PI / 2);
        double start = lagrange.Energy;
        reference.Advance(LinkageRun.PlaceTime, 1e-3);
        lagrange.Advance(LinkageRun.PlaceTime, 1e-3);

        Double3 tip = reference.Point(1, new Double3(.5, 0, 0));
        Assert.Equal(start, lagrange.Energy, 1e-7);
        Assert.Equal(lagrange.Tip.X, tip.X, 1e-6);
        Assert.Equal(lagrange.Tip.Y, tip.Y, 1e-6);
        Assert.Equal(0, tip.Z, 1e-12);
    }

    /// <summary>Half the step makes no difference to what the engine is compared with.</summary>
    [Theory, MemberData(nameof(Names))]
    public void The_reference_has_converged(string name)
    {
        Linkage linkage = Find(name);
        LinkageTruth coarse = LinkageTruth.Integrate(linkage, 2e-3), fine = LinkageTruth.Of(linkage);

        Assert.Equal(0, (coarse.Place - fine.Place).Length, 1e-6);
        if (linkage.IsPeriodic)
            Assert.Equal(fine.Period, coarse.Period, 1e-5 * fine.Period);
    }

    /// <summary>What the double pendulum of the accuracy suite must keep, for all linkages; the loss of energy only where substeps are many.</summary>
    [Theory, MemberData(nameof(Names))]
    public void The_engine_follows(string name)
    {
        foreach ((int substeps, int relaxations) in new[] { (4, 0), (16, 1) })
        {
            LinkageRun run = LinkageRun.Measure(Find(name), JointTable.Settings(substeps, (1, relaxations), "rigid"));
            output.WriteLine($"{substeps} substeps, {relaxations} relaxations: {run}");
            Assert.InRange(run.PlaceError, 0, .1);
            Assert.InRange(run.PeriodError, -.01, .01);
            Assert.InRange(run.EnergyGain, 0, .02);
            Assert.InRange(run.Gap, 0, .02);
            if (substeps == 16)
                Assert.InRange(run.EnergyLeft, -.05, .02);
        }
    }

    /// <summary>
    /// A critically damped joint of frequency w gives way by F/(m w^2) under the pull of 5/2 m g at the lowest point. And bodies move along tangents: each
    /// substep leaves r (turn)^2 / 2 more, of which the joint takes w h / (w h + 2) back.
    /// </summary>
    [Theory]
    [InlineData(4)]
    [InlineData(8)]
    [InlineData(16)]
    [InlineData(32)]
    public void A_pendulum_separates_by_its_load_and_its_tangents(int substeps)
    {
        const double effectiveLength = ((1 + .01) / 12 + .25) / .5, arm = .5;
        double h = 1 / 60.0 / substeps, frequency = 2 * Math.PI * .125 / h;
        double squaredSpin = 2 * Gravity / effectiveLength, pull = Gravity + squaredSpin * arm;
        double expected = pull / (frequency * frequency) + arm * squaredSpin * h * h / 2 * (1 + 2 / (frequency * h));

        LinkageRun run = LinkageRun.Measure(Find("pendulum"), JointTable.Settings(substeps, (1, 0), "rigid"));

        Assert.Equal(expected, run.Gap, .05 * expected);
    }

    /// <summary>
    /// What a joint's damper takes, 2 z w m C'^2 with C = F/(m w^2), goes with the third power of the substep, and is no more than this formula says.
    /// </summary>
    [Fact]
    public void A_pendulum_loses_energy_with_the_third_power_of_the_substep()
    {
        double Loss(int substeps) => -LinkageRun.Measure(Find("pendulum"), JointTable.Settings(substeps, (1, 0), "rigid")).EnergyLeft;
        double coarse = Loss(4), fine = Loss(8);
        output.WriteLine($"{coarse}, {fine}");
        Assert.InRange(coarse / fine, 6, 10);
        Assert.InRange(coarse, 0, DampedPart(4));
        Assert.InRange(fine, 0, DampedPart(8));
    }

    // The integral of (2 + w h) F' K F' / w^3 over a minute of the true motion, over the energy of the swing; F is the force of the pivot.
    static double DampedPart(int substeps)
    {
        const double moment = (1 + .01) / 12, effectiveLength = (moment + .25) / .5, step = 1e-4;
        double h = 1 / 60.0 / substeps, frequency = 2 * Math.PI * .125 / h;
        double angle = Math.PI / 2, spin = 0, sum = 0;
        (double Along, double Across) last = default;
        for (int i = 0; i < LinkageRun.Duration / step; ++i)
        {
            double acceleration = -Gravity / effectiveLength * Math.Sin(angle);
            (double Along, double Across) force = (Gravity * Math.Cos(angle) + spin * spin / 2, acceleration / 2 + Gravity * Math.Sin(angle));
            if (i > 0)
            {
                // In the bar's axes, plus what the turning of these adds.
                double along = (force.Along - last.Along) / step - spin * force.Across, across = (force.Across - last.Across) / step + spin * force.Along;
                sum += (along * along + (1 + .25 / moment) * across * across) * step;
            }
            last = force;
            spin += acceleration * step;
            angle += spin * step;
        }
        return (2 + frequency * h) / (frequency * frequency * frequency) * sum / (Gravity / 2);
    }
}
