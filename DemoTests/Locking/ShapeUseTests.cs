using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Locking;

/// <summary>A shape that a body or static uses stays for it.</summary>
public sealed class ShapeUseTests : IDisposable
{
    readonly BufferPool pool = new();

    public void Dispose() => pool.Dispose();

    /// <summary>Ways to get rid of a hull that want it to be unused.</summary>
    public static TheoryData<string> Removals =>
        ["Remove", "batch Remove", "RecursivelyRemoveAndDispose", "batch Recursively", "Clear", "batch Clear", "Dispose"];

    /// <summary>
    /// Ways to get rid of a shape that leave it to those who have it; where its memory is not disposed with it, of one that has none.
    /// </summary>
    public static TheoryData<string> EarlyRemovals => ["Remove", "RemoveAndDispose", "batch Remove", "batch RemoveAndDispose"];

    [Theory]
    [MemberData(nameof(EarlyRemovals))]
    public void A_shape_may_be_removed_before_those_who_have_it(string removal)
    {
        var shapes = new Shapes(pool, 4);
        using (var simulation = NewSimulation(shapes))
        using (var other = NewSimulation(shapes))
        {
            var shape = AddOne();
            var sphere = shapes.Add(new Sphere(1));
            var first = AddBody(simulation, shape);
            var second = AddBody(simulation, shape);
            var still = other.Statics.Add(new StaticDescription(RigidPose.Identity, shape));

            Remove(shapes, shape, removal);
            // It is gone for all but those who have it.
            Assert.False(shapes.Exists(shape));
            Assert.Equal(0, shapes[shape.Type]!.Count);
            Assert.Throws<ArgumentException>(() => AddBody(simulation, shape));
            Assert.Throws<ArgumentException>(() => other.Statics.Add(new StaticDescription(RigidPose.Identity, shape)));
            Assert.ThrowsAny<ArgumentException>(() => Remove(shapes, shape, removal));
            Assert.Equal(shape, simulation.Bodies[first].Collidable.Shape);
            Assert.True(simulation.RayCast(new Vector3(.2f, 9, .2f), -Vector3.UnitY, 20, pool, out var hit) && hit.Collidable.BodyHandle == first);
            Steps();

            // Another shape of its type does not take its place while anyone has it.
            var next = AddOne();
            Assert.NotEqual(shape, next);
            simulation.Bodies.Remove(first);
            simulation.Bodies.SetShape(second, sphere);
            Assert.NotEqual(shape, AddOne());
            Steps();
            other.Statics.Remove(still);
            Assert.Equal(shape, AddOne());
            Steps();
            for (int i = 0; i < 3; ++i)
                shapes.RemoveAndDispose(new TypedIndex(shape.Type, i), pool);

            TypedIndex AddOne() => removal.Contains("ispose", StringComparison.Ordinal) ? AddHull(shapes) : shapes.Add(new Box(1, 1, 1));

            void Steps()
            {
                simulation.Timestep(1 / 60f);
                other.Timestep(1 / 60f);
                simulation.Validate();
                other.Validate();
            }
        }
        shapes.Dispose();
        pool.AssertEmpty();
    }

    [Fact]
    public void A_removed_shape_that_is_still_in_use_goes_with_its_simulation()
    {
        using (var simulation = NewSimulation(null))
        {
            var shape = AddHull(simulation.Shapes);
            AddBody(simulation, shape);
            simulation.Shapes.RemoveAndDispose(shape, pool);
            simulation.Clear();
            Assert.Equal(shape, AddHull(simulation.Shapes));
            AddBody(simulation, shape);
            simulation.Shapes.RemoveAndDispose(shape, pool);
            // Its children are in a batch of their own, whose memory is returned first.
            pool.Take(1, out Buffer<CompoundChild> children);
            children[0] = new(RigidPose.Identity, simulation.Shapes.Add(new Sphere(1)));
            var compound = simulation.Shapes.Add(new Compound(children));
            AddBody(simulation, compound);
            simulation.Shapes.RemoveAndDispose(compound, pool);
            simulation.Timestep(1 / 60f);
            simulation.Validate();
        }
        pool.AssertEmpty();
    }

