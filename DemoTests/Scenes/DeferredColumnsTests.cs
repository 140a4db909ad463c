using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Constraints that come and go while what they hold is deferred end up as if each had come and gone at once.</summary>
public class DeferredColumnsTests
{
    const int BodyCount = 120;

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void The_order_of_moves_is_kept(int seed)
    {
        using var now = new World(seed);
        using var later = new World(seed);
        for (int round = 0; round < 30; ++round)
        {
            now.Change(round, isDeferred: false);
            later.Change(round, isDeferred: true);
            Assert.Equal(now.Describe(), later.Describe());
            later.Simulation.Validate();
        }
    }

    /// <summary>Two types of constraints, each with a number that no other has in all that it holds.</summary>
    sealed class World : IDisposable
    {
        // Type batches grow from nothing, also in the midst of it.
        readonly TestWorld world = new(new() { Contacts = Demos.Accuracy.ContactScope.None }, sizes: new(64, 64, 64, 64, 64, 1, 4));
        readonly List<BodyHandle> bodies = [];
        readonly List<(ConstraintHandle Handle, float Number)> constraints = [];
        readonly int seed;

        public World(int seed)
        {
            this.seed = seed;
            for (int i = 0; i < BodyCount; ++i)
                bodies.Add(world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(2 * i, 0, 0))));
            // So that both types are known.
            var ball = world.Solver.Add(bodies[0], bodies[1], new BallSocket { SpringSettings = new(30, 1) });
            var distance = world.Solver.Add(bodies[0], bodies[1], new CenterDistanceConstraint { TargetDistance = 1, SpringSettings = new(30, 1) });
            world.Solver.Remove(ball);
            world.Solver.Remove(distance);
        }

        public Simulation Simulation => world.Simulation;

        // Now and then all go, with their type batches, and others come.
        public void Change(int round, bool isDeferred)
        {
            var random = new Random(seed * 1000 + round);
            var solver = world.Solver;
            var added = new List<(ConstraintHandle Handle, float Number)>();
            if (isDeferred)
                solver.BeginDeferral();
            int removals = round % 7 == 6 ? constraints.Count : random.Next(constraints.Count + 1);
            for (int i = 0; i < removals; ++i)
                Remove(random.Next(constraints.Count), added);
            for (int i = random.Next(180); i > 0; --i)
            {
                Add(random, added, round * 200 + i, isDeferred);
                // Also one that nobody has written yet.
                if (constraints.Count > 0 && random.Next(3) == 0)
                    Remove(random.Next(constraints.Count), added);
            }
            if (!isDeferred)
                return;
            solver.PrepareDeferred();
            // From the last: they are independent of each other.
            for (int i = solver.DeferredBatchCount - 1; i >= 0; --i)
                solver.DoDeferred(i);
            solver.EndDeferral();
            foreach ((ConstraintHandle handle, float number) in added)
                Write(handle, number);
        }

        void Add(Random random, List<(ConstraintHandle, float)> added, float number, bool isDeferred)
        {
            int a = random.Next(BodyCount), b = (a + 1 + random.Next(BodyCount - 1)) % BodyCount;
            int type = random.Next(2) == 0 ? BallSocket.ConstraintTypeId : CenterDistanceConstraint.ConstraintTypeId;
            var handle = world.Solver.AddUnwritten([bodies[a], bodies[b]], type);
            constraints.Add((handle, number));
            added.Add((handle, number));
            if (!isDeferred)
                Write(handle, number);
        }

        void Remove(int index, List<(ConstraintHandle, float)> added)
        {
            world.Solver.RemoveWithoutNotice(constraints[index].Handle);
            added.Remove(constraints[index]);
            constraints.RemoveAt(index);
        }

        void Write(ConstraintHandle handle, float number)
        {
            ref var location = ref world.Solver.Locations[handle.Slot];
            var processor = world.Solver.Processor(location.TypeId);
            var column = new float[processor.PrestepFloats + processor.ImpulseFloats];
            for (int i = 0; i < column.Length; ++i)
                column[i] = number + i / 64f;
            processor.WriteColumn(ref world.Solver.TypeBatchAt(location), location.IndexInTypeBatch, column);
        }

        public List<string> Describe()
        {
            var result = new List<string>();
            foreach ((ConstraintHandle handle, float number) in constraints)
            {
                var location = world.Solver.Locations[handle.Slot];
                var processor = world.Solver.Processor(location.TypeId);
                var column = new float[processor.PrestepFloats + processor.ImpulseFloats];
                processor.ReadColumn(ref world.Solver.TypeBatchAt(location), location.IndexInTypeBatch, column);
                for (int i = 0; i < column.Length; ++i)
                    Assert.Equal(number + i / 64f, column[i]);
                result.Add($"{handle} {location.BatchIndex} {location.TypeId} {location.IndexInTypeBatch}");
            }
            return result;
        }

        public void Dispose() => world.Dispose();
    }
}
