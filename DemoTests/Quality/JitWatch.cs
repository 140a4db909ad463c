using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.Diagnostics;
using System.Diagnostics.Tracing;
using System.Linq;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Threading;

namespace DemoTests.Quality;

/// <summary>Listens to the JIT for inlining decisions, from before the first test: a method is compiled once, by whichever test needs it first.</summary>
sealed class JitWatch : EventListener
{
    const EventKeywords Jit = (EventKeywords)0x1000;

    static readonly Action[] markers = [Marker<byte>, Marker<short>, Marker<int>, Marker<long>, Marker<float>, Marker<double>];

    static JitWatch? instance;

    readonly ConcurrentQueue<(string Root, string Callee, string Reason)> failures = new();

    /// <summary>Debug builds inline nothing, so there is nothing to watch.</summary>
    public static bool BuildIsUnoptimized => typeof(JitWatch).Assembly.GetCustomAttribute<DebuggableAttribute>() is { IsJITOptimizerDisabled: true };

    /// <summary>The watch of this process.</summary>
    public static JitWatch Instance => instance ?? throw new InvalidOperationException("Nothing is watched in an unoptimized build.");

#pragma warning disable CA2255 // A test assembly is an application, and nothing later is early enough.
    [ModuleInitializer]
#pragma warning restore CA2255
    internal static void Begin()
    {
        if (!BuildIsUnoptimized)
            instance = new();
    }

    protected override void OnEventSourceCreated(EventSource eventSource)
    {
        if (eventSource.Name == "Microsoft-Windows-DotNETRuntime")
            EnableEvents(eventSource, EventLevel.Verbose, Jit);
    }

    protected override void OnEventWritten(EventWrittenEventArgs eventData)
    {
        if (eventData.EventName != "MethodJitInliningFailed" || eventData.Payload is not { } p)
            return;
        var reason = (string)p[10]!;
        var callee = (string)p[7]!;
        if (reason is "inline exceeds budget" or "too many locals" || callee == nameof(NeverInlined))
            failures.Enqueue(($"{p[0]}.{p[1]}", $"{p[6]}.{callee}", reason));
    }

    /// <summary>Inlines that the JIT gave up for want of room so far, in methods of a namespace.</summary>
    public IReadOnlyList<string> Overflows(string rootNamespace)
    {
        // Events arrive on another thread, in order: once the marker's own failure is here, so is everything before it. The runtime drops events
        // when that thread is kept from running for long, and each marker is compiled once: then the next one is tried.
        if (!markers.Any(HasArrived))
            throw new InvalidOperationException("The runtime delivered no JIT events.");
        return [.. failures
            .Where(f => f.Root.StartsWith(rootNamespace, StringComparison.Ordinal) && !f.Callee.EndsWith(nameof(NeverInlined), StringComparison.Ordinal))
            .Select(f => $"{f.Root}: {f.Callee} ({f.Reason})").Distinct()];
    }

    bool HasArrived(Action marker)
    {
        marker();
        return SpinWait.SpinUntil(() => failures.Any(f => f.Callee.EndsWith(nameof(NeverInlined), StringComparison.Ordinal)), TimeSpan.FromSeconds(10));
    }

    // Code of its own for each value type.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Marker<T>() where T : struct => NeverInlined();

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void NeverInlined() { }
}
