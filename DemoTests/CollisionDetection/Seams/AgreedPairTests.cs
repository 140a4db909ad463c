using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Demos.Scenes;
using DemoTests.CollisionDetection.Children;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What bodies that lie across statics have agreed on and remember.</summary>
public class AgreedPairTests
{
    const float Reach = 2;

    static readonly Quaternion Orientation = Quaternion.CreateFromYawPitchRoll(.3f, .2f, .1f);

    static AgreedBody Body => new() { Orientation = Orientation, Reach = Reach };

    static ConvexContactManifold Find()
    {
        var manifold = new ConvexContactManifold { OffsetB = new Vector3(3, -1, 2), Normal = Vector3.UnitY, Count = 4 };
        for (int i = 0; i < 4; ++i)
        {
            ref var contact = ref ConvexContactManifold.GetConvexContactReference(ref manifold, i);
            contact = new() { Offset = new Vector3(i, 0, 0), Depth = .01f * i, FeatureId = 10 + i };
        }
        return manifold;
    }

    static AgreedPair Remember(params int[] left)
    {
        var pair = default(AgreedPair);
        var manifold = Find();
        pair.Find(manifold);
        for (int i = 0; i < left.Length; ++i)
            ConvexContactManifold.GetConvexContactReference(ref manifold, i) = ConvexContactManifold.GetConvexContactReference(ref manifold, left[i]);
        manifold.Count = left.Length;
        Assert.True(pair.Leave(manifold));
        return pair;
    }

    [Theory, InlineData(new int[0]), InlineData(new[] { 2 }), InlineData(new[] { 0, 3 }), InlineData(new[] { 0, 1, 2, 3 })]
    public void What_was_left_is_left_again_as_it_is_found_now(int[] left)
    {
        var pair = Remember(left);
        var manifold = Find();
        for (int i = 0; i < 4; ++i)
            ConvexContactManifold.GetConvexContactReference(ref manifold, i).Depth += 1e-5f;
        Assert.True(pair.Holds(manifold, Orientation, Body));
        pair.Apply(ref manifold);
        Assert.Equal(left.Length, manifold.Count);
        for (int i = 0; i < left.Length; ++i)
        {
            var contact = ConvexContactManifold.GetConvexContactReference(ref manifold, i);
            Assert.Equal((10 + left[i], 1e-5f + .01f * left[i], (float)left[i]), (contact.FeatureId, contact.Depth, contact.Offset.X));
        }
    }

    [Fact]
    public void Contacts_that_were_not_found_are_not_remembered()
    {
        var pair = default(AgreedPair);
        var manifold = Find();
        pair.Find(manifold);
        manifold.Contact1.FeatureId = 99;
        Assert.False(pair.Leave(manifold));
        manifold = Find();
        manifold.Normal = Vector3.UnitX;
        Assert.False(pair.Leave(manifold));
    }

    [Fact]
    public void What_has_moved_or_is_touched_otherwise_agrees_anew()
    {
        var pair = Remember(1, 2);
        Assert.True(pair.Holds(Find(), Orientation, Body));
        var manifold = Find();
        manifold.OffsetB.Z += 1e-3f * Reach;
        Assert.False(pair.Holds(manifold, Orientation, Body));
        manifold = Find();
        manifold.Count = 3;
        Assert.False(pair.Holds(manifold, Orientation, Body));
        manifold = Find();
        manifold.Contact3.FeatureId = 14;
        Assert.False(pair.Holds(manifold, Orientation, Body));
        manifold = Find();
        manifold.Normal = Vector3.Normalize(new Vector3(1e-3f, 1, 0));
        Assert.False(pair.Holds(manifold, Orientation, Body));
        Assert.False(pair.Holds(Find(), Quaternion.Concatenate(Orientation, Quaternion.CreateFromAxisAngle(Vector3.UnitX, 1e-3f)), Body));
        // Another shape in the place of one.
        manifold = Find();
        manifold.Contact3.Depth += 1e-3f * Reach;
        Assert.False(pair.Holds(manifold, Orientation, Body));
    }

