using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Queries;

/// <summary>Contacts of a shape that is not in the world, where the answer is known in closed form, and beside distances.</summary>
public sealed class ShapeContactTests : IDisposable
{
    readonly TestWorld world = new(new AccuracySettings { Contacts = ContactScope.None });

    public void Dispose()
    {
        world.Dispose();
        world.Pool.AssertEmpty();
    }

    readonly record struct Told(CollidableReference Collidable, Vector3 Place, Vector3 Normal, float Depth);

    List<Told> Find<TShape>(in TShape shape, in RigidPose pose, float margin, CollisionLayers? layers = null, Func<int, bool>? allowed = null)
        where TShape : unmanaged, IConvexShape
    {
        var handler = new Listener { Found = [], Allowed = allowed, Position = pose.Position };
        world.Simulation.FindContacts(shape, pose, margin, world.Pool, ref handler, layers);
        return handler.Found;
    }

    struct Listener : IShapeContactHandler
    {
        public List<Told> Found;
        public Func<int, bool>? Allowed;
        public Vector3 Position;

        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => Allowed is null || Allowed(childIndex);

        public readonly void OnContacts<TManifold>(CollidableReference collidable, ref TManifold manifold)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            for (int i = 0; i < manifold.Count; ++i)
                Found.Add(new(collidable, Position + manifold.GetOffset(i), manifold.GetNormal(i), manifold.GetDepth(i)));
        }
    }

    [Theory]
    [InlineData(.8f, .2f)]
    [InlineData(1.05f, -.05f)]
    public void A_sphere_over_a_box_has_the_contact_that_its_height_says(float height, float depth)
    {
        world.AddStatic(new Box(4, 2, 4), new Vector3(3, 1, -2));

        var contact = Assert.Single(Find(new Sphere(1), new RigidPose(new(3.5f, 2 + height, -2)), .1f));

        Assert.Equal(depth, contact.Depth, 1e-6f);
        Assert.Equal(Vector3.UnitY, contact.Normal);
    }

    [Fact]
    public void Beyond_the_margin_there_is_no_contact()
    {
        world.AddStatic(new Box(4, 2, 4), Vector3.Zero);

        Assert.Empty(Find(new Sphere(1), new RigidPose(new(0, 2.2f, 0)), .1f));
        Assert.Single(Find(new Sphere(1), new RigidPose(new(0, 2.2f, 0)), .3f));
        Assert.Empty(Find(new Sphere(1), new RigidPose(new(0, 2.01f, 0)), 0));
    }

    [Fact]
    public void A_box_in_a_corner_hears_of_both_walls_and_gets_out_by_their_depths()
    {
        var floor = world.AddStatic(new Box(10, 1, 10), new Vector3(0, -.5f, 0));
        var wall = world.AddStatic(new Box(1, 10, 10), new Vector3(-.5f, 5, 0));
        var pose = new RigidPose(new(.9f, .95f, 0));
        var box = new Box(2, 2, 2);

        var contacts = Find(box, pose, 0);

        Assert.All(contacts.Where(found => found.Collidable.StaticHandle == floor), found => Assert.Equal(.05f, found.Depth, 1e-6f));
        Assert.All(contacts.Where(found => found.Collidable.StaticHandle == wall), found => Assert.Equal(.1f, found.Depth, 1e-6f));
        Assert.Equal(4, contacts.Count(found => found.Normal == Vector3.UnitY));
        Assert.Equal(4, contacts.Count(found => found.Normal == Vector3.UnitX));
        foreach (var way in contacts.Select(found => found.Normal * found.Depth).Distinct())
            pose.Position += way;
        Assert.All(Find(box, pose, .01f), found => Assert.InRange(found.Depth, -1e-5f, 1e-5f));
    }

    [Fact]
    public void Layers_and_children_that_are_not_allowed_have_no_contacts()
    {
        using var levels = new SweepMaze(5);
        var random = new Random(11);
        int whole = 0, without = 0;
        for (int i = 0; i < 200; ++i)
        {
            var pose = SweepMaze.NextCase(random).Pose;
            var all = new Listener { Found = [] };
            levels.Simulation.FindContacts(new Sphere(.7f), pose, .1f, levels.World.Pool, ref all);
            var none = new Listener { Found = [], Allowed = _ => false };
            levels.Simulation.FindContacts(new Sphere(.7f), pose, .1f, levels.World.Pool, ref none);
            whole += all.Found.Count;
            without += none.Found.Count;
            Assert.All(none.Found, found => Assert.Null(levels.Children(found.Collidable)));
            Assert.Equal(all.Found.Where(found => levels.Children(found.Collidable) is null), none.Found);
            var unlayered = new Listener { Found = [] };
            levels.Simulation.FindContacts(new Sphere(.7f), pose, .1f, levels.World.Pool, ref unlayered, new CollisionLayers(0, 0));
            Assert.Empty(unlayered.Found);
        }
        Assert.True(whole > 2 * without && without > 20, $"{whole} {without}");
    }

    [Fact]
    public void Contacts_of_convex_shapes_are_as_deep_as_distances_say()
    {
        using var levels = new SweepMaze(5);
        var random = new Random(12);
        int apart = 0, overlapping = 0;
        for (int i = 0; i < 600; ++i)
        {
            var pose = SweepMaze.NextCase(random).Pose;
            var handler = new Listener { Found = [] };
            levels.Simulation.FindContacts(new Box(.5f, .9f, .3f), pose, .5f, levels.World.Pool, ref handler);
            var near = new ByCollidable { Found = [] };
            levels.Simulation.FindNear(new Box(.5f, .9f, .3f), pose, .49f, levels.World.Pool, ref near);
            foreach (var (collidable, proximity) in near.Found)
            {
                if (levels.Children(collidable) is not null)
                    continue;
                // What is across a triangle has contacts only if the shortest way out is one to its front.
                levels.Simulation.GetPoseAndShape(collidable, out _, out var other);
                if (other.Type == Triangle.Id && proximity.Overlaps)
                    continue;
                var deepest = handler.Found.Where(found => found.Collidable == collidable).Max(found => found.Depth);
                if (proximity.Overlaps)
                    Assert.True(deepest >= -1e-5f);
                else
                    Assert.Equal(-proximity.Distance, deepest, 1e-4f);
                overlapping += proximity.Overlaps ? 1 : 0;
                apart += proximity.Overlaps ? 0 : 1;
            }
        }
        Assert.True(apart > 30 && overlapping > 15, $"{apart} {overlapping}");
    }

    struct Alone : ICollisionCallbacks
    {
        public Listener Listener;
        public CollidableReference Collidable;

        public readonly bool AllowCollisionTesting(int pairId, int childA, int childB) => true;

        public readonly void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) { }

        public readonly void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> =>
            Listener.OnContacts(Collidable, ref manifold);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(.1f)]
    public void Contacts_are_bit_for_bit_those_of_each_pair_alone(float margin)
    {
        using var own = new BufferPool();
        using var levels = new SweepMaze(5);
        var simulation = levels.Simulation;
        var pool = levels.World.Pool;
        var random = new Random(13);
        var points = new Vector3[14];
        foreach (ref var point in points.AsSpan())
            point = new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle()) - new Vector3(.5f);
        var hull = new ConvexHull(points, own, out _);
        TypedIndex[] shapes = [simulation.Shapes.Add(new Box(.5f, .9f, .3f)), simulation.Shapes.Add(hull), simulation.Shapes.Add(new Cylinder(.4f, .3f))];
        int told = 0;
        for (int i = 0; i < 100; ++i)
        {
            var pose = SweepMaze.NextCase(random).Pose;
            for (int kind = 0; kind < shapes.Length; ++kind)
            {
                var together = new Listener { Found = [], Position = pose.Position };
                if (kind == 0)
                    simulation.FindContacts(new Box(.5f, .9f, .3f), pose, margin, pool, ref together);
                else if (kind == 1)
                    simulation.FindContacts(hull, pose, margin, pool, ref together);
                else
                    simulation.FindContacts(new Cylinder(.4f, .3f), pose, margin, pool, ref together);
                var alone = new List<Told>();
                foreach (var collidable in levels.Collidables)
                {
                    simulation.GetPoseAndShape(collidable, out var other, out var otherShape);
                    var batcher = new CollisionBatcher<Alone>(pool, simulation.Shapes, simulation.NarrowPhase.CollisionTaskRegistry, 0,
                        new() { Collidable = collidable, Listener = new() { Found = alone, Position = pose.Position } });
                    batcher.Add(shapes[kind], otherShape, other.Position - pose.Position, pose.Orientation, other.Orientation, margin, new(0));
                    batcher.Flush();
                }
                Assert.Equal(alone.OrderBy(found => found.Collidable.Packed), together.Found.OrderBy(found => found.Collidable.Packed));
                told += alone.Count;
            }
        }
        Assert.True(told > 100, $"{told}");
    }

    struct ByCollidable : IProximityHandler
    {
        public Dictionary<CollidableReference, Proximity> Found;

        public readonly bool AllowTest(CollidableReference collidable) => true;

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public readonly void OnProximity(ref float maximumDistance, in Proximity proximity) => Found.Add(proximity.Collidable, proximity);
    }

    struct Thrower(bool atContacts) : IShapeContactHandler
    {
        public readonly bool AllowTest(CollidableReference collidable) => atContacts ? true : throw new TimeoutException();

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public readonly void OnContacts<TManifold>(CollidableReference collidable, ref TManifold manifold)
            where TManifold : unmanaged, IContactManifold<TManifold> => throw new TimeoutException();
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void What_a_handler_throws_leaves_no_memory_behind(bool atContacts)
    {
        for (int i = 0; i < 40; ++i)
            world.AddStatic(new Box(4, 2, 4), new Vector3(0, 0, .01f * i));
        var before = world.Pool.GetTotalAllocatedByteCount();
        using var own = new BufferPool();
        Assert.Throws<TimeoutException>(() =>
        {
            var handler = new Thrower(atContacts);
            world.Simulation.FindContacts(new Sphere(1), RigidPose.Identity, .1f, own, ref handler);
        });
        own.AssertEmpty();
        Assert.NotEmpty(Find(new Sphere(1), RigidPose.Identity, .1f));
        Assert.Equal(before, world.Pool.GetTotalAllocatedByteCount());
    }

    [Fact]
    public void Bad_input_is_refused()
    {
        var handler = new Listener { Found = [] };
        var simulation = world.Simulation;
        Assert.Throws<ArgumentException>(() => simulation.FindContacts(new HalfSpace(Vector3.UnitY), RigidPose.Identity, 0, world.Pool, ref handler));
        Assert.ThrowsAny<ArgumentException>(() => simulation.FindContacts(new Sphere(-1), RigidPose.Identity, 0, world.Pool, ref handler));
        Assert.ThrowsAny<ArgumentException>(() => simulation.FindContacts(new Sphere(1), RigidPose.Identity, -1, world.Pool, ref handler));
        Assert.ThrowsAny<ArgumentException>(() => simulation.FindContacts(new Sphere(1), RigidPose.Identity, float.NaN, world.Pool, ref handler));
        Assert.ThrowsAny<ArgumentException>(
            () => simulation.FindContacts(new Sphere(1), RigidPose.Identity, float.PositiveInfinity, world.Pool, ref handler));
        Assert.ThrowsAny<ArgumentException>(
            () => simulation.FindContacts(new Sphere(1), new RigidPose(new(float.NaN)), 0, world.Pool, ref handler));
        Assert.Throws<ArgumentNullException>(() => simulation.FindContacts(new Sphere(1), RigidPose.Identity, 0, null!, ref handler));
    }
}
