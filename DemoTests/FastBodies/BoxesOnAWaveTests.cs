using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.FastBodies;

/// <summary>Thin boxes that spin fall on a wavy mesh: nobody comes below it, and all but a few come to rest.</summary>
public class BoxesOnAWaveTests
{
    const int Side = 20;
    const float Spacing = .5f;
    const int Cells = 48;
    const float CellSize = .5f;

    static float HeightAt(float x, float z) => .3f * MathF.Sin(x) * MathF.Cos(z);

    [Theory]
    [InlineData(ContinuousDetectionMode.Passive)]
    [InlineData(ContinuousDetectionMode.Continuous)]
    public void NobodyFallsThroughAndAllFallAsleep(ContinuousDetectionMode mode)
    {
        using var world = new TestWorld(new AccuracySettings { Friction = 1 });
        using var mesh = new OwnedMesh(world);
        var random = new Random(3);
        var box = new Box(.04f, .4f, .08f);
        var collidable = new CollidableDescription(world.Simulation.Shapes.Add(box), new ContinuousDetection { Mode = mode });
        var boxes = new List<BodyHandle>();
        for (int i = 0; i < Side * Side; ++i)
        {
            var place = new Vector3((i % Side - Side / 2) * Spacing, 1 + random.NextSingle(), (i / Side - Side / 2) * Spacing);
            boxes.Add(world.Bodies.Add(BodyDescription.CreateDynamic(new RigidPose(place, TestWorld.Turn(random)),
                new BodyVelocity(new Vector3(0, -5, 0), TestWorld.Scatter(random, 60)), box.ComputeInertia(1), collidable, .02f)));
        }
        for (int step = 0; step < 300; ++step)
        {
            world.Step();
            foreach (var handle in boxes)
            {
                var position = world.Bodies[handle].Pose.Position;
                // The facets are below the wave by a part of their curvature at most: c^2 / 8 for each of two directions, of a curvature of .3 / m.
                Assert.True(position.Y > HeightAt(position.X, position.Z) - 2 * .3f * CellSize * CellSize / 8, $"{handle} is at {position} in step {step}.");
            }
        }
        // Some lean on others in a hollow and rock by millimetres a second: none to three of these 400, by the numbers drawn.
        Assert.InRange(world.Bodies.ActiveSet.Count, 0, 4);
    }

    readonly struct OwnedMesh : IDisposable
    {
        readonly TestWorld world;
        readonly Mesh mesh;

        public OwnedMesh(TestWorld world)
        {
            this.world = world;
            var corners = new Vector3[(Cells + 1) * (Cells + 1)];
            var indices = new List<int>();
            for (int i = 0; i < corners.Length; ++i)
            {
                var (x, z) = ((i % (Cells + 1) - Cells / 2) * CellSize, (i / (Cells + 1) - Cells / 2) * CellSize);
                corners[i] = new Vector3(x, HeightAt(x, z), z);
            }
            for (int cell = 0; cell < Cells * Cells; ++cell)
            {
                var first = cell / Cells * (Cells + 1) + cell % Cells;
                indices.AddRange([first, first + 1, first + Cells + 1, first + 1, first + Cells + 2, first + Cells + 1]);
            }
            mesh = new Mesh(corners, indices.ToArray(), Vector3.One, world.Pool);
            world.Statics.Add(new StaticDescription(default, Quaternion.Identity, world.Simulation.Shapes.Add(mesh)));
        }

        public void Dispose() => mesh.Dispose(world.Pool);
    }
}
