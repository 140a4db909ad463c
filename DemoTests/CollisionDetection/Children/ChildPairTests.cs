using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using DemoTests.Support;
using Xunit;

namespace DemoTests.CollisionDetection.Children;

/// <summary>A pair whose task expands it into k children is k pairs, bit for bit, where children are not joined to patches.</summary>
public class ChildPairTests
{
    const int StepCount = 200;

    /// <summary>What else happens.</summary>
    public enum Happening
    {
        Nothing,
        NotFound,
        Refused,
        Dropped,
        BodyRemoved,
        Bouncing,
    }

    // Plates of 20 m in nearly one place, each tilted by another angle: whatever is on one is within the bounds of all.
    static List<ClusterChild> CreatePlates(Simulation simulation, int count)
    {
        var box = simulation.Shapes.Add(new Box(20, 1, 20));
        var cylinder = simulation.Shapes.Add(new Cylinder(12, 1));
        var random = new Random(5);
        var plates = new List<ClusterChild>();
        for (int i = 0; i < count; ++i)
        {
            var axis = Vector3.Normalize(new Vector3(random.NextSingle() - .5f, 0, random.NextSingle() - .5f));
            var turn = Quaternion.CreateFromAxisAngle(axis, .1f + .04f * random.NextSingle());
            plates.Add(new(i % 3 == 1 ? cylinder : box, new RigidPose(new Vector3(0, -.5f - random.NextSingle() / 64, 0), turn)));
        }
        return plates;
    }

    static ClusterWorld Create(bool isCluster, int childCount, int threads, ClusterOrder order, Happening happening)
    {
        var world = new ClusterWorld(isCluster, threads);
        world.Rules.Order = order;
        world.Rules.Joins = world.JoinsStatics = false;
        world.AddStatics(CreatePlates(world.Simulation, childCount));
        var box = new Box(.5f, .4f, .6f);
        for (int i = 0; i < 3; ++i)
        {
            world.AddBody(box, new RigidPose(new Vector3(i * 2 - 3, .7f, -1), Turn(i)));
            world.AddBody(new Sphere(.25f), new RigidPose(new Vector3(i * 2 - 3, .7f, .4f)));
            world.AddBody(new Capsule(.2f, .4f), new RigidPose(new Vector3(i * 2 - 3, .7f, 1.4f), Turn(i + 3)));
            world.AddBody(new Cylinder(.2f, .4f), new RigidPose(new Vector3(i * 2 - 3.2f, .7f, 2.4f), Turn(i + 6)));
        }
        // On the third of the boxes.
        world.AddBody(new Cylinder(.2f, .3f), new RigidPose(new Vector3(1, 1.05f, -1)));
        Func<int, bool> comesAndGoes = child => (child * 7 + world.StepCount / 5) % 4 != 0;
        if (happening == Happening.NotFound && isCluster)
            world.Rules.Finds = comesAndGoes;
        else if (happening is Happening.NotFound or Happening.Refused)
            world.Behaviour.Allows = comesAndGoes;
        else if (happening == Happening.Dropped)
            world.Behaviour.Keeps = comesAndGoes;
        world.Behaviour.Restitution = happening == Happening.Bouncing ? .5f : 0;
        return world;
    }

    static Quaternion Turn(int seed) => Quaternion.CreateFromAxisAngle(Vector3.Normalize(new Vector3(1 + seed, 2, 3 - seed)), .1f + seed * .4f);

    static void Step(ClusterWorld world, Happening happening)
    {
        if (happening == Happening.BodyRemoved && world.StepCount is 60 or 100)
            world.Simulation.Bodies.Remove(new BodyHandle(world.Simulation.Bodies.ActiveSet.IndexToHandle[4].Value));
        world.Step();
    }

