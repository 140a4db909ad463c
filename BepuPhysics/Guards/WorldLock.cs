using System;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.CompilerServices;
using System.Threading;

namespace BepuPhysics;

/// <summary>Keeps a simulation from being changed while something else goes on in it: by callbacks, by other threads, after its end.</summary>
/// <remarks>
/// It never waits: who comes at the wrong time gets an exception that says what is going on. Three kinds of things can go on. One thread may
/// <i>hold</i> the world, for a stage of a step or for one change. One may be <i>stepping</i>: between its stages it may change the world
/// itself, and others may ask queries and write values, as the workers of an event do. Any number may be <i>reading</i>, which lasts while a
/// query runs, for its handler is the game's.
/// Each announces itself before it looks at the others, with a fence between, so that of two that exclude each other at least one notices.
/// </remarks>
sealed class WorldLock
{
    // Stages of all worlds are numbered, so that a thread's mark means one stage of one world and needs not be taken off.
    static long lastStage;
    [ThreadStatic] static long markedStage;

    readonly QueryCounts queries = new();
    int holder;
    int stepper;
    // The thread that runs a substep event: the others wait for it.
    int eventThread;
    long readableStage;
    volatile string activity = "";
    volatile string? end;
    // What the last step has left to be read from the world as it is: before anything changes, and by whoever comes first.
    volatile Action? unread;
    readonly Lock reader = new();

    static int CurrentThread => Environment.CurrentManagedThreadId;

    /// <summary>Whether the world has come to its end.</summary>
    internal bool HasEnded => end is not null;

    /// <summary>From now on everything is refused.</summary>
    /// <param name="reason">What has happened, as a sentence.</param>
    internal void End(string reason) => end ??= reason;

    /// <summary>Refuses what comes after the end.</summary>
    /// <exception cref="ObjectDisposedException">The simulation was disposed, or its memory is gone.</exception>
    internal void CheckAlive()
    {
        if (end is not null)
            ThrowEnded();
    }

    /// <summary>Refuses what comes after the end, where it is known that it does.</summary>
    [DoesNotReturn]
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal void ThrowEnded() => throw new ObjectDisposedException("Simulation", end);

    /// <summary>Begins a change by the calling thread.</summary>
    /// <exception cref="InvalidOperationException">Something else goes on, or the world has ended.</exception>
    internal Scope Change([CallerMemberName] string operation = "")
    {
        Hold(operation);
        return new(this);
    }

    /// <summary>As <see cref="Change"/>, until <see cref="Release"/>.</summary>
    internal void Hold(string operation)
    {
        var thread = Take(operation);
        if ((Volatile.Read(ref stepper) is var other and not 0 && other != thread) || queries.HasAny(thread))
            Refuse(operation);
        activity = operation;
        ReadUnread();
    }

    /// <summary>Leaves something to be read: when somebody asks for it, or else before the next change. The next step forgets it.</summary>
    /// <param name="read">Reads it. On any thread, while nothing changes; it must not fail.</param>
    internal void LeaveUnread(Action read) => unread = read;

