using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;
using DynamicCharacterMotionConstraint = BepuPhysics.Characters.DynamicCharacterMotion;
using RayHit = DemoTests.Compatibility.SomeGame.RayHit;
using StaticCharacterMotionConstraint = BepuPhysics.Characters.StaticCharacterMotion;

namespace DemoTests.Compatibility;

/// <summary>Lines as games write them, which are to compile and do what they do there.</summary>
public class GameCodeTests
{
    [Fact]
    public void Arguments_have_the_names_that_they_have_there()
    {
        using var world = new TestWorld();
        var (simulation, bodies, statics, solver) = (world.Simulation, world.Simulation.Bodies, world.Simulation.Statics, world.Simulation.Solver);
        var shape = simulation.Shapes.Add(new Sphere(1));
        var body = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        var other = world.AddDynamic(new Sphere(1), 1, new RigidPose(new Vector3(3, 0, 0)));
        var still = world.AddStatic(new Sphere(1), new RigidPose(new Vector3(9, 0, 0)));

        Assert.True(bodies.BodyExists(bodyHandle: body));
        bodies.SetShape(handle: body, newShape: shape);
        bodies[body].SetShape(newShape: shape);
        bodies.UpdateBounds(bodyHandle: body);
        statics.SetShape(handle: still, newShape: shape);
        statics[still].SetShape(newShape: shape);
        var joint = solver.Add(bodyHandleA: body, bodyHandleB: other, new BallSocket { SpringSettings = new(30, 1), LocalOffsetA = new(3, 0, 0) });
        solver.ApplyDescription(constraintHandle: joint, new BallSocket { SpringSettings = new(20, 1), LocalOffsetA = new(3, 0, 0) });
        var held = solver.Add(bodyHandle: body, new OneBodyLinearMotor { Settings = new(1, 1) });
        Assert.True(solver.ConstraintExists(constraintHandle: held));
        Assert.Equal(0, solver.GetAccumulatedImpulseMagnitude(constraintHandle: joint));
        simulation.Awakener.AwakenBody(bodyHandle: body);
        simulation.EnsureCapacity(allocationTarget: new SimulationAllocationSizes { Bodies = 10 });
        using var property = new CollidableProperty<int>(simulation);
        property.Allocate(bodyHandle: body) = 1;
        property.Allocate(collidableReference: bodies[body].CollidableReference) = 2;
        var manifold = new ConvexContactManifold { Count = 1, Normal = Vector3.UnitY };
        manifold.Contact0.Depth = 3;
        Assert.Equal(3, manifold.GetDepth(contactIndex: 0));
        manifold.GetContact(contactIndex: 0, out _, out var normal, out var depth, out _);
        Assert.Equal((Vector3.UnitY, 3), (normal, depth));
        Assert.Equal(3, ConvexContactManifold.GetDepthReference(ref manifold, contactIndex: 0));
        simulation.Shapes[Sphere.Id]!.Remove(index: simulation.Shapes.Add(new Sphere(2)).Index);
    }

    [Fact]
    public void Buffers_have_ranges()
    {
        using var pool = new BufferPool();
        pool.Take(16, out Buffer<int> buffer);
        for (int i = 0; i < buffer.Length; ++i)
            buffer[i] = i;
        var part = buffer[2..5];
        Assert.Equal((3, 2, 4, buffer.Id), (part.Length, part[0], part[^1], part.Id));
        Assert.Equal(7, buffer[..7].Length);
        buffer[^1] = -1;
        Assert.Equal(-1, buffer[buffer.Length - 1]);
        pool.Return(ref buffer);
    }

    [Fact]
    public void Triangles_of_a_mesh_are_as_they_were_given()
    {
        using var pool = new BufferPool();
        pool.Take(3, out Buffer<Triangle> triangles);
        triangles[0] = new(new(0, 0, 0), new(1, 0, 0), new(0, 0, 1));
        triangles[1] = new(new(1, 0, 0), new(1, 0, 1), new(0, 0, 1));
        // Without a surface: it collides with nothing, and keeps its number.
        triangles[2] = new(new(1, 2, 3), new(1, 2, 3), new(1, 2, 3));
        var given = triangles.AsSpan().ToArray();
        var mesh = new Mesh(triangles, new Vector3(2, 3, -4), pool);
        Assert.Equal(3, mesh.Triangles.Length);
        for (int i = 0; i < mesh.Triangles.Length; ++i)
        {
            var triangle = mesh.Triangles[i];
            Assert.Equal((given[i].A, given[i].B, given[i].C), (triangle.A, triangle.B, triangle.C));
        }
        Assert.Throws<ArgumentOutOfRangeException>(() => mesh.Triangles[3]);
        Assert.Equal(0, default(Mesh).Triangles.Length);
        mesh.Dispose(pool);
        pool.AssertEmpty();
    }

