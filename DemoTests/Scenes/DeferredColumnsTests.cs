using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Contact constraints that come and go while what follows from that is deferred end up as if each had come and gone at once.</summary>
public class DeferredColumnsTests
{
    const int BodyCount = 120;
    const int KinematicCount = 6;

    [Theory]
    [InlineData(1, 1)]
    [InlineData(2, 2)]
    [InlineData(3, 5)]
    [InlineData(4, 16)]
    public void Order_places_and_lists_are_kept(int seed, int threadCount)
    {
        using var now = new World(seed);
        using var later = new World(seed);
        for (int round = 0; round < 30; ++round)
        {
            now.Change(round, deferredThreads: 0);
            later.Change(round, threadCount);
            Assert.Equal(now.Describe(), later.Describe());
            later.Simulation.Solver.Validate();
        }
    }

    /// <summary>Constraints of several types, each with a number that no other has in all that it holds.</summary>
    sealed class World : IDisposable
    {
        // Type batches grow from nothing, also in the midst of it; few batches, so that some constraints go to the last one.
        readonly TestWorld world = new(
            new() { Contacts = Demos.Accuracy.ContactScope.None }, fallbackBatchThreshold: 6, sizes: new(64, 64, 64, 64, 64, 1, 4));
        readonly List<BodyHandle> bodies = [];
        readonly List<(ConstraintHandle Handle, ContactEnds Ends, float Number)> constraints = [];
        readonly int seed;

        public World(int seed)
        {
            this.seed = seed;
            for (int i = 0; i < BodyCount; ++i)
            {
                var pose = new RigidPose(new Vector3(2 * i, 0, 0));
                bodies.Add(i < KinematicCount ? world.AddKinematic(new Sphere(.5f), pose) : world.AddDynamic(new Sphere(.5f), 1, pose));
            }
        }

        public Simulation Simulation => world.Simulation;

        // Now and then all go, with their type batches, and others come.
        public void Change(int round, int deferredThreads)
        {
            var random = new Random(seed * 1000 + round);
            var solver = world.Solver;
            var added = new List<(int Number, int Index)>();
            if (deferredThreads > 0)
                solver.BeginDeferral(1);
            int removals = round % 7 == 6 ? constraints.Count : random.Next(constraints.Count + 1);
            var old = constraints.Count;
            for (int i = 0; i < removals; ++i)
                Remove(random.Next(old--));
            for (int i = random.Next(round % 5 == 4 ? 1500 : 180); i > 0; --i)
            {
                Add(random, added, round * 2000 + i, deferredThreads > 0);
                if (old > 0 && random.Next(3) == 0)
                    Remove(random.Next(old--));
            }
            if (deferredThreads == 0)
                return;
            solver.PrepareDeferred(deferredThreads);
            // From the last: they are independent of each other.
            for (int i = solver.DeferredBlockCount - 1; i >= 0; --i)
                solver.DoDeferred(i);
            foreach ((int number, int value) in added)
                Write(solver.Place(number), value);
            for (int i = solver.LastBlockCount - 1; i >= 0; --i)
                solver.DoLast(i);
            solver.EndDeferral();
        }

        void Add(Random random, List<(int, int)> added, int number, bool isDeferred)
        {
            int a = random.Next(KinematicCount, BodyCount), b = (a + 1 + random.Next(BodyCount - 1)) % BodyCount;
            var isAlone = random.Next(3) == 0;
            var type = ConstraintTypeIds.ConvexContact(1 + random.Next(4), isAlone ? 1 : 2);
            var ends = new ContactEnds(bodies[a].Slot, ReferenceTo(a), bodies[b].Slot, isAlone ? -1 : ReferenceTo(b));
            ConstraintHandle handle;
            if (isDeferred)
            {
                handle = world.Solver.AddLater(ends, type, out var place);
                added.Add((place, number));
            }
            else
            {
                handle = world.Solver.AddUnwritten(isAlone ? [bodies[a]] : [bodies[a], bodies[b]], type);
                Write(handle, number);
            }
            constraints.Add((handle, ends, number));
        }

        int ReferenceTo(int body)
        {
            var index = world.Simulation.Bodies.Locations[bodies[body].Slot].Index;
            return body < KinematicCount ? index | EncodedBody.KinematicFlag : index;
        }

        // One that was there before the round; the others keep their order.
        void Remove(int index)
        {
            if (world.Solver.Defers)
                world.Solver.RemoveLater(constraints[index].Handle, constraints[index].Ends);
            else
                world.Solver.RemoveWithoutNotice(constraints[index].Handle);
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
            foreach (var (handle, _, number) in constraints)
            {
                var location = world.Solver.Locations[handle.Slot];
                var processor = world.Solver.Processor(location.TypeId);
                var column = new float[processor.PrestepFloats + processor.ImpulseFloats];
                processor.ReadColumn(ref world.Solver.TypeBatchAt(location), location.IndexInTypeBatch, column);
                for (int i = 0; i < column.Length; ++i)
                    Assert.Equal(number + i / 64f, column[i]);
                var place = world.Solver.Sets[0].Batches[location.BatchIndex].Find(location.TypeId);
                result.Add($"{handle} {location.BatchIndex} {location.TypeId} {place} {location.IndexInTypeBatch}");
            }
            foreach (var body in bodies)
            {
                var list = new List<string>();
                foreach (var constraint in Simulation.Bodies[body].Constraints)
                    list.Add($"{constraint.ConnectingConstraintHandle}.{constraint.BodyIndexInConstraint}");
                result.Add(string.Join(' ', list));
            }
            return result;
        }

        public void Dispose() => world.Dispose();
    }
}