    [Fact]
    public void What_was_near_holds_wherever_it_is_until_it_is_touched()
    {
        var near = default(AgreedPair);
        Assert.True(near.Holds(default, Quaternion.Identity, Body));
        Assert.False(near.Holds(Find(), Orientation, Body));
    }

    // Four boxes that meet at the origin.
    static ClusterWorld CreateGround(bool remembers, out StaticHandle[] ground)
    {
        var world = new ClusterWorld(isCluster: true);
        world.Simulation.NarrowPhase.RemembersAgreements = remembers;
        var shape = world.Simulation.Shapes.Add(new Box(8, 1, 8));
        ground = new StaticHandle[4];
        for (int i = 0; i < 4; ++i)
            ground[i] = world.Simulation.Statics.Add(new StaticDescription(new Vector3(i % 2 * 8 - 4, -.5f, i / 2 * 8 - 4), shape));
        return world;
    }

    [Theory]
    [InlineData(0, 0), InlineData(.25f, 0), InlineData(.25f, .25f), InlineData(.2f, -.1f), InlineData(.2499f, .2501f), InlineData(-.25f, .13f)]
    public void What_is_remembered_changes_no_rest(float x, float z)
    {
        Span<Vector3> places = stackalloc Vector3[2];
        for (int remembers = 0; remembers < 2; ++remembers)
        {
            using var world = CreateGround(remembers == 1, out _);
            var body = world.AddBody(new Box(.5f, .5f, .5f), new RigidPose(new Vector3(x, .25f, z)), default);
            var remembered = 0;
            for (int i = 0; i < 240; ++i)
            {
                world.Step(validate: i % 20 == 0);
                remembered += CountRemembered(world);
                Assert.InRange(world.Simulation.Bodies[body].Velocity.Linear.Length(), 0, 1e-3f);
            }
            // It is found out anew after 16 steps, then after 32, and so on.
            Assert.InRange(remembered, remembers * 2 * 225, remembers * 4 * 237);
            places[remembers] = world.Simulation.Bodies[body].Pose.Position;
            Assert.InRange((places[remembers] - new Vector3(x, .25f, z)).Length(), 0, 1e-3f);
        }
        Assert.InRange((places[0] - places[1]).Length(), 0, 1e-5f);
    }

    /// <summary>Also where the ground that is taken had given up its contacts, or holds all of them.</summary>
    [Theory, InlineData(.25f), InlineData(.1f), InlineData(-.1f), InlineData(-.25f)]
    public void A_body_whose_ground_is_taken_falls(float x)
    {
        using var world = CreateGround(remembers: true, out var ground);
        var body = world.AddBody(new Box(.5f, .5f, .5f), new RigidPose(new Vector3(x, .25f, 1)), default);
        for (int i = 0; i < 100; ++i)
            world.Step();
        // Both that are under its middle, or beside it, on the side where x is positive.
        world.Simulation.Statics.Remove(ground[1]);
        world.Simulation.Statics.Remove(ground[3]);
        for (int i = 0; i < 60; ++i)
            world.Step();
        var height = world.Simulation.Bodies[body].Pose.Position.Y;
        if (x > 0)
            Assert.InRange(height, float.NegativeInfinity, 0);
        else
            Assert.InRange(height, .249f, .251f);
    }

    /// <summary>Contacts of the same features along the same normals, but deeper: nobody waits until it is found out anew.</summary>
    [Fact]
    public void A_static_that_grows_lifts_the_body()
    {
        const float Growth = .02f;
        using var world = CreateGround(remembers: true, out var ground);
        var body = world.AddBody(new Box(.5f, .5f, .5f), new RigidPose(new Vector3(.2f, .25f, .2f)), default);
        for (int i = 0; i < 200; ++i)
            world.Step();
        Assert.Equal(4, CountRemembered(world));
        var higher = world.Simulation.Shapes.Add(new Box(8, 1 + 2 * Growth, 8));
        foreach (var box in ground)
            world.Simulation.Statics.SetShape(box, higher);
        world.Step();
        Assert.Equal(0, CountRemembered(world));
        for (int i = 0; i < 60; ++i)
            world.Step();
        Assert.InRange(world.Simulation.Bodies[body].Pose.Position.Y, .25f + Growth * .9f, .25f + Growth * 1.1f);
    }

