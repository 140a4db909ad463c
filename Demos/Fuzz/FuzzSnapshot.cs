using System;
using System.Collections.Generic;
using BepuPhysics;
using BepuUtilities.Memory;

namespace Demos.Fuzz;

/// <summary>A snapshot that is kept over other calls, and what there was when it was taken.</summary>
sealed class FuzzSnapshot(BufferPool pool) : IDisposable
{
    readonly SimulationSnapshot snapshot = new(pool);
    readonly List<BodyHandle> bodies = [];
    readonly List<StaticHandle> statics = [];
    readonly List<ConstraintHandle> constraints = [];
    readonly List<BodyHandle> unsoundMotions = [], unsoundInertias = [];
    ulong state, hash;

    public void Save(FuzzWorld world)
    {
        world.Simulation.Save(snapshot);
        Set(bodies, world.Bodies.Live);
        Set(statics, world.Statics.Live);
        Set(constraints, world.Constraints.Live);
        world.SaveUnsound(unsoundMotions, unsoundInertias);
        (state, hash) = (FuzzFingerprint.OfSnapshot(world.Simulation), world.Simulation.StateHash());
    }

    public void Restore(FuzzWorld world)
    {
        world.Simulation.Restore(snapshot);
        Set(world.Bodies.Live, bodies);
        Set(world.Statics.Live, statics);
        Set(world.Constraints.Live, constraints);
        world.RestoreUnsound(unsoundMotions, unsoundInertias);
        if (world.Simulation.StateHash() != hash)
            throw new FuzzFailure("another hash after a restore");
        if (FuzzFingerprint.OfSnapshot(world.Simulation) != state)
            throw new FuzzFailure("another state after a restore");
    }

    public void Dispose() => snapshot.Dispose();

    static void Set<T>(List<T> target, List<T> source)
    {
        target.Clear();
        target.AddRange(source);
    }
}