    [Theory]
    [InlineData(1, 1, ClusterOrder.Rising, Happening.Nothing)]
    [InlineData(2, 1, ClusterOrder.Falling, Happening.Nothing)]
    [InlineData(7, 1, ClusterOrder.Shuffled, Happening.Nothing)]
    [InlineData(7, 2, ClusterOrder.Rising, Happening.Nothing)]
    [InlineData(7, 3, ClusterOrder.Falling, Happening.Nothing)]
    [InlineData(40, 1, ClusterOrder.Rising, Happening.Nothing)]
    [InlineData(40, 3, ClusterOrder.Shuffled, Happening.Nothing)]
    [InlineData(1, 1, ClusterOrder.Rising, Happening.NotFound)]
    [InlineData(7, 1, ClusterOrder.Shuffled, Happening.NotFound)]
    [InlineData(40, 2, ClusterOrder.Falling, Happening.NotFound)]
    [InlineData(7, 3, ClusterOrder.Rising, Happening.Refused)]
    [InlineData(7, 2, ClusterOrder.Falling, Happening.Dropped)]
    [InlineData(2, 2, ClusterOrder.Rising, Happening.BodyRemoved)]
    [InlineData(7, 1, ClusterOrder.Shuffled, Happening.BodyRemoved)]
    [InlineData(1, 1, ClusterOrder.Rising, Happening.Bouncing)]
    [InlineData(2, 3, ClusterOrder.Falling, Happening.Bouncing)]
    [InlineData(7, 1, ClusterOrder.Shuffled, Happening.Bouncing)]
    public void A_static_of_children_is_as_many_statics(int childCount, int threads, ClusterOrder order, Happening happening)
    {
        using var expected = Create(isCluster: false, childCount, 1, ClusterOrder.Rising, happening);
        using var actual = Create(isCluster: true, childCount, threads, order, happening);
        var greatest = 0;
        var haveSeveral = childCount == 1;
        for (int i = 0; i < StepCount; ++i)
        {
            Step(expected, happening);
            Step(actual, happening);
            Assert.Equal(expected.Manifolds(), actual.Manifolds());
            Assert.Equal(expected.State(), actual.State());
            greatest = Math.Max(greatest, actual.ConstraintCount);
            haveSeveral |= actual.ConstraintCount > actual.StaticPairCount;
        }
        Assert.InRange(greatest, 10, int.MaxValue);
        Assert.True(haveSeveral, "pairs are to have several manifolds");
    }

    // A dumbbell of a box, a cylinder and a sphere; its children are those of A.
    static TypedIndex AddDumbbell(ClusterWorld world) => world.AddCluster([
        new(world.Simulation.Shapes.Add(new Box(.4f, .4f, .4f)), new RigidPose(new Vector3(-.5f, 0, 0))),
        new(world.Simulation.Shapes.Add(new Cylinder(.2f, .4f)), new RigidPose(new Vector3(.5f, 0, 0))),
        new(world.Simulation.Shapes.Add(new Sphere(.2f)), new RigidPose(new Vector3(0, 0, .3f)))]);

