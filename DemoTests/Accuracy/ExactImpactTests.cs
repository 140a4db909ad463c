using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Demos.Accuracy;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Accuracy;

/// <summary>What is asked to meet exactly and does not bounce stays where it lands.</summary>
public class ExactImpactTests(ITestOutputHelper output)
{
    const float Half = .25f;

    [Theory]
    [InlineData(1), InlineData(2), InlineData(4)]
    public void What_falls_stays_where_it_lands(int tiles)
    {
        // In units of what gravity gives within a substep.
        double fastest = 0, highest = 0;
        foreach (float dt in new[] { 1 / 30f, 1 / 60f, 1 / 120f })
            foreach (int substeps in new[] { 1, 4 })
                foreach (int relaxations in new[] { 0, 1 })
                    foreach (string shape in new[] { "box", "capsule", "sphere" })
                        for (int i = 0; i < 8; ++i)
                        {
                            var settings = new AccuracySettings { Dt = dt, SubstepCount = substeps, RelaxationCount = relaxations };
                            var (speed, height) = Drop(settings, tiles, shape, 1 + .21f * i);
                            double gained = 9.81 * settings.SubstepDuration;
                            fastest = Math.Max(fastest, speed / gained);
                            highest = Math.Max(highest, height / (gained * settings.SubstepDuration));
                        }
        output.WriteLine($"leaves at {fastest:g3} of what a substep of gravity gives, rises by {highest:g3} of its way");
        // An impact counts gravity from its time on, and takes that of before: half a substep's is the most that is left, which rises by an eighth.
        Assert.InRange(fastest, 0, .51);
        Assert.InRange(highest, 0, .13);
    }

    // Greatest speed and height after landing.
    static (double Speed, double Height) Drop(AccuracySettings settings, int tiles, string shape, float height)
    {
        var pool = new BufferPool();
        var callbacks = new DefaultNarrowPhaseCallbacks(new PairMaterialProperties(.5f, 2, SpringSettings.Rigid))
        {
            Surface = new() { ExactImpacts = true },
        };
        using var simulation = Simulation.Create(pool, callbacks, new WorldGravity(settings), EngineTraits.Solve(settings));
        var tile = simulation.Shapes.Add(new Box(2, 1, 2));
        for (int i = 0; i < tiles; ++i)
            simulation.Statics.Add(new StaticDescription(new Vector3(tiles == 1 ? 0 : 2 * (i % 2) - 1, -.5f, tiles < 4 ? 0 : 2 * (i / 2) - 1), tile));
        var pose = new RigidPose(new Vector3(0, Half + height, 0), Quaternion.CreateFromAxisAngle(Vector3.UnitZ, shape == "capsule" ? MathF.PI / 2 : 0));
        var never = new BodyActivityDescription(-1);
        var body = simulation.Bodies[simulation.Bodies.Add(shape switch
        {
            "box" => Describe(new Box(1, 2 * Half, .8f)),
            "capsule" => Describe(new Capsule(Half, 1)),
            _ => Describe(new Sphere(Half)),
        })];
        double fastest = 0, highest = 0, fall = Math.Sqrt(2 * height / 9.81);
        for (double time = 0; time < fall + .5; time += settings.Dt)
        {
            simulation.Timestep(settings.Dt);
            if (time < fall + settings.Dt)
                continue;
            fastest = Math.Max(fastest, body.Velocity.Linear.Y);
            highest = Math.Max(highest, body.Pose.Position.Y - Half);
        }
        return (fastest, highest);

        BodyDescription Describe<TShape>(TShape form) where TShape : unmanaged, IConvexShape =>
            BodyDescription.CreateDynamic(pose, form.ComputeInertia(1), new CollidableDescription(simulation.Shapes.Add(form)), never);
    }
}
