using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.Events;

/// <summary>The speed of approach that is told of a touch is that at which what falls meets the floor, not that at which the step began.</summary>
public class ApproachSpeedTests(ITestOutputHelper output)
{
    const float Gravity = 9.81f;

    public enum Falling
    {
        Ball,
        FlatBox,
        BoxOnEdge,
    }

    [Theory]
    [InlineData(Falling.Ball, 0)]
    [InlineData(Falling.FlatBox, 0)]
    [InlineData(Falling.BoxOnEdge, 0)]
    [InlineData(Falling.Ball, .5f)]
    [InlineData(Falling.FlatBox, .5f)]
    public void What_falls_is_told_of_at_the_speed_of_its_fall(Falling falling, float restitution)
    {
        double worst = 0;
        foreach (float height in new[] { .1f, .3f, 1, 5, 20 })
            foreach (int rate in new[] { 30, 60, 120, 240 })
                worst = Math.Max(worst, Math.Abs(SpeedOf(falling, restitution, height, 1f / rate) / Math.Sqrt(2 * Gravity * height) - 1));
        output.WriteLine($"{worst:p2}");
        Assert.InRange(worst, 0, .01);
    }

    static float SpeedOf(Falling falling, float restitution, float height, float dt)
    {
        var pool = new BufferPool();
        var callbacks = new DefaultNarrowPhaseCallbacks(new PairMaterialProperties(.5f, 2, SpringSettings.Rigid))
        {
            Surface = new() { Restitution = restitution },
        };
        float speed = 0;
        using (var simulation = Simulation.Create(pool, callbacks, new DefaultPoseIntegratorCallbacks(new Vector3(0, -Gravity, 0)), SolveDescription.Default))
        {
            simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), simulation.Shapes.Add(new Box(100, 1, 100))));
            const float size = .5f;
            float bottom = falling == Falling.BoxOnEdge ? size * MathF.Sqrt(.5f) : size / 2;
            var turn = falling == Falling.BoxOnEdge ? Quaternion.CreateFromAxisAngle(Vector3.UnitZ, MathF.PI / 4) : Quaternion.Identity;
            var pose = new RigidPose(new Vector3(0, height + bottom, 0), turn);
            var body = falling == Falling.Ball
                ? simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(pose, 1, simulation.Shapes, new Sphere(size / 2)))
                : simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(pose, 1, simulation.Shapes, new Box(size, size, size)));
            simulation.Events.Listen(body, EventMask.Begin);
            for (double time = 0; speed == 0 && time < 3; time += dt)
            {
                simulation.Timestep(dt);
                foreach (ref readonly var touch in simulation.Events.Began)
                    speed = touch.ApproachSpeed;
            }
        }
        pool.Clear();
        return speed;
    }
}
