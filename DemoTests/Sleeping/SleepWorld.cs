using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Sleeping;

/// <summary>A world whose bodies may sleep, on a floor whose upper side is at height 0.</summary>
sealed class SleepWorld : IDisposable
{
    public const int StepsUntilAsleep = 40;
    public static readonly BodyActivityDescription Activity = new(.01f);

    public SleepWorld(int threads = 1, ITimestepper? timestepper = null)
    {
        World = new TestWorld(threads: threads, timestepper: timestepper);
        Cube = Simulation.Shapes.Add(new Box(1, 1, 1));
        Floor = AddFloor();
    }

    public TestWorld World { get; }

    public Simulation Simulation => World.Simulation;

    public Bodies Bodies => World.Bodies;

    public TypedIndex Cube { get; private set; }

    public StaticHandle Floor { get; private set; }

    public StaticHandle AddFloor() => World.AddStatic(new Box(200, 2, 200), new RigidPose(new Vector3(0, -1, 0)));

    public BodyHandle AddCube(Vector3 position, float mass = 1) => Bodies.Add(
        BodyDescription.CreateDynamic(position, new Box(1, 1, 1).ComputeInertia(mass), Cube, Activity));

    public BodyHandle AddPlatform(Vector3 position) => Bodies.Add(BodyDescription.CreateKinematic(position, Simulation.Shapes.Add(new Box(3, 1, 3)), Activity));

    /// <summary>Cubes on top of each other, standing on a height.</summary>
    public BodyHandle[] AddStack(float x, int count, float height = 0) =>
        [.. Enumerable.Range(0, count).Select(i => AddCube(new Vector3(x, height + .5f + i, 0)))];

    public void Step(int count = 1)
    {
        for (int i = 0; i < count; ++i)
        {
            World.Step();
            Simulation.Validate();
        }
    }

    /// <summary>Steps until all bodies sleep.</summary>
    public void Settle(int mostSteps = 300)
    {
        for (int i = 0; i < mostSteps && Bodies.ActiveSet.Count > 0; ++i)
            Step();
        Assert.Equal(0, Bodies.ActiveSet.Count);
    }

    /// <summary>Stacks that fall asleep one after the other, and a ball that wakes one of them.</summary>
    public void Fill()
    {
        for (int i = 0; i < 12; ++i)
            AddStack(2 * i, 1 + i % 4);
        var sphere = new Sphere(.4f);
        Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(-20, .4f, .2f), new BodyVelocity(new Vector3(20, 0, 0)), sphere.ComputeInertia(5), Simulation.Shapes.Add(sphere), Activity));
    }

    public List<ulong> HashSteps(int count) => World.HashSteps(count);

    /// <summary>Leaves nothing but a floor.</summary>
    public void Clear()
    {
        Simulation.Clear();
        Simulation.Validate();
        Cube = Simulation.Shapes.Add(new Box(1, 1, 1));
        Floor = AddFloor();
    }

    public bool IsAwake(BodyHandle body) => Bodies[body].Awake;

    /// <summary>Requires that exactly some of all bodies are awake.</summary>
    public void AssertAwake(params IEnumerable<BodyHandle> expected)
    {
        var awake = new List<int>();
        for (int slot = 0; slot < Bodies.HandleToLocation.Length; ++slot)
        {
            if (Bodies.TryGetHandle(slot, out var handle) && IsAwake(handle))
                awake.Add(slot);
        }
        Assert.Equal(expected.Select(body => body.Slot).Order(), awake);
    }

    public void Dispose() => World.Dispose();
}
