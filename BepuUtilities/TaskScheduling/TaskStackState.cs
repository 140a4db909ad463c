using System;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Threading;

namespace BepuUtilities.TaskScheduling;

/// <summary>What all workers of a <see cref="TaskStack"/> share. Its workers follow it in memory.</summary>
[StructLayout(LayoutKind.Explicit, Size = Size)]
unsafe struct TaskStackState
{
    public const int Size = 256;
    const int Going = 0;
    const int StopRequested = 1;
    const int Failed = 2;

    [FieldOffset(0)] public int WorkerCount;
    [FieldOffset(4)] public int InitialJobCapacity;
    [FieldOffset(8)] public int ContinuationBlockCapacity;
    // Hardly ever written, read with every task: away from the newest job, which is written all the time.
    [FieldOffset(12)] int stop;
    // A handle of the first exception; zero while there is none.
    [FieldOffset(16)] nint failure;

    [FieldOffset(128)] public TaskStackJob* Newest;

    public bool IsStopped => Volatile.Read(ref stop) != Going;

    public bool HasFailed => Volatile.Read(ref stop) == Failed;

    /// <summary>The first exception that a task threw; null for none.</summary>
    public Exception? Failure
    {
        get
        {
            var handle = Volatile.Read(ref failure);
            return handle == 0 ? null : (Exception?)GCHandle.FromIntPtr(handle).Target;
        }
    }

    public TaskStackWorker* GetWorker(int workerIndex)
    {
        if ((uint)workerIndex >= (uint)WorkerCount)
            throw new ArgumentOutOfRangeException(nameof(workerIndex), workerIndex, $"The stack has {WorkerCount} workers.");
        return (TaskStackWorker*)((byte*)Unsafe.AsPointer(ref this) + Size) + workerIndex;
    }

    /// <summary>Lets no further task begin.</summary>
    public void RequestStop() => Interlocked.CompareExchange(ref stop, StopRequested, Going);

    /// <summary>Keeps an exception, if it is the first, and lets no further task begin.</summary>
    public void Fail(Exception exception)
    {
        // It passes several frames on its way out.
        if (Volatile.Read(ref failure) == 0)
        {
            var handle = GCHandle.Alloc(exception);
            if (Interlocked.CompareExchange(ref failure, GCHandle.ToIntPtr(handle), 0) != 0)
                handle.Free();
        }
        Interlocked.Exchange(ref stop, Failed);
    }

    /// <summary>Makes ready for new tasks. Only while no worker uses the stack.</summary>
    public void Restart()
    {
        if (failure != 0)
            GCHandle.FromIntPtr(failure).Free();
        failure = 0;
        Newest = null;
        Volatile.Write(ref stop, Going);
    }
}