    [Fact]
    public void Bodies_of_a_snapshot_get_a_removed_shape_back_while_others_have_it()
    {
        using var simulation = NewSimulation(null);
        var shape = simulation.Shapes.Add(new Sphere(1));
        var body = AddBody(simulation, shape);
        AddBody(simulation, shape);
        using var snapshot = new SimulationSnapshot(pool);
        simulation.Save(snapshot);
        simulation.Shapes.Remove(shape);
        simulation.Bodies.Remove(body);
        simulation.Restore(snapshot);
        simulation.Timestep(1 / 60f);
        simulation.Validate();
        simulation.Clear();
        simulation.Shapes.Add(new Sphere(2));
        Assert.Throws<InvalidOperationException>(() => simulation.Restore(snapshot));
    }

    [Theory]
    [MemberData(nameof(Removals))]
    public void A_shape_in_use_is_not_removed_and_one_that_is_not_is(string removal)
    {
        var shapes = new Shapes(pool, 4);
        using (var simulation = NewSimulation(shapes))
        using (var other = NewSimulation(shapes))
        {
            Span<Vector3> corners = [new(0, 0, 0), new(1, 0, 0), new(0, 1, 0), new(0, 0, 1)];
            var shape = shapes.Add(new ConvexHull(corners, pool, out _));
            var sphere = shapes.Add(new Sphere(1));
            var first = AddBody(simulation, shape);
            var second = AddBody(simulation, shape);
            var third = AddBody(other, shape);
            var still = other.Statics.Add(new StaticDescription(RigidPose.Identity, shape));

            Refuses("two bodies, another simulation's body and static");
            simulation.Bodies.Remove(first);
            Refuses("a body, another simulation's body and static");
            simulation.Bodies.SetShape(second, sphere);
            Refuses("another simulation's body and static");
            simulation.Bodies.SetShape(second, shape);
            Refuses("after it was given back");
            simulation.Bodies.ApplyDescription(second, simulation.Bodies.GetDescription(second) with { Collidable = new(sphere) });
            other.Bodies.SetShape(third, default);
            Refuses("another simulation's static");
            other.Statics.SetShape(still, sphere);
            other.Statics.ApplyDescription(still, new StaticDescription(RigidPose.Identity, shape));
            Refuses("again");
            other.Statics.Remove(still);
            AddBody(other, shape);
            other.Clear();
            if (removal is "Clear" or "Dispose")
                simulation.Clear();
            Remove(shapes, shape, removal);
            Assert.False(shapes.Exists(shape));
            simulation.Timestep(1 / 60f);
            other.Timestep(1 / 60f);
            simulation.Validate();

            void Refuses(string users)
            {
                var exception = Record.Exception(() => Remove(shapes, shape, removal));
                Assert.True(exception is InvalidOperationException, $"{removal} with {users}: {exception}");
                Assert.True(shapes.Exists(shape));
                simulation.Timestep(1 / 60f);
                other.Timestep(1 / 60f);
                simulation.Validate();
                other.Validate();
            }
        }
        shapes.Dispose();
        if (removal.Contains("ispose", StringComparison.Ordinal) && removal != "Dispose" || removal.Contains("Recursively", StringComparison.Ordinal))
            pool.AssertEmpty();
    }

    [Fact]
    public void Shapes_that_are_shared_outlive_those_who_use_them()
    {
        var shapes = new Shapes(pool, 4);
        var sphere = shapes.Add(new Sphere(1));
        for (int i = 0; i < 3; ++i)
        {
            using var simulation = NewSimulation(shapes);
            AddBody(simulation, sphere);
            simulation.Statics.Add(new StaticDescription(RigidPose.Identity, sphere));
            Assert.Throws<InvalidOperationException>(shapes.Dispose);
        }
        shapes.Remove(sphere);
        shapes.Dispose();
        pool.AssertEmpty();
    }

    [Fact]
    public void A_simulation_does_not_take_its_shapes_away_from_another()
    {
        var owner = NewSimulation(null);
        var guest = NewSimulation(owner.Shapes);
        AddBody(guest, owner.Shapes.Add(new Sphere(1)));
        Assert.Throws<InvalidOperationException>(owner.Dispose);
        Assert.Throws<InvalidOperationException>(owner.Clear);
        owner.Timestep(1 / 60f);
        guest.Timestep(1 / 60f);
        guest.Dispose();
        owner.Dispose();
        Assert.Throws<ObjectDisposedException>(() => owner.Shapes.Add(new Sphere(1)));
        Assert.Throws<ObjectDisposedException>(() => BodyDescription.CreateConvexDynamic(RigidPose.Identity, 1, owner.Shapes, new Sphere(1)));
        pool.AssertEmpty();
    }