    /// <summary>Reads what was left to be read.</summary>
    internal void ReadUnread()
    {
        if (unread is not null)
            ReadOnce();
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void ReadOnce()
    {
        lock (reader)
        {
            unread?.Invoke();
            unread = null;
        }
    }

    /// <summary>Ends a change or a stage.</summary>
    internal void Release()
    {
        readableStage = 0;
        Volatile.Write(ref holder, 0);
    }

    /// <summary>Begins a change that must not come between the stages of a step either.</summary>
    /// <exception cref="InvalidOperationException">Something else goes on, or the world has ended.</exception>
    internal Scope ChangeOutsideOfSteps([CallerMemberName] string operation = "")
    {
        var thread = Take(operation);
        if (Volatile.Read(ref stepper) != 0 || queries.HasAny(thread))
            Refuse(operation);
        activity = operation;
        ReadUnread();
        return new(this);
    }

    /// <summary>Begins a stage of a step.</summary>
    /// <param name="allowsQueries">Whether nothing that queries read changes in the stage, so that its workers may ask them.</param>
    /// <param name="operation">Name of the stage.</param>
    /// <exception cref="InvalidOperationException">Something else goes on, or the world has ended.</exception>
    internal Scope Stage(bool allowsQueries = false, [CallerMemberName] string operation = "")
    {
        var scope = Change(operation);
        if (allowsQueries)
        {
            readableStage = Interlocked.Increment(ref lastStage);
            MarkWorker();
        }
        return scope;
    }

    /// <summary>Begins a step, which consists of stages.</summary>
    /// <exception cref="InvalidOperationException">Something else goes on, or the world has ended.</exception>
    internal StepScope Step([CallerMemberName] string operation = "")
    {
        CheckAlive();
        var thread = CurrentThread;
        if (Interlocked.CompareExchange(ref stepper, thread, 0) != 0)
            ThrowBusy(operation);
        if (Volatile.Read(ref holder) != 0 || queries.HasAny(thread))
        {
            Volatile.Write(ref stepper, 0);
            ThrowBusy(operation);
        }
        // Whoever calls the stages without a step, or in another order, has no such moment: there the next stage is a change as any other.
        unread = null;
        return new(this);
    }

    /// <summary>Begins a query of the calling thread.</summary>
    /// <exception cref="InvalidOperationException">Something goes on that changes what queries read, or the world has ended.</exception>
    internal ReadScope Read([CallerMemberName] string operation = "")
    {
        CheckAlive();
        var thread = CurrentThread;
        if (queries.TryCountAtHome(thread, out var home))
        {
            if (Volatile.Read(ref holder) == 0 && queries.IsHome(home))
                return new(ref home.Count, isShared: false);
            --home.Count;
        }
        return ReadBesideOthers(thread, operation);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    ReadScope ReadBesideOthers(int thread, string operation)
    {
        ref var count = ref queries.Count(thread);
        if (Volatile.Read(ref holder) != 0 && !MayReadNow(thread))
        {
            Interlocked.Decrement(ref count);
            ThrowBusy(operation);
        }
        return new(ref count, isShared: true);
    }

    /// <summary>Refuses the writing of values, which moves nothing in memory, at a time when it would meet others that read or write them.</summary>
    /// <exception cref="InvalidOperationException">A stage or a change is in progress, or the world has ended.</exception>
    internal void CheckWritable([CallerMemberName] string operation = "")
    {
        CheckAlive();
        if (Volatile.Read(ref holder) != 0 && Volatile.Read(ref eventThread) != CurrentThread)
            ThrowBusy(operation);
    }

    /// <summary>Refuses a change at a time when a change would be refused, without beginning one.</summary>
    internal void CheckChangeable([CallerMemberName] string operation = "") => Change(operation).Dispose();

    /// <summary>Notes that the calling thread works at the present stage, so that what it calls may ask queries.</summary>
    internal void MarkWorker() => markedStage = readableStage;

    /// <summary>Begins a substep event, which runs alone.</summary>
    internal void BeginEvent() => Volatile.Write(ref eventThread, CurrentThread);

    /// <summary>Ends a substep event.</summary>
    internal void EndEvent() => Volatile.Write(ref eventThread, 0);

    bool MayReadNow(int thread) =>
        Volatile.Read(ref eventThread) == thread || (readableStage != 0 && markedStage == readableStage);

    // Tells which thread is calling, as asking takes a while.
    int Take(string operation)
    {
        CheckAlive();
        var thread = CurrentThread;
        if (Interlocked.CompareExchange(ref holder, thread, 0) != 0)
            ThrowBusy(operation);
        return thread;
    }

    [DoesNotReturn]
    void Refuse(string operation)
    {
        Volatile.Write(ref holder, 0);
        ThrowBusy(operation);
    }

    [DoesNotReturn]
    void ThrowBusy(string operation)
    {
        var cause = Volatile.Read(ref holder) != 0 ? $"while {activity} is in progress"
            : Volatile.Read(ref stepper) != 0 ? "while a step is in progress"
            : "while a query is in progress";
        throw new InvalidOperationException(
            $"{operation} was called {cause}, from a callback or from another thread; nothing was changed. " +
            "Docs/Guides/Callbacks.md says what may be called when.");
    }

    /// <summary>Ends a change or a stage.</summary>
    internal readonly ref struct Scope(WorldLock world)
    {
        public void Dispose() => world.Release();
    }

    /// <summary>Ends a step.</summary>
    internal readonly ref struct StepScope(WorldLock world)
    {
        public void Dispose() => Volatile.Write(ref world.stepper, 0);
    }

    /// <summary>Ends a query.</summary>
    internal readonly ref struct ReadScope(ref int count, bool isShared)
    {
        readonly ref int count = ref count;

        public void Dispose()
        {
            if (isShared)
                Interlocked.Decrement(ref count);
            else
                Volatile.Write(ref count, count - 1);
        }
    }
}
