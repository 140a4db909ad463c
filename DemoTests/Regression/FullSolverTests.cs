using System;
using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuUtilities.Memory;
using DemoTests.Locking;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// A step that could not add the constraints of its contacts kept what its workers had found: their pools stayed lent and took the step for one
/// that is still in progress, so that the dispatcher could not be disposed.
/// </summary>
public class FullSolverTests
{
    [Theory]
    [InlineData(1)]
    [InlineData(3)]
    public void AStepWithoutRoomForContactsGivesTheMemoryOfItsWorkersBack(int threads)
    {
        using var world = new LockedWorld(threads, 40);
        var solver = world.Simulation.Solver;
        // As if all ids were in use: so many constraints would take gigabytes.
        ref var nextId = ref Unsafe.As<IdPool, int>(ref solver.HandlePool);
        var used = nextId;
        nextId = Solver.MaximumCount;
        for (int i = 0; i < 2; ++i)
        {
            var error = Assert.Throws<InvalidOperationException>(world.Step);
            Assert.Contains("as many as a simulation holds", error.Message, StringComparison.Ordinal);
            world.Dispatcher?.WorkerPools.AssertEmpty();
        }
        nextId = used;

        world.Simulation.Validate();
        world.Step();
        world.Simulation.Validate();
        Assert.True(world.Simulation.NarrowPhase.PairCount >= 40);
        // Which the end of the world does too, after having asked whether all memory was returned.
        world.Dispatcher?.WorkerPools.Clear();
    }
}
