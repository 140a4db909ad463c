using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>
/// Bodies that turn far within a step meet contacts whose arms and normals are those of its beginning. A box that spins on the ground,
/// between two walls that are nearer than its diagonal, or in a corner only loses energy, however fast (E1).
/// </summary>
static class FastTurnCases
{
    const int SeedCount = 24;
    static readonly Vector3 size = new(.2f, .3f, .6f);

    enum Place
    {
        Ground,
        Slot,
        Corner,
    }

    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. from place in Enum.GetValues<Place>()
           from substeps in new[] { 1, 4, 16 }
           from relaxations in new[] { 0, 1 }
           from spin in new[] { 20f, 60, 200, 1000 }
           select new AccuracyCase("E1", FormattableString.Invariant($"{place}, {spin} rad/s"), null, (settings, result) => Run(settings, place, spin, result))
           {
               Settings = new() { SubstepCount = substeps, RelaxationCount = relaxations },
           },
    ];

    static void Run(AccuracySettings settings, Place place, float spin, CaseResult result)
    {
        double worst = 0;
        for (int seed = 0; seed < SeedCount; ++seed)
            worst = Tally.Most(worst, Gain(settings, place, spin, new Random(seed)));
        result.Limit("energy gained", worst, .05, "%");
    }

    /// <summary>Greatest rise of the energy over its least value so far, as a part of what there was at the beginning.</summary>
    static double Gain(AccuracySettings settings, Place place, float spin, Random random)
    {
        using var world = new AccuracyWorld(settings);
        world.AddGround();
        AddWalls(world, place);
        var orientation = Quaternion.CreateFromAxisAngle(Direction(random), random.NextSingle() * 3);
        var pose = new RigidPose(new Vector3(0, place == Place.Ground ? .8f : .5f, 0), orientation);
        var body = world.AddDynamic(new Box(size.X, size.Y, size.Z), 1, pose, new BodyVelocity(default, Direction(random) * spin));
        var inertia = new Double3(Moment(size.Y, size.Z), Moment(size.X, size.Z), Moment(size.X, size.Y));
        double start = world.Energy(body, 1, inertia), least = start, gain = 0;
        world.Run(3, () =>
        {
            double energy = world.Energy(body, 1, inertia);
            gain = Tally.Most(gain, energy - least);
            least = Math.Min(least, energy);
        });
        return gain / start;
    }

    static void AddWalls(AccuracyWorld world, Place place)
    {
        // The box is 0.7 m from corner to corner.
        const float narrow = .34f, wide = .36f;
        switch (place)
        {
            case Place.Slot:
                world.AddStatic(new Box(1, 4, 4), new RigidPose(new Vector3(-.5f - narrow, 2, 0)));
                world.AddStatic(new Box(1, 4, 4), new RigidPose(new Vector3(.5f + narrow, 2, 0)));
                break;
            case Place.Corner:
                world.AddStatic(new Box(1, 4, 4), new RigidPose(new Vector3(-.5f - wide, 2, 0)));
                world.AddStatic(new Box(4, 4, 1), new RigidPose(new Vector3(0, 2, -.5f - wide)));
                break;
        }
    }

    static double Moment(double a, double b) => (a * a + b * b) / 12;

    static Vector3 Direction(Random random)
    {
        double z = 2 * random.NextDouble() - 1, angle = 2 * Math.PI * random.NextDouble(), across = Math.Sqrt(1 - z * z);
        return new((float)(across * Math.Cos(angle)), (float)(across * Math.Sin(angle)), (float)z);
    }
}