    /// <summary>Which bodies agree anew and which do not, and which worker has found what, makes no difference.</summary>
    [Fact]
    public void Bodies_of_which_some_are_pushed_move_alike_on_any_number_of_threads()
    {
        ulong[] hashes = [Push(1), Push(2), Push(3)];
        Assert.Equal([hashes[0], hashes[0], hashes[0]], hashes);
    }

    static ulong Push(int threads)
    {
        const int Width = 12, BodyCount = 400;
        var scene = new SceneDescription { Name = "tiles" };
        int tile = scene.AddBox(1, .5f, 1), box = scene.AddBox(.2f, .2f, .2f);
        for (int i = 0; i < Width * Width; ++i)
            scene.AddStatic(tile, new Vector3(2 * (i % Width), -.5f, 2 * (i / Width)));
        for (int i = 0; i < BodyCount; ++i)
            scene.AddDynamic(box, 1, new Vector3(i % 20 * 1.05f + .3f, .2f, i / 20 * 1.05f + .7f));
        using var world = new SceneWorld(scene, threads);
        var hash = 0ul;
        for (int i = 0; i < 60; ++i)
        {
            world.Step();
            if (i % 12 == 11)
            {
                Assert.InRange(world.Simulation.NarrowPhase.AgreedPairs.Bodies.Length, 1, BodyCount);
                world.Simulation.Bodies.ActiveSet.MotionStates[i * 7 % BodyCount].Velocity.Linear.X = 3;
            }
            hash = hash * 31 + world.Simulation.StateHash();
        }
        return hash;
    }

    [Theory, InlineData(false), InlineData(true)]
    public void A_body_that_is_pushed_slides_over_the_seam(bool remembers)
    {
        using var world = CreateGround(remembers, out _);
        world.Behaviour.Friction = 0;
        var body = world.AddBody(new Box(.5f, .5f, .5f), new RigidPose(new Vector3(-.25f, .25f, .25f)), default);
        for (int i = 0; i < 100; ++i)
            world.Step();
        world.Simulation.Bodies[body].Velocity.Linear = new Vector3(2, 0, -1);
        for (int i = 0; i < 60; ++i)
        {
            world.Step();
            var velocity = world.Simulation.Bodies[body].Velocity.Linear;
            Assert.InRange(velocity.X, 2 * (1 - 1e-3f), 2 * (1 + 1e-3f));
            Assert.InRange(velocity.Z, -1 - 1e-3f, -1 + 1e-3f);
            // Downwards: a load that goes over from one ground to another may be a substep late.
            Assert.InRange(velocity.Y, -1e-2f, 5e-3f);
            Assert.Equal(0, CountRemembered(world));
        }
    }

    /// <summary>In its first step each pair of a static waits for the others of its body. There are none: nothing of it is kept, asleep or awake.</summary>
    [Theory, InlineData(false), InlineData(true)]
    public void On_one_ground_no_memory_is_kept(bool sleeps)
    {
        Assert.Equal(LentBytes(joins: false), LentBytes(joins: true));

        ulong LentBytes(bool joins)
        {
            var scene = new SceneDescription { Name = "plain", Sleep = sleeps };
            int ground = scene.AddBox(100, 1, 100), box = scene.AddBox(.2f, .2f, .2f);
            scene.AddStatic(ground, new Vector3(0, -1, 0));
            for (int i = 0; i < 900; ++i)
                scene.AddDynamic(box, 1, new Vector3(i % 30, .2f, i / 30));
            using var world = new SceneWorld(scene, 1);
            world.Simulation.NarrowPhase.JoinsStatics = joins;
            for (int i = 0; i < 60; ++i)
                world.Step();
            Assert.Equal(sleeps, world.Simulation.Bodies.ActiveSet.Count == 0);
            return world.Simulation.BufferPool.GetTotalTakenByteCount();
        }
    }

    static int CountRemembered(ClusterWorld world)
    {
        var count = 0;
        foreach (ref var body in world.Simulation.NarrowPhase.AgreedPairs.Bodies)
            count += body.Remaining < body.Lifetime ? body.Count : 0;
        return count;
    }
}
