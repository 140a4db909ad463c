using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.References;

namespace Demos.Accuracy;

/// <summary>
/// A sphere of 1 kg on an arm of 1 m, held by a ball socket, let go at the horizontal; measures its period, its energy and the joint's gap.
/// </summary>
sealed class Pendulum
{
    const double Radius = .1;
    const double Gravity = 9.81f;

    readonly AccuracyWorld world;
    readonly BodyHandle body;
    readonly Double3 pivot;
    double lastX, lastTime, firstCrossing = double.NaN, latestCrossing = double.NaN;
    int crossings;

    public Pendulum(AccuracyWorld world, Vector3 origin = default)
    {
        this.world = world;
        var anchor = world.AddAnchor(origin);
        body = world.AddDynamic(new Sphere((float)Radius), 1, new RigidPose(origin + Vector3.UnitX));
        world.Simulation.Solver.Add(anchor, body, new BallSocket { LocalOffsetB = -Vector3.UnitX, SpringSettings = world.Settings.Spring });
        pivot = world.Position(anchor);
        lastX = 1;
    }

    public static double TruePeriod => PendulumOracle.Period(PendulumOracle.EffectiveLength(1, Radius), Gravity, Math.PI / 2);

    /// <summary>Mean over all whole swings so far. Without two crossings of the lowest point there is none: then it is zero.</summary>
    public double Period => crossings < 2 ? 0 : 2 * (latestCrossing - firstCrossing) / (crossings - 1);

    /// <summary>Largest error of energy as a part of what it has above its lowest point.</summary>
    public double EnergyError { get; private set; }

    /// <summary>The energy error that it has now.</summary>
    public double EnergyErrorNow { get; private set; }

    /// <summary>Largest distance of the sphere's end of the joint from the pivot, in metres.</summary>
    public double Gap { get; private set; }

    public void Observe()
    {
        var offset = world.Position(body) - pivot;
        // Far from the origin it may be seen exactly below the pivot; that is a crossing once.
        if (lastX > 0 != offset.X > 0 && offset.Y < 0)
        {
            latestCrossing = lastTime + (world.Time - lastTime) * lastX / (lastX - offset.X);
            firstCrossing = crossings++ == 0 ? latestCrossing : firstCrossing;
        }
        (lastX, lastTime) = (offset.X, world.Time);

        double moment = .4 * Radius * Radius;
        double kinetic = (world.LinearVelocity(body).LengthSquared + moment * world.AngularVelocity(body).LengthSquared) / 2;
        EnergyErrorNow = (kinetic + Gravity * offset.Y) / Gravity;
        EnergyError = Tally.Worst(EnergyError, EnergyErrorNow);
        Gap = Tally.Most(Gap, (offset + world.Orientation(body).Rotate(new(-1, 0, 0))).Length);
    }
}
