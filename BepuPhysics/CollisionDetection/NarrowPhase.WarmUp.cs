using System;
using BepuUtilities.Collections;
using BepuUtilities.Diagnostics;
using BepuUtilities.TaskScheduling;

namespace BepuPhysics.CollisionDetection;

// What is compiled for the callbacks of a game: this class, and what it is handed to.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    internal override void Compile(ReadOnlySpan<int> shapeTypes)
    {
        var manifold = typeof(ConvexContactManifold);
        Precompilation.CompileAll(typeof(NarrowPhase<TCallbacks>));
        Precompilation.Compile(typeof(NarrowPhase<TCallbacks>), nameof(Complete), manifold);
        Precompilation.Compile(typeof(NarrowPhase<TCallbacks>), nameof(CompleteLater), manifold);
        Precompilation.Compile(typeof(NarrowPhase<TCallbacks>), nameof(OnPairCompleted), manifold);
        Precompilation.Compile(typeof(Completion), nameof(ICollisionCallbacks.OnPairCompleted), manifold);
        Precompilation.Compile(typeof(TCallbacks));
        Precompilation.Compile(typeof(TCallbacks), nameof(INarrowPhaseCallbacks.ConfigureContactManifold), manifold);
        Precompilation.CompileAll(typeof(CollisionBatcher<Completion>));
        Precompilation.Compile(typeof(BroadPhase), nameof(BroadPhase.FindOverlapsOfLeaves), typeof(Overlaps));
        if (Simulation.Layers.IsUsed)
        {
            Precompilation.Compile(typeof(BroadPhase), nameof(BroadPhase.FindOverlapsOfLeaves), typeof(LayeredOverlaps));
            OverlapFinder.Compile<LayeredOverlaps>();
        }
        StagedWork.Compile<FlushWork>();
        StagedWork.Compile<ChangeWork>();
        StagedWork.Compile<SeamWork>();
        Precompilation.Compile(typeof(QuickList<PendingManifold>));
        Precompilation.Compile(typeof(QuickList<ContactPatch>));
        Precompilation.Compile(typeof(QuickList<BouncingPair>));
        Precompilation.Compile(typeof(QuickList<Bend>));
        Precompilation.Compile(typeof(QuickList<NoteKey>));
        Precompilation.Compile(typeof(RadixSort<NoteKey, ByKey>));
        OverlapFinder.Compile<Overlaps>();
        foreach (var a in shapeTypes)
        {
            foreach (var b in shapeTypes)
            {
                if (a > b || !CollisionTaskRegistry.TryGetTask(a, b, out var task))
                    continue;
                Precompilation.Compile(task.GetType(), nameof(CollisionTask.Execute), typeof(Completion));
            }
        }
        // Made on first use, which is in a step otherwise: what touches several statics asks for it as well as children do.
        GC.KeepAlive(DirectedTasks.Registry);
    }
}
