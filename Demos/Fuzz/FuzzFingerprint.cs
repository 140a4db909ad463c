using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics;
using BepuPhysics.Constraints;
using BepuPhysics.Trees;
using BepuUtilities.Collections;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace Demos.Fuzz;

/// <summary>A hash of all that a call could change: not of poses alone, but of settings, lists, trees, handles, constraints.</summary>
static class FuzzFingerprint
{
    public static ulong Of(Simulation simulation)
    {
        StateHash hash = default;
        hash.Add(OfSnapshot(simulation));
        hash.Add(MemoryMarshal.AsBytes(simulation.Quarantine.Bodies));
        hash.Add(simulation.Deterministic ? 1 : 0);
        hash.Add(simulation.Bodies.MinimumConstraintCapacityPerBody);
        hash.Add(simulation.Solver.MinimumCapacityPerTypeBatch);
        return hash.Value;
    }

    /// <summary>What a snapshot brings back: all but how memory is grown, and what the last step has told.</summary>
    public static ulong OfSnapshot(Simulation simulation)
    {
        StateHash hash = default;
        AddBodies(ref hash, simulation.Bodies);
        AddStatics(ref hash, simulation.Statics);
        AddConstraints(ref hash, simulation.Solver);
        AddTree(ref hash, simulation.BroadPhase.ActiveTree);
        AddTree(ref hash, simulation.BroadPhase.StaticTree);
        hash.Add(simulation.NarrowPhase.PairCount);
        return hash.Value;
    }

    static void AddBodies(ref StateHash hash, Bodies bodies)
    {
        ref BodySet set = ref bodies.ActiveSet;
        hash.Add(set.Count);
        Add(ref hash, set.IndexToHandle, set.Count);
        Add(ref hash, set.MotionStates, set.Count);
        Add(ref hash, set.LocalInertias, set.Count);
        Add(ref hash, set.Collidables, set.Count);
        Add(ref hash, set.Activity, set.Count);
        for (int i = 0; i < set.Count; ++i)
        {
            foreach (var constraint in bodies[set.IndexToHandle[i]].Constraints)
            {
                hash.Add(constraint.ConnectingConstraintHandle.Value);
                hash.Add(constraint.BodyIndexInConstraint);
            }
        }
        AddIds(ref hash, bodies.HandlePool);
    }

    static void AddStatics(ref StateHash hash, Statics statics)
    {
        hash.Add(statics.Count);
        Add(ref hash, statics.IndexToHandle, statics.Count);
        Add(ref hash, statics.StaticsBuffer, statics.Count);
        AddIds(ref hash, statics.HandlePool);
    }

    static void AddConstraints(ref StateHash hash, Solver solver)
    {
        ref ConstraintSet set = ref solver.ActiveSet;
        for (int i = 0; i < set.Batches.Count; ++i)
        {
            ref QuickList<TypeBatch> typeBatches = ref set.Batches[i].TypeBatches;
            for (int j = 0; j < typeBatches.Count; ++j)
            {
                ref TypeBatch batch = ref typeBatches[j];
                hash.Add(batch.TypeId);
                hash.Add(batch.ConstraintCount);
                hash.Add((int)set.Batches[i].Kind);
                for (int k = 0; k < batch.ConstraintCount; ++k)
                    AddOptions(ref hash, solver, batch.IndexToHandle[k]);
                TypeProcessor processor = solver.TypeProcessors[batch.TypeId]!;
                int bundleLength = batch.BundleCount * Vector<float>.Count;
                Add(ref hash, batch.IndexToHandle, batch.ConstraintCount);
                Add(ref hash, batch.BodyReferences, bundleLength * processor.BodiesPerConstraint);
                Add(ref hash, batch.Prestep, bundleLength * processor.PrestepFloats);
                Add(ref hash, batch.AccumulatedImpulses, bundleLength * processor.ImpulseFloats);
            }
        }
        AddIds(ref hash, solver.HandlePool);
        hash.Add(solver.VelocityIterationCount);
        hash.Add(solver.SubstepCount);
        hash.Add(solver.RelaxationIterationCount);
        hash.Add((int)solver.LoadPath);
        hash.Add((int)solver.DirectJoints);
        hash.Add(solver.StopsImpacts ? 1 : 0);
        hash.Add(solver.ClosesGapsSlowly ? 1 : 0);
        hash.Add(solver.ContactFrequency);
        hash.Add(solver.Governor.HasValue ? 1 : 0);
        hash.Add(solver.Governor.GetValueOrDefault().TargetError);
        hash.Add(solver.Governor.GetValueOrDefault().LeastSubstepCount);
        hash.Add(solver.Governor.GetValueOrDefault().GreatestSubstepCount);
    }

    static void AddOptions(ref StateHash hash, Solver solver, ConstraintHandle handle)
    {
        var threshold = solver.GetBreakThreshold(handle);
        hash.Add(threshold.Impulse);
        hash.Add(threshold.AngularImpulse);
        hash.Add(solver.GetCollideConnected(handle) ? 1 : 0);
    }

    static void AddTree(ref StateHash hash, in Tree tree)
    {
        hash.Add(tree.LeafCount);
        Add(ref hash, tree.Nodes, tree.NodeCount);
        Add(ref hash, tree.Leaves, tree.LeafCount);
    }

    static void AddIds(ref StateHash hash, in IdPool ids)
    {
        hash.Add(ids.HighestPossiblyClaimedId);
        Add(ref hash, ids.AvailableIds, ids.AvailableIdCount);
    }

    static void Add<T>(ref StateHash hash, in Buffer<T> buffer, int count) where T : unmanaged
    {
        if (count > 0)
            hash.Add(MemoryMarshal.AsBytes(buffer.AsSpan()[..count]));
    }
}