    [Fact]
    public void Children_of_compounds_are_placed_by_its_static_methods()
    {
        var child = new RigidPose(new Vector3(1, 2, 3), QuaternionEx.CreateFromAxisAngle(Vector3.UnitX, .5f));
        var parent = new RigidPose(new Vector3(-4, 0, 7), QuaternionEx.CreateFromAxisAngle(Vector3.UnitY, MathF.PI / 2));
        Compound.GetRotatedChildPose(child, parent.Orientation, out var rotated);
        Compound.GetRotatedChildPose(child.Position, child.Orientation, parent.Orientation, out var again);
        Compound.GetWorldPose(child, parent, out var inWorld);
        Assert.Equal((rotated.Position, rotated.Orientation), (again.Position, again.Orientation));
        Assert.True((rotated.Position - new Vector3(3, 2, -1)).Length() < 1e-6f, $"{rotated.Position}");
        Assert.True((inWorld.Position - new Vector3(-1, 2, 6)).Length() < 1e-6f, $"{inWorld.Position}");
        // The child's own axis is turned first by the child, then by its compound.
        var axis = Vector3.Transform(Vector3.Transform(Vector3.UnitY, child.Orientation), parent.Orientation);
        Assert.True((Vector3.Transform(Vector3.UnitY, inWorld.Orientation) - axis).Length() < 1e-6f);
        Assert.Equal(rotated.Orientation, inWorld.Orientation);
    }

    [Fact]
    public void A_static_describes_itself()
    {
        using var world = new TestWorld();
        var still = world.AddStatic(new Sphere(1), new RigidPose(new Vector3(1, 2, 3)));
        var description = world.Statics[still].GetDescription();
        description.Pose.Position.X = 8;
        world.Statics[still].ApplyDescription(description);
        Assert.Equal(new Vector3(8, 2, 3), world.Statics[still].Pose.Position);
        world.Statics.Remove(still);
        Assert.Throws<ArgumentException>(() => world.Statics[still].GetDescription());
    }

    [Fact]
    public void A_tree_is_refitted_and_refined()
    {
        using var pool = new BufferPool();
        var tree = new Tree(pool);
        for (int i = 0; i < 50; ++i)
            tree.Add(new BoundingBox(new Vector3(i), new Vector3(i + 1)), pool);
        tree.UpdateBounds(7, new Vector3(100), new Vector3(101));
        tree.Refit();
        tree.Refine(pool);
        Assert.Equal(new Vector3(100), tree.GetBounds(7).Min);
        tree.Dispose(pool);
    }

    // As in version 2.4.
    [Fact]
    public void Overlaps_are_found_without_a_pool()
    {
        using var world = new TestWorld();
        var body = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        world.AddStatic(new Sphere(1), new RigidPose(new Vector3(2, 0, 0)));
        world.AddStatic(new Sphere(1), new RigidPose(new Vector3(9, 0, 0)));
        var (some, all) = (new Found([]), new Found([]));
        world.Simulation.BroadPhase.GetOverlaps(new Vector3(-1), new Vector3(2), ref some);
        world.Simulation.BroadPhase.GetOverlaps(new BoundingBox(new Vector3(-20), new Vector3(20)), ref all);
        Assert.Equal((2, 3), (some.References.Count, all.References.Count));
        Assert.Equal(body, some.References[0].BodyHandle);
    }

    readonly struct Found(List<CollidableReference> references) : IBreakableForEach<CollidableReference>
    {
        internal List<CollidableReference> References { get; } = references;

        public bool LoopBody(CollidableReference i)
        {
            References.Add(i);
            return true;
        }
    }

    [Fact]
    public void A_name_that_a_game_has_too_is_chosen_by_an_alias()
    {
        using var world = new TestWorld();
        var hit = new RayHit { Distance = 3 };
        Assert.Equal(3, hit.Distance);
        Assert.False(world.Simulation.RayCast(Vector3.Zero, Vector3.UnitX, 1, world.Pool, out BepuPhysics.RayHit _));
    }

    // A game's own character controllers add the constraint themselves, by the name that it had in the file that came with them.
    [Fact]
    public void The_constraints_of_a_games_own_character_controllers_are_in_the_library()
    {
        using var world = new TestWorld(new AccuracySettings { Gravity = Vector3.Zero });
        world.Simulation.Solver.Register<StaticCharacterMotionConstraint>();
        world.Simulation.Solver.Register<DynamicCharacterMotionConstraint>();
        var body = world.AddDynamic(new Capsule(.5f, 1), 1, RigidPose.Identity);
        var motion = world.Simulation.Solver.Add(body, new StaticCharacterMotionConstraint
        {
            MaximumHorizontalForce = 20,
            MaximumVerticalForce = 100,
            SurfaceBasis = Quaternion.Identity,
            TargetVelocity = new Vector2(2, 0),
        });
        Assert.Equal(StaticCharacterMotionConstraint.ConstraintTypeId, world.Simulation.Solver.HandleToConstraint[motion.Value].TypeId);
        for (int i = 0; i < 60; ++i)
            world.Step();
        Assert.Equal(2, world.Simulation.Bodies[body].Velocity.Linear.Length(), 1e-3f);
    }
}
