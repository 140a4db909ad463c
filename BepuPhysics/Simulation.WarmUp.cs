using System;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics;

// Before the first step.
public sealed partial class Simulation
{
    static readonly int[] convexTypes = [Sphere.Id, Capsule.Id, Box.Id, Triangle.Id, Cylinder.Id, ConvexHull.Id];

    /// <summary>
    /// Compiles what steps will need, so that no step of a game waits for the compiler when shapes or joints of two types meet for the first time.
    /// </summary>
    /// <remarks>
    /// Takes from half a second to a few, and less the more threads there are, once per process and type; later calls, also of other simulations, only
    /// compile what is new. Changes nothing in the simulation: a small world of its own takes some steps, constraints of all registered types are
    /// solved for no body, and what is compiled for the game's callbacks is compiled without calling them. Of shapes it takes the types that
    /// <see cref="Shapes"/> has when it is called, or all if there are none yet; shape types and collision tasks of a game's own come into it with their
    /// first pair. Where nothing is compiled at run time, it does nothing.
    /// </remarks>
    /// <param name="threadDispatcher">Threads that steps will use, and that compile; null for the calling thread alone.</param>
    public void WarmUp(IThreadDispatcher? threadDispatcher = null)
    {
        using var change = world.Change("Simulation.WarmUp");
        if (!RuntimeFeature.IsDynamicCodeCompiled)
            return;
        var used = Array.FindAll(convexTypes, Shapes.HasAny);
        var types = used.Length > 0 ? used : convexTypes;
        var work = new WarmUpWork(this, types);
        StagedWork.Run(ref work, threadDispatcher);
        // The world once more, with threads: these are free again now.
        if (threadDispatcher is not null)
            WarmUpWorld.Run(types, threadDispatcher);
    }

    // Parts that have nothing to do with each other. The compiler takes as many threads as call it.
    readonly struct WarmUpWork(Simulation simulation, int[] shapeTypes) : IStagedWork
    {
        // The world takes longest and comes first; constraint types are the blocks after these.
        const int World = 0;
        const int NarrowPhase = 1;
        const int Integrator = 2;
        const int Joints = 3;
        const int FirstConstraintType = 4;

        public int StageCount => 1;

        public int GetBlockCount(int stage) => FirstConstraintType + simulation.Solver.TypeProcessors.Count;

        public void Execute(int stage, int block, int workerIndex)
        {
            switch (block)
            {
                case World:
                    WarmUpWorld.Run(shapeTypes, null);
                    break;
                case NarrowPhase:
                    simulation.NarrowPhase.Compile(shapeTypes);
                    break;
                case Integrator:
                    Solver.CompileFreeFlight();
                    simulation.PoseIntegrator.Compile();
                    break;
                case Joints:
                    if (simulation.Solver.DirectJoints != DirectJointsMode.Off)
                        WarmUpJoints.Run();
                    break;
                default:
                    simulation.Solver.WarmUp(block - FirstConstraintType);
                    break;
            }
        }
    }
}
