using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Threading;
using BepuUtilities;

namespace Demos.Fuzz;

/// <summary>Calls worlds at random and looks whether the library keeps its promises.</summary>
/// <remarks>
/// Each world has a seed of its own, and each call of a world too: a world can be run again alone, and with calls left out.
/// Before each call its name goes to a file, so that a process that dies says where.
/// </remarks>
sealed class FuzzRun : IDisposable
{
    const int CallsAfterDispose = 20;
    const int ThreadCount = 3;

    readonly FuzzSettings settings;
    readonly TextWriter output;
    readonly FuzzTrace trace;
    ThreadDispatcher dispatcher = new(ThreadCount);
    long calls, refusals, stopped;

    public FuzzRun(FuzzSettings settings, TextWriter output)
    {
        this.settings = settings;
        this.output = output;
        trace = new FuzzTrace(settings.TracePath);
    }

    /// <summary>Calls that were made, and those of them that were refused; how often steps stopped bodies because of their numbers.</summary>
    public (long Calls, long Refusals, long Stopped) Counts => (calls, refusals, stopped);

    /// <summary>Runs all worlds, or the one that is asked for, and returns the number of those that failed.</summary>
    public int Run(CancellationToken stop)
    {
        int failures = 0;
        long lastReport = Stopwatch.GetTimestamp();
        int worlds = (int)((settings.Calls + settings.CallsPerWorld - 1) / settings.CallsPerWorld);
        for (int world = settings.World ?? 0; world < (settings.World + 1 ?? worlds) && !stop.IsCancellationRequested; ++world)
        {
            ulong seed = FuzzRandom.Mix((ulong)settings.Seed, (ulong)world);
            if (RunWorld(world, seed, null, null) is { } failure)
            {
                Report(world, seed, failure);
                if (++failures >= settings.MaximumFailures)
                    break;
            }
            if (Stopwatch.GetElapsedTime(lastReport).TotalSeconds < 10)
                continue;
            lastReport = Stopwatch.GetTimestamp();
            output.WriteLine(FormattableString.Invariant($"{world + 1} of {worlds} worlds, {calls} calls, {refusals} refused, {failures} failures"));
        }
        return failures;
    }

    /// <summary>Whether an exception says that a call was refused.</summary>
    public static bool IsRefusal(Exception error) => error switch
    {
        FuzzFailure => false,
        AggregateException many => Array.TrueForAll([.. many.InnerExceptions], IsRefusal),
        _ => error is ArgumentException or InvalidOperationException,
    };

    /// <summary>Whether an exception came from a callback of ours.</summary>
    static bool IsCallbacks(Exception error) => error switch
    {
        FuzzCallbackException => true,
        AggregateException many => Array.TrueForAll([.. many.InnerExceptions], IsCallbacks),
        _ => error.InnerException is { } inner && IsCallbacks(inner),
    };

    // Null when all went well. Calls that are not included are left out; the list receives those that were made.
    Failure? RunWorld(int number, ulong seed, bool[]? included, List<string>? list)
    {
        trace.BeginWorld(settings.Seed, number);
        var world = new FuzzWorld(seed, settings.Scope, dispatcher) { IsVerbose = list is not null };
        Failure? failure = CallWorld(world, seed, included, list);
        stopped += world.StoppedCount;
        try
        {
            world.Dispose();
        }
        catch (InvalidOperationException error)
        {
            // Somebody takes a world at rest for a busy one.
            failure ??= new Failure(settings.CallsPerWorld, "disposal of the pool", error);
        }
        if (failure is not null)
            RenewDispatcher();
        return failure;
    }

    // What a failure has left in the memory of the workers must not fail the worlds that come after it.
    void RenewDispatcher()
    {
        ThreadDispatcher used = dispatcher;
        dispatcher = new(ThreadCount);
        try
        {
            used.Dispose();
        }
        catch (InvalidOperationException error)
        {
            output.WriteLine("the workers' pools are held after a failure: " + error.Message);
        }
    }