    [Fact]
    public void A_simulation_may_begin_to_share_shapes_while_another_steps()
    {
        var shapes = new Shapes(pool, 4);
        var others = new BufferPool();
        Exception? attached = null;
        Exception? changed = null;
        using (var world = new LockedWorld(1, 8, null, shapes))
        {
            world.Arm("AllowContactGeneration", () =>
            {
                attached = Record.Exception(() => Simulation.Create(
                    others, new ThrowingContacts(), new DefaultPoseIntegratorCallbacks(Vector3.Zero), new SolveDescription(1, 2), shapes: shapes).Dispose());
                changed = Record.Exception(() => shapes.Add(new Sphere(2)));
            });
            world.Step();
            Assert.True(world.WasReached);
        }
        Assert.Null(attached);
        Assert.IsType<InvalidOperationException>(changed);
        shapes.Dispose();
        others.AssertEmpty();
        pool.AssertEmpty();
    }

    [Fact]
    public void A_shape_that_is_refused_for_a_body_is_not_counted()
    {
        using var simulation = NewSimulation(null);
        var sphere = simulation.Shapes.Add(new Sphere(1));
        var bad = BodyDescription.CreateKinematic(new Vector3(float.NaN, 0, 0), sphere, -1);
        Assert.Throws<ArgumentException>(() => simulation.Bodies.Add(bad));
        Assert.Throws<ArgumentException>(() => simulation.Statics.Add(new StaticDescription(new Vector3(float.NaN, 0, 0), Quaternion.Identity, sphere)));
        simulation.Shapes.Remove(sphere);
    }

    [Fact]
    public void Shapes_are_not_assigned()
    {
        foreach (var type in new[] { typeof(Collidable), typeof(Static) })
        {
            Assert.DoesNotContain(type.GetFields(), field => field.FieldType == typeof(TypedIndex));
            Assert.False(type.GetProperty("Shape")!.SetMethod!.IsPublic);
        }
    }

    [Fact]
    public void A_batch_of_a_collection_is_not_disposed_alone()
    {
        using var simulation = NewSimulation(null);
        var sphere = simulation.Shapes.Add(new Sphere(1));
        Assert.Throws<InvalidOperationException>(() => simulation.Shapes[sphere.Type]!.Dispose());
        AddBody(simulation, sphere);
        simulation.Timestep(1 / 60f);
    }

    static void Remove(Shapes shapes, TypedIndex shape, string removal)
    {
        // A pool of its own would not know the hull.
        var pool = shapes.Pool;
        switch (removal)
        {
            case "Remove": shapes.Remove(shape); break;
            case "RemoveAndDispose": shapes.RemoveAndDispose(shape, pool); break;
            case "RecursivelyRemoveAndDispose": shapes.RecursivelyRemoveAndDispose(shape, pool); break;
            case "batch Remove": shapes[shape.Type]!.Remove(shape.Index); break;
            case "batch RemoveAndDispose": shapes[shape.Type]!.RemoveAndDispose(shape.Index, pool); break;
            case "batch Recursively": shapes[shape.Type]!.RecursivelyRemoveAndDispose(shape.Index, shapes, pool); break;
            case "Clear": shapes.Clear(); break;
            case "batch Clear": shapes[shape.Type]!.Clear(); break;
            case "Dispose": shapes.Dispose(); break;
            default: throw new ArgumentOutOfRangeException(nameof(removal), removal, null);
        }
    }

    TypedIndex AddHull(Shapes shapes)
    {
        Span<Vector3> corners = [new(0, 0, 0), new(1, 0, 0), new(0, 1, 0), new(0, 0, 1)];
        return shapes.Add(new ConvexHull(corners, pool, out _));
    }

    static BodyHandle AddBody(Simulation simulation, TypedIndex shape) =>
        simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(0, 5, 0), new Sphere(1).ComputeInertia(1), shape, -1));

    Simulation NewSimulation(Shapes? shapes) =>
        Simulation.Create(pool, new ThrowingContacts(), new DefaultPoseIntegratorCallbacks(Vector3.Zero), new SolveDescription(1, 2), shapes: shapes);
}
