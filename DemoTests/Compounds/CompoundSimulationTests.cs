using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Compounds;

/// <summary>Bodies and statics that are compounds.</summary>
public class CompoundSimulationTests
{
    static readonly (Vector3, RigidPose)[] floor =
    [
        (new(4, 1, 8), new RigidPose(new Vector3(-2, -.5f, 0))), (new(4, 1, 8), new RigidPose(new Vector3(2, -.5f, 0))),
        (new(.5f, 2, 8), new RigidPose(new Vector3(-4, 0, 0))), (new(.5f, 2, 8), new RigidPose(new Vector3(4, 0, 0))),
    ];

    // An L with a foot.
    static readonly (Vector3, RigidPose)[] angle =
    [
        (new(1, .25f, .5f), new RigidPose(new Vector3(0, 0, 0))), (new(.25f, 1, .5f), new RigidPose(new Vector3(.4f, .6f, 0))),
        (new(.3f, .3f, .9f), new RigidPose(new Vector3(-.3f, .1f, 0), Quaternion.CreateFromAxisAngle(Vector3.UnitY, .3f))),
    ];

    static CompoundWorld CreateHeap(int threads, bool isBig)
    {
        var world = new CompoundWorld(threads);
        world.AddStatic(isBig, floor);
        var random = new Random(LevelSeeds.Of(3));
        for (int i = 0; i < 24; ++i)
        {
            var turn = Quaternion.Normalize(new(random.NextSingle(), random.NextSingle(), random.NextSingle(), 1));
            world.AddBody(new RigidPose(new Vector3(i % 4 * 1.4f - 2, 1 + i / 4 * 1.3f, i % 3 - 1), turn), default, i % 2 == 0, angle);
        }
        var sphere = new Sphere(.3f);
        world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(
            new Vector3(0, 9, 0), sphere.ComputeInertia(1), world.Simulation.Shapes.Add(sphere), -1f));
        return world;
    }

    [Theory, InlineData(false), InlineData(true)]
    public void Any_number_of_threads_gives_the_same_bits_and_nothing_leaks(bool isBig)
    {
        using var expected = CreateHeap(1, isBig);
        using var actual = CreateHeap(3, isBig);
        for (int i = 0; i < 150; ++i)
        {
            expected.Step(validate: i % 25 == 0);
            actual.Step();
            Assert.Equal(expected.State(), actual.State());
        }
        // Nothing falls through; the floor has no walls before and behind.
        var over = Positions(expected).Where(position => MathF.Abs(position.Z) < 4).ToList();
        Assert.InRange(over.Count, 22, 25);
        Assert.All(over, position => Assert.InRange(position.Y, -.1f, 10));
    }

    static IEnumerable<Vector3> Positions(CompoundWorld world)
    {
        for (int i = 0; i < world.Simulation.Bodies.ActiveSet.Count; ++i)
            yield return world.Simulation.Bodies.ActiveSet.MotionStates[i].Pose.Position;
    }

    [Theory, InlineData(false), InlineData(true)]
    public void A_compound_rests(bool isBig)
    {
        using var world = new CompoundWorld();
        world.AddStatic(isBig, floor);
        // A table on four legs, over both halves of the floor.
        var table = world.AddBody(new RigidPose(new Vector3(0, 1.2f, 0)), default, isBig,
            (new(2, .2f, 2), new RigidPose(new Vector3(0, 1, 0))),
            (new(.2f, .9f, .2f), new RigidPose(new Vector3(-.8f, .45f, -.8f))), (new(.2f, .9f, .2f), new RigidPose(new Vector3(.8f, .45f, -.8f))),
            (new(.2f, .9f, .2f), new RigidPose(new Vector3(-.8f, .45f, .8f))), (new(.2f, .9f, .2f), new RigidPose(new Vector3(.8f, .45f, .8f))));
        for (int i = 0; i < 240; ++i)
            world.Step();
        var start = world.Simulation.Bodies[table].Pose;
        for (int i = 0; i < 300; ++i)
        {
            world.Step();
            var velocity = world.Simulation.Bodies[table].Velocity;
            Assert.InRange(velocity.Linear.LengthSquared() + velocity.Angular.LengthSquared(), 0, 1e-6f);
        }
        // A plate of .8 kg at 1 m and legs of .144 kg at .45 m have their centre at .916 m.
        var pose = world.Simulation.Bodies[table].Pose;
        Assert.InRange(pose.Position.Y, .9f, .92f);
        Assert.InRange((pose.Position - start.Position).Length(), 0, 1e-3f);
        Assert.InRange(Math.Abs(pose.Orientation.W), .99999f, 1.00001f);
    }

    [Fact]
    public void A_tumbling_compound_keeps_its_angular_momentum()
    {
        using var world = new CompoundWorld(gravity: 0);
        var handle = world.AddBody(RigidPose.Identity, new(new Vector3(1, 2, 3), new Vector3(3, 1, 5)), isBig: false, angle);
        var first = Momentum(world.Simulation.Bodies[handle]);
        for (int i = 0; i < 600; ++i)
            world.Step();
        var body = world.Simulation.Bodies[handle];
        Assert.InRange((Momentum(body) - first).Length() / first.Length(), 0, 1e-4f);
        Assert.InRange((body.Pose.Position - new Vector3(10, 20, 30)).Length(), 0, 1e-3f);
    }

    static Vector3 Momentum(in BodyReference body)
    {
        var local = Exact.RotateByInverse(body.Velocity.Angular, body.Pose.Orientation);
        return Exact.Rotate(Symmetric3x3.Invert(body.LocalInertia.InverseInertiaTensor) * local, body.Pose.Orientation);
    }

    [Theory, InlineData(false), InlineData(true)]
    public void A_step_makes_no_garbage(bool isBig)
    {
        using var world = CreateHeap(1, isBig);
        for (int i = 0; i < 200; ++i)
            world.Step();
        Assert.Equal(0, Garbage.Of(() => world.Step()));
    }

    struct Hit : IRayHitHandler
    {
        public int Child;
        public float T;

        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => childIndex != 1;

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex) =>
            (Child, T, maximumT) = (childIndex, t, t);
    }

    [Theory, InlineData(false), InlineData(true)]
    public void A_ray_is_told_the_child(bool isBig)
    {
        using var world = new CompoundWorld();
        world.AddStatic(isBig, floor);
        var hit = default(Hit);
        world.Simulation.RayCast(new Vector3(4, 5, 0), -Vector3.UnitY, 100, world.Pool, ref hit);
        Assert.Equal((3, 4f), (hit.Child, hit.T));
        hit = default;
        world.Simulation.RayCast(new Vector3(2, 5, 0), -Vector3.UnitY, 100, world.Pool, ref hit);
        Assert.Equal(0, hit.T);
    }

    [Fact]
    public void A_body_may_get_a_compound_and_give_it_back()
    {
        using var world = CreateHeap(1, isBig: false);
        var handle = world.Simulation.Bodies.ActiveSet.IndexToHandle[0];
        var compound = world.Simulation.Bodies[handle].Collidable.Shape;
        var sphere = world.Simulation.Shapes.Add(new Sphere(.5f));
        for (int i = 0; i < 40; ++i)
        {
            world.Step(validate: true);
            if (i % 10 == 9)
                world.Simulation.Bodies.SetShape(handle, i == 19 ? sphere : i == 29 ? default : compound);
        }
        Assert.Throws<InvalidOperationException>(() => world.Simulation.Shapes.RecursivelyRemoveAndDispose(compound, world.Pool));
    }
}