    Failure? CallWorld(FuzzWorld world, ulong seed, bool[]? included, List<string>? list)
    {
        int call = 0;
        string name = "creation";
        try
        {
            ulong state = FuzzFingerprint.Of(world.Simulation);
            for (; call < settings.CallsPerWorld; ++call)
            {
                if (included is not null && !included[call])
                    continue;
                world.BeginCall(new FuzzRandom(FuzzRandom.Mix(seed, (ulong)call + 1)));
                FuzzOperation operation = FuzzOperations.Draw(world.Random);
                name = operation.Name;
                trace.BeginCall(call, name);
                list?.Add($"{call,5} {name}");
                var outcome = Call(world, operation);
                if (list is not null)
                    list[^1] += world.Arguments + (outcome is null ? "" : " -> " + outcome.Message);
                ulong after = FuzzFingerprint.Of(world.Simulation);
                if (outcome is not null && after != state && !world.Plan.WasCalled)
                    throw new FuzzFailure($"refused ({outcome.Message}), but changed something");
                state = after;
                world.Check(call);
            }
            name = "after disposal";
            if (world.Has(FuzzScope.AfterDispose))
                CallAfterDispose(world, seed, list);
            name = "the end";
            world.End();
            return null;
        }
        catch (Exception error)
        {
            return new Failure(call, name, error);
        }
    }

    // Whatever is called then: no crash, and nothing is taken from the pool for good.
    void CallAfterDispose(FuzzWorld world, ulong seed, List<string>? list)
    {
        world.EndSimulation();
        for (int call = settings.CallsPerWorld; call < settings.CallsPerWorld + CallsAfterDispose; ++call)
        {
            world.BeginCall(new FuzzRandom(FuzzRandom.Mix(seed, (ulong)call + 1)));
            FuzzOperation operation = FuzzOperations.Draw(world.Random);
            trace.BeginCall(call, operation.Name);
            Exception? outcome = Call(world, operation);
            list?.Add($"{call,5} {operation.Name}{world.Arguments} -> {outcome?.Message}");
            // Shapes that were shared live on: one that is removed gives its name to the next.
            world.DisposeLostShapes(false);
        }
    }

    // The exception by which the call was refused, or a callback ended it.
    Exception? Call(FuzzWorld world, FuzzOperation operation)
    {
        Interlocked.Increment(ref calls);
        try
        {
            operation.Run(world);
            return null;
        }
        catch (Exception error) when (IsRefusal(error) || IsCallbacks(error))
        {
            ++refusals;
            return error;
        }
    }

    sealed record Failure(int Call, string Name, Exception Error)
    {
        public bool IsLike(Failure other) => Name == other.Name && Error.GetType() == other.Error.GetType();
    }

    void Report(int world, ulong seed, Failure failure)
    {
        output.WriteLine();
        output.WriteLine($"FAILURE in world {world} of seed {settings.Seed}, call {failure.Call}, {failure.Name}: {failure.Error.Message}");
        output.WriteLine($"again: Demos fuzz --seed {settings.Seed} --world {world} --scope {(int)settings.Scope} --calls-per-world {settings.CallsPerWorld}");
        output.WriteLine(failure.Error.ToString());
        bool[] included = Shrink(world, seed, failure);
        var list = new List<string>();
        RunWorld(world, seed, included, list);
        output.WriteLine($"{list.Count} calls suffice:");
        foreach (string line in list)
            output.WriteLine(line);
        output.Flush();
    }

    // Leaves out what can be left out, in ever smaller pieces.
    bool[] Shrink(int world, ulong seed, Failure failure)
    {
        var included = new bool[settings.CallsPerWorld];
        Array.Fill(included, true, 0, Math.Min(failure.Call + 1, included.Length));
        long start = Stopwatch.GetTimestamp();
        for (int length = included.Length / 2; length > 0; length /= 2)
        {
            for (int first = 0; first < included.Length; first += length)
            {
                if (Stopwatch.GetElapsedTime(start).TotalSeconds > settings.ShrinkSeconds)
                    return included;
                var fewer = (bool[])included.Clone();
                Array.Fill(fewer, false, first, Math.Min(length, fewer.Length - first));
                if (fewer.AsSpan().SequenceEqual(included))
                    continue;
                if (RunWorld(world, seed, fewer, null) is { } again && again.IsLike(failure))
                    included = fewer;
            }
        }
        return included;
    }

    public void Dispose()
    {
        dispatcher.Dispose();
        trace.Dispose();
    }
}