    static ClusterWorld CreateDumbbells(int threads, ClusterOrder order)
    {
        var world = new ClusterWorld(isCluster: true, threads);
        world.Rules.Order = order;
        world.Simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), world.Simulation.Shapes.Add(new Box(40, 1, 40))));
        var shape = AddDumbbell(world);
        var inertia = new Box(1.4f, .4f, .6f).ComputeInertia(1);
        for (int i = 0; i < 8; ++i)
        {
            world.Simulation.Bodies.Add(BodyDescription.CreateDynamic(
                new RigidPose(new Vector3(i % 4 * 2, .4f + i / 4 * .6f, 0), Turn(i / 4)), default, inertia, shape, -1f));
            world.AddBody(new Box(.3f, .3f, .3f), new RigidPose(new Vector3(i % 4 * 2 + .1f, 1.8f + i / 4 * .4f, .1f)));
        }
        return world;
    }

    [Fact]
    public void Bodies_of_children_come_to_rest_whatever_threads_and_order()
    {
        using var first = CreateDumbbells(1, ClusterOrder.Rising);
        using var second = CreateDumbbells(3, ClusterOrder.Shuffled);
        using var third = CreateDumbbells(2, ClusterOrder.Falling);
        for (int i = 0; i < 400; ++i)
        {
            first.Step();
            second.Step();
            third.Step();
            Assert.Equal(first.State(), second.State());
            Assert.Equal(first.State(), third.State());
        }
        ref var set = ref first.Simulation.Bodies.ActiveSet;
        for (int i = 0; i < set.Count; ++i)
        {
            Assert.InRange(set.MotionStates[i].Pose.Position.Y, .1f, 3);
            Assert.InRange(set.MotionStates[i].Velocity.Linear.Length(), 0, .1f);
        }
    }

    [Fact]
    public void A_body_may_change_between_convex_shapes_and_others()
    {
        using var world = CreateDumbbells(1, ClusterOrder.Rising);
        var body = new BodyHandle(world.Simulation.Bodies.ActiveSet.IndexToHandle[0].Value);
        TypedIndex[] shapes = [world.Simulation.Shapes.Add(new Box(1.4f, .4f, .6f)), AddDumbbell(world), world.Simulation.Shapes.Add(new Cylinder(.2f, .4f))];
        for (int i = 0; i < 12; ++i)
        {
            world.Simulation.Bodies.SetShape(body, shapes[i % 3]);
            for (int step = 0; step < 20; ++step)
                world.Step();
        }
        Assert.InRange(world.Simulation.Bodies[body].Pose.Position.Y, .15f, 2);
    }

    [Fact]
    public void Steps_make_no_garbage()
    {
        using var world = Create(isCluster: true, 7, 1, ClusterOrder.Rising, Happening.NotFound);
        for (int i = 0; i < 240; ++i)
            world.Step(validate: false);
        Assert.Equal(0, Garbage.Of(() =>
        {
            for (int i = 0; i < 60; ++i)
                world.Step(validate: false);
        }));
    }

    /// <summary>Callbacks see the deepest contacts of several children; what they change is what is simulated.</summary>
    [Fact]
    public void Changes_of_a_nonconvex_manifold_are_taken_over()
    {
        using var world = CreateCorner(out var body);
        NonconvexContactManifold seen = default;
        world.Behaviour.Configure = manifold =>
        {
            var changed = seen = (NonconvexContactManifold)manifold;
            unsafe
            {
                NonconvexContactManifold.FastRemoveAt(&changed, 1);
            }
            changed.Contact0.Depth = .125f;
            return changed;
        };
        world.Step();
        Assert.Equal(NonconvexContactManifold.MaximumContactCount, seen.Count);
        Assert.True(seen.Contact0.Depth >= seen.Contact1.Depth && seen.Contact1.Depth >= seen.Contact2.Depth);
        var total = 0;
        var depths = new List<float>();
        foreach (var handle in ContactsOf(world, body))
        {
            ref var location = ref world.Simulation.Solver.Locations[handle.Slot];
            var count = ConstraintTypeIds.ContactCount(location.TypeId);
            total += count;
            for (int i = 0; i < count; ++i)
                depths.Add(world.Simulation.Solver.Processor(location.TypeId).PrestepFloat(
                    ref world.Simulation.Solver.TypeBatchAt(location), location.IndexInTypeBatch, i * 4 + 3));
        }
        Assert.Contains(.125f, depths);
        using var unchanged = CreateCorner(out body);
        unchanged.Step();
        Assert.Equal(total + 1, ContactsOf(unchanged, body).Sum(
            handle => ConstraintTypeIds.ContactCount(unchanged.Simulation.Solver.Locations[handle.Slot].TypeId)));
    }

    // A box on two floors beside each other, at a wall.
    static ClusterWorld CreateCorner(out BodyHandle body)
    {
        var world = new ClusterWorld(isCluster: true);
        world.Rules.Joins = world.JoinsStatics = false;
        var box = world.Simulation.Shapes.Add(new Box(1, 1, 1));
        world.AddStatics([
            new(box, new RigidPose(new Vector3(0, -.5f, 0))), new(box, new RigidPose(new Vector3(1, -.5f, 0))),
            new(box, new RigidPose(new Vector3(.5f, .5f, 1)))]);
        body = world.AddBody(new Box(.5f, .5f, .5f), new RigidPose(new Vector3(.5f, .24f, .26f)));
        return world;
    }

    [Fact]
    public void More_contacts_than_were_shown_are_refused()
    {
        using var world = CreateCorner(out _);
        world.Behaviour.Configure = manifold => ((NonconvexContactManifold)manifold) with { Count = 9 };
        var refusal = Assert.Throws<InvalidOperationException>(() => world.Step());
        Assert.Contains("number of contacts", refusal.Message, StringComparison.Ordinal);
        world.Behaviour.Configure = null;
        world.Step();
        Assert.True(world.ConstraintCount > 1);
    }

    static List<ConstraintHandle> ContactsOf(ClusterWorld world, BodyHandle body)
    {
        var handles = new List<ConstraintHandle>();
        foreach (var constraint in world.Simulation.Bodies[body].Constraints)
            handles.Add(constraint.ConnectingConstraintHandle);
        return handles;
    }
}
