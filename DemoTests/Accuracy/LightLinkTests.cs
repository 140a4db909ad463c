using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.References;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>
/// A heavy rod welded to a light link that is welded to the world, all in a horizontal line: the welds give and the rod hangs down, but nothing gains
/// energy, whichever of its two bodies a weld calls the first.
/// </summary>
public class LightLinkTests(ITestOutputHelper output)
{
    const float LinkMass = 2, RodWidth = .2f;

    [Theory]
    [InlineData(1, 0)]
    [InlineData(4, 0)]
    [InlineData(4, 1)]
    [InlineData(16, 1)]
    public void A_heavy_rod_on_a_light_link_gains_no_energy(int substeps, int relaxations)
    {
        foreach (float rodMass in (ReadOnlySpan<float>)[20, 50, 100, 1000])
        {
            foreach (float linkSize in (ReadOnlySpan<float>)[.1f, .2f, .5f])
            {
                foreach (float rodLength in (ReadOnlySpan<float>)[.5f, 1, 2])
                {
                    foreach (bool rodIsFirst in (ReadOnlySpan<bool>)[false, true])
                    {
                        var settings = new AccuracySettings { SubstepCount = substeps, RelaxationCount = relaxations, Contacts = ContactScope.None };
                        using var world = new AccuracyWorld(settings);
                        double gain = Gain(world, rodMass, linkSize, rodLength, rodIsFirst, out double speed);
                        string where = FormattableString.Invariant($"{rodMass} kg, {rodLength} m on {linkSize} m, {(rodIsFirst ? "rod" : "link")} first");
                        output.WriteLine(FormattableString.Invariant($"{where}: gain {gain:G3} of the fall, {speed:F2} m/s at most"));
                        Assert.True(gain < .01, FormattableString.Invariant($"{where}: gained {gain:G3} of what its fall gives"));
                    }
                }
            }
        }
    }

    /// <summary>Greatest rise over the energy at the start, as a part of what a fall by the length of both gives.</summary>
    static double Gain(AccuracyWorld world, float rodMass, float linkSize, float rodLength, bool rodIsFirst, out double speed)
    {
        var solver = world.Simulation.Solver;
        var link = world.AddDynamic(new Box(linkSize, linkSize, linkSize), LinkMass, new RigidPose(new Vector3(linkSize / 2, 0, 0)));
        var rod = world.AddDynamic(new Box(rodLength, RodWidth, RodWidth), rodMass, new RigidPose(new Vector3(linkSize + rodLength / 2, 0, 0)));
        var between = new Vector3((linkSize + rodLength) / 2, 0, 0);
        solver.Add(world.AddAnchor(Vector3.Zero), link,
            new Weld { LocalOffset = new Vector3(linkSize / 2, 0, 0), LocalOrientation = Quaternion.Identity });
        if (rodIsFirst)
            solver.Add(rod, link, new Weld { LocalOffset = -between, LocalOrientation = Quaternion.Identity });
        else
            solver.Add(link, rod, new Weld { LocalOffset = between, LocalOrientation = Quaternion.Identity });
        var (linkMoments, rodMoments) = (Moments(LinkMass, linkSize, linkSize), Moments(rodMass, rodLength, RodWidth));
        double Energy() => world.Energy(link, LinkMass, linkMoments) + world.Energy(rod, rodMass, rodMoments);

        double start = Energy(), highest = start, fastest = 0;
        world.Run(8, () =>
        {
            highest = Tally.Most(highest, Energy());
            fastest = Tally.Most(fastest, Math.Max(world.LinearVelocity(link).Length, world.LinearVelocity(rod).Length));
        });
        speed = fastest;
        return (highest - start) / ((LinkMass + rodMass) * 9.81 * (linkSize + rodLength));
    }

    static Double3 Moments(double mass, double length, double width) =>
        new Double3(2 * width * width, length * length + width * width, length * length + width * width) * (mass / 12);
}
