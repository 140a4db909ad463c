using System;
using System.Diagnostics.CodeAnalysis;

namespace BepuUtilities.TaskScheduling;

/// <summary>
/// Names a continuation of a <see cref="TaskStack"/>: what waits for the end of a number of tasks. Valid until the stack is reset
/// or disposed; it must not be used after that.
/// </summary>
public readonly unsafe struct ContinuationHandle : IEquatable<ContinuationHandle>
{
    internal readonly TaskContinuation* Memory;

    internal ContinuationHandle(TaskContinuation* memory) => Memory = memory;

    /// <summary>The handle of no continuation.</summary>
    public static ContinuationHandle Null => default;

    /// <summary>Whether this names a continuation.</summary>
    public bool Initialized => Memory != null;

    /// <summary>
    /// Whether all tasks have ended, and the task to run after them as well. What they wrote is then visible here. Always true for
    /// <see cref="Null"/>. A task that threw an exception, or was not begun because of a stop, has not ended in this sense.
    /// </summary>
    public bool Completed => Memory == null || Memory->Completed;

    /// <summary>Counts one task as ended; the last one runs the task to run after them, here. <see cref="Task.Run"/> does this by itself.</summary>
    /// <param name="workerIndex">Index of the worker that calls.</param>
    /// <param name="dispatcher">Dispatcher of that worker.</param>
    /// <exception cref="InvalidOperationException">There is no continuation, or all of its tasks have ended already.</exception>
    public void NotifyTaskCompleted(int workerIndex, IThreadDispatcher dispatcher)
    {
        if (Memory == null)
            throw new InvalidOperationException("The handle names no continuation.");
        if (Memory->EndWithoutRunning())
            TaskContinuation.Run(Memory->OnCompleted, Memory, workerIndex, dispatcher);
    }

    /// <inheritdoc/>
    public bool Equals(ContinuationHandle other) => Memory == other.Memory;

    /// <inheritdoc/>
    public override bool Equals([NotNullWhen(true)] object? obj) => obj is ContinuationHandle other && Equals(other);

    /// <inheritdoc/>
    public override int GetHashCode() => (int)((nuint)Memory / (nuint)sizeof(TaskContinuation));

    /// <summary>Whether two handles name the same continuation.</summary>
    public static bool operator ==(ContinuationHandle left, ContinuationHandle right) => left.Equals(right);

    /// <summary>Whether two handles name different continuations.</summary>
    public static bool operator !=(ContinuationHandle left, ContinuationHandle right) => !left.Equals(right);
}
