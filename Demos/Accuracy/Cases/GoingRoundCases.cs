using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.References;

namespace Demos.Accuracy.Cases;

/// <summary>What goes round: on an orbit, by a force of the game's callbacks, and on an arm that a ball socket holds (C11).</summary>
/// <remarks>
/// An orbit about a centre that pulls with k / r^2 has the energy -k / 2a, whatever its shape, and takes 2 pi (a^3 / k)^(1/2). A bob on an arm of length l that
/// makes an angle b with the vertical goes round evenly at (g / (l cos b))^(1/2), however small it is.
/// </remarks>
static class GoingRoundCases
{
    public static IEnumerable<AccuracyCase> All { get; } =
    [
        .. from eccentricity in new[] { 0f, .5f }
           from substeps in new[] { true, false }
           from one in AccuracySuite.AtBothEfforts("C11",
               FormattableString.Invariant($"20 orbits, eccentricity {eccentricity}, {(substeps ? "in substeps" : "in whole steps")}"),
               (settings, result) => Orbit(settings with { SubstepsForFreeBodies = substeps }, eccentricity, result))
           select one,
        .. from radius in new[] { .01f, .05f, .3f }
           from angle in new[] { .3, 1, 1.4 }
           from one in AccuracySuite.AtBothEfforts("C11", FormattableString.Invariant($"bob of {radius} m on an arm of 1 m, {angle} rad"),
               (settings, result) => Whirl(settings, radius, angle, result))
           select one,
    ];

    static void Orbit(AccuracySettings settings, float eccentricity, CaseResult result)
    {
        const double axis = 10, pull = 100;
        var pool = new BufferPool();
        using var simulation = Simulation.Create(pool, EngineTraits.Contacts(settings), new Centre((float)pull, settings), EngineTraits.Solve(settings));
        var nearest = axis * (1 - eccentricity);
        var speed = Math.Sqrt(pull * (2 / nearest - 1 / axis));
        var body = simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new RigidPose(new Vector3((float)nearest, 0, 0)), new BodyVelocity(new Vector3(0, (float)speed, 0)), new Sphere(.5f).ComputeInertia(1),
            default(CollidableDescription), new BodyActivityDescription(-1)));
        var period = 2 * Math.PI * Math.Sqrt(axis * axis * axis / pull);
        double turned = 0, last = 0, time = 0;
        while (turned < 20 * 2 * Math.PI && time < 25 * period)
        {
            simulation.Timestep(settings.Dt);
            time += settings.Dt;
            var place = simulation.Bodies[body].Pose.Position;
            var angle = Math.Atan2(place.Y, place.X);
            turned += Math.IEEERemainder(angle - last, 2 * Math.PI);
            last = angle;
        }
        Double3 position = simulation.Bodies[body].Pose.Position, velocity = simulation.Bodies[body].Velocity.Linear;
        var energy = velocity.LengthSquared / 2 - pull / position.Length;
        result.Limit("energy", energy / (-pull / (2 * axis)) - 1, 1e-3, "%")
            .Limit("period", time / (20 * period) - 1, 2e-3, "%");
        simulation.Dispose();
        pool.Clear();
    }

    static void Whirl(AccuracySettings settings, float radius, double angle, CaseResult result)
    {
        using var world = new AccuracyWorld(settings);
        var arm = new Vector3((float)Math.Sin(angle), -(float)Math.Cos(angle), 0);
        var gravity = -(double)settings.Gravity.Y;
        var rate = Math.Sqrt(gravity / Math.Cos(angle));
        var spin = new Vector3(0, (float)rate, 0);
        var bob = world.AddDynamic(new Sphere(radius), 1, new RigidPose(arm), new BodyVelocity(Vector3.Cross(spin, arm), spin));
        world.Simulation.Solver.Add(world.AddAnchor(default), bob, new BallSocket { LocalOffsetB = -arm, SpringSettings = settings.Spring });
        var moment = .4 * radius * radius;
        var inertia = new Double3(moment, moment, moment);
        double Energy() => world.Energy(bob, 1, inertia) + gravity;
        double start = Energy(), most = start, turned = 0, last = 0;
        world.Run(20, () =>
        {
            most = Math.Max(most, Energy());
            var place = world.Position(bob);
            var now = Math.Atan2(-place.Z, place.X);
            turned += Math.IEEERemainder(now - last, 2 * Math.PI);
            last = now;
        });
        result.Limit("energy gained", most / start - 1, .01, "%")
            .Limit("rate", turned / world.Time / rate - 1, .05, "%")
            .Note("energy kept", Energy() / start, "%");
    }

    // A force that depends on the place.
    struct Centre(float pull, AccuracySettings settings) : IPoseIntegratorCallbacks
    {
        public readonly AngularIntegrationMode AngularIntegrationMode { get; } = settings.AngularMode;

        public readonly bool AllowSubstepsForUnconstrainedBodies { get; } = settings.SubstepsForFreeBodies;

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
            var squared = position.X * position.X + position.Y * position.Y + position.Z * position.Z;
            velocity.Linear = velocity.Linear - position * (new Vector<float>(pull) * dt / (squared * Vector.SquareRoot(squared)));
        }
    }
}
