using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;

namespace Demos.Accuracy.Cases;

/// <summary>
/// A light body that carries many arms in ball sockets (E2), free of all forces. Each joint is coupled to each other through the hub: swept over in
/// the same order each time, they gain energy without bound at stiffnesses that a chain holds.
/// </summary>
static class HubCases
{
    const float ArmRadius = .25f, HubRadius = .5f;
    const double Duration = 10, Settling = 1;

    static readonly (int Arms, float HubMass)[] hubs = [(8, 1), (20, 2), (50, 5), (200, 20)];

    // Ten times less mass than a game would give a hub of that many arms: only what it gains is judged.
    static readonly (int Arms, float HubMass)[] lightHubs = [(8, .2f), (20, .2f), (50, .5f), (200, 2)];

    /// <summary>Settings that hold usual hubs to rises as well, and those of which only the gain is judged.</summary>
    static readonly AccuracySettings[] held = [new(), new() { SubstepCount = 8 }, AccuracySettings.For(Effort.Accurate)];
    static readonly AccuracySettings[] others =
    [
        new() { SubstepCount = 1 },
        new() { SubstepCount = 1, VelocityIterationCount = 8 },
        new() { VelocityIterationCount = 2 },
        new() { VelocityIterationCount = 3 },
        new() { RelaxationCount = 1 },
    ];

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. from length in new[] { 1.5f, 0 }
           from settings in held.Concat(others)
           from hub in hubs.Concat(lightHubs)
           let isHeld = held.Contains(settings) && hubs.Contains(hub)
           select new AccuracyCase("E2", FormattableString.Invariant($"{hub.Arms} arms of {length} m on {hub.HubMass} kg"), null,
               (used, result) => Run(used, hub.Arms, hub.HubMass, length, isHeld, result)) { Settings = settings },
    ];

    static void Run(AccuracySettings settings, int arms, float hubMass, float length, bool isHeld, CaseResult result)
    {
        Gain(settings, arms, hubMass, length, out double gain, out double rise);
        // Joints that give as much as those of a light hub take up energy and give it back, which is a rise and no gain.
        result.Limit("energy gained", gain, .05, "%").Limit("rise once settled", rise, isHeld ? .05 : double.PositiveInfinity, "%");
    }

    /// <summary>
    /// Gain over the energy at the beginning, as a part of it, and greatest rise over the least value so far after a second. Arms begin with
    /// velocities of their own that the joints do not allow: what they store before they are at one is no part of the second.
    /// </summary>
    static void Gain(AccuracySettings settings, int armCount, float hubMass, float armLength, out double gain, out double rise)
    {
        using var world = new AccuracyWorld(settings with { Gravity = default, Contacts = ContactScope.None });
        AddHub(world, armCount, hubMass, armLength);
        double start = Energy(world, hubMass), highest = 0;
        world.Run(Settling, () => highest = Tally.Most(highest, Energy(world, hubMass)));
        double settled = Energy(world, hubMass), least = settled, greatestRise = 0;
        world.Run(Duration - Settling, () =>
        {
            double energy = Energy(world, hubMass);
            highest = Tally.Most(highest, energy);
            greatestRise = Tally.Most(greatestRise, energy - least);
            least = Math.Min(least, energy);
        });
        gain = Math.Max(0, highest / start - 1);
        rise = greatestRise / settled;
    }

    /// <summary>Arms of no length are joined at the centres: then all of their mass hangs on the hub.</summary>
    static void AddHub(AccuracyWorld world, int armCount, float hubMass, float armLength)
    {
        var random = new Random(1);
        var hub = world.AddDynamic(new Sphere(HubRadius), hubMass, new RigidPose(Vector3.Zero));
        float anchor = armLength > 0 ? HubRadius : 0;
        for (int i = 0; i < armCount; ++i)
        {
            var direction = Direction(i, armCount);
            var pose = new RigidPose(direction * (anchor + armLength));
            var arm = world.AddDynamic(new Sphere(ArmRadius), Mass(i), pose, new BodyVelocity(Any(random), Any(random)));
            world.Simulation.Solver.Add(hub, arm, new BallSocket
            {
                LocalOffsetA = direction * anchor,
                LocalOffsetB = direction * -armLength,
                SpringSettings = world.Settings.Spring,
            });
        }
    }

    static double Energy(AccuracyWorld world, float hubMass)
    {
        double sum = 0;
        for (int i = 0; i < world.Dynamics.Count; ++i)
        {
            double mass = i == 0 ? hubMass : Mass(i - 1), radius = i == 0 ? HubRadius : ArmRadius, moment = .4 * mass * radius * radius;
            sum += world.Energy(world.Dynamics[i], mass, new(moment, moment, moment));
        }
        return sum;
    }

    static float Mass(int arm) => 1 + arm % 3;

    static Vector3 Any(Random random) => new(2 * random.NextSingle() - 1, 2 * random.NextSingle() - 1, 2 * random.NextSingle() - 1);

    /// <summary>Evenly over the sphere, on a spiral.</summary>
    static Vector3 Direction(int index, int count)
    {
        double y = 1 - 2 * (index + .5) / count, across = Math.Sqrt(1 - y * y), angle = Math.PI * (3 - Math.Sqrt(5)) * index;
        return new((float)(across * Math.Cos(angle)), (float)y, (float)(across * Math.Sin(angle)));
    }
}
