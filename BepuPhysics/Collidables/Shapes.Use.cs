using System;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

// Who uses the shapes, and when they may be changed.
public sealed partial class Shapes : IBufferPoolUser
{
    void IBufferPoolUser.CheckNotBusy()
    {
        using var change = Change("BufferPool.Clear");
    }

    void IBufferPoolUser.ForgetMemory()
    {
        world.End("The pool of the shapes was cleared.");
        batches = [];
    }

    /// <summary>Source of the memory of all batches.</summary>
    internal BufferPool Pool => pool;

    /// <summary>Whether any simulation but one uses the collection.</summary>
    internal bool IsUsedByOthers(WorldLock user) => Array.Exists(users, other => other != user);

    /// <summary>Notes that a simulation uses the collection. Others that use it may be stepping meanwhile.</summary>
    internal void Attach(WorldLock user)
    {
        // Not while the collection changes: that change holds those who use it, and would not hold this one.
        using var change = world.Change("Simulation.Create");
        lock (world)
            users = [.. users, user];
    }

    /// <summary>Notes that a simulation no longer uses the collection.</summary>
    internal void Detach(WorldLock user)
    {
        lock (world)
            users = Array.FindAll(users, other => other != user);
    }

    /// <summary>Begins a change, for which all simulations that use the collection must be at rest.</summary>
    /// <exception cref="InvalidOperationException">A stage or a query is in progress, another thread is changing something, or the collection was part of
    /// a simulation that was disposed.</exception>
    internal ChangeScope Change(string operation)
    {
        world.Hold(operation);
        var held = users;
        int count = 0;
        try
        {
            for (; count < held.Length; ++count)
                held[count].Hold(operation);
        }
        catch
        {
            new ChangeScope(world, held.AsSpan(0, count)).Dispose();
            throw;
        }
        return new(world, held);
    }

    /// <summary>Counts a body or static that gets a shape.</summary>
    internal void BeginUse(TypedIndex shape)
    {
        if (shape.Exists)
            GetBatch(shape.Type).BeginUse(shape.Index);
    }

    /// <summary>Counts a body or static that loses a shape.</summary>
    internal void EndUse(TypedIndex shape)
    {
        // Where the pool of the shapes was cleared before that of the simulation, there is nothing left to count.
        if (shape.Exists && shape.Type < batches.Length && batches[shape.Type] is { } batch)
            batch.EndUse(shape.Index);
    }

    /// <summary>Counts a body or static that gets one shape for another.</summary>
    internal void ChangeUse(TypedIndex previous, TypedIndex next)
    {
        BeginUse(next);
        EndUse(previous);
    }

    /// <summary>Returns all memory with the simulation that the collection is part of.</summary>
    internal void EndWithSimulation()
    {
        ReturnMemory();
        world.End("The simulation that the shapes were part of was disposed.");
    }

    /// <summary>Refuses a collection whose memory is gone.</summary>
    internal void CheckAlive() => world.CheckAlive();

    void CheckAllUnused()
    {
        foreach (var batch in batches)
            batch?.CheckAllUnused(andNoParts: false);
    }

    /// <summary>Ends a change.</summary>
    internal readonly ref struct ChangeScope(WorldLock own, ReadOnlySpan<WorldLock> users)
    {
        readonly ReadOnlySpan<WorldLock> users = users;

        public void Dispose()
        {
            for (int i = users.Length - 1; i >= 0; --i)
                users[i].Release();
            own?.Release();
        }
    }
}
