using System;
using System.Runtime.InteropServices;
using System.Threading;

namespace BepuUtilities.TaskScheduling;

/// <summary>Lets one thread wait for a word from another: it spins for a moment, since the word often comes at once, then parks.</summary>
/// <remarks>
/// The state tells who is there. A waiter that finds no word within the spin exchanges Idle for Parked and sleeps on the event; a
/// sender exchanges whatever it finds for Sent, and sets the event only when it found Parked. Both are full fences, so one of the two
/// always sees the other, and the event is set exactly as often as it is waited for. A word sent before the wait is kept.
/// </remarks>
/// <param name="sharesProcessors">Whether there are more threads that wait for each other than processors.</param>
sealed class WakeSignal(bool sharesProcessors) : IDisposable
{
    const int Idle = 0;
    const int Parked = 1;
    const int Sent = 2;

    // One SpinWait iteration is normalised to about 37 ns by the runtime: 8 of them 50 times are about 15 microseconds. Waking a
    // parked thread costs 25 to 50. Between two dispatches of a step there are mostly less than 60: so much is waited where each thread has a
    // processor. A thread that waits on one that another needs to get on only keeps it from it.
    const int SpinRounds = 200;
    const int SharedSpinRounds = 50;
    const int SpinIterationsPerRound = 8;

    readonly AutoResetEvent wake = new(false);
    // On a single processor nobody can send while this thread spins.
    readonly int rounds = Environment.ProcessorCount == 1 ? 0 : sharesProcessors ? SharedSpinRounds : SpinRounds;
    State state;

    /// <summary>Sends the word. Each is to be waited for before the next is sent.</summary>
    public void Send()
    {
        if (Interlocked.Exchange(ref state.Value, Sent) == Parked)
            wake.Set();
    }

    /// <summary>Waits until the word is sent, and takes it.</summary>
    public void Wait()
    {
        for (int i = rounds; i > 0 && Volatile.Read(ref state.Value) != Sent; --i)
            Thread.SpinWait(SpinIterationsPerRound);
        if (Volatile.Read(ref state.Value) != Sent && Interlocked.CompareExchange(ref state.Value, Parked, Idle) == Idle)
            wake.WaitOne();
        // Only this thread moves the state away from Sent, and the sender waits for that by other means.
        Volatile.Write(ref state.Value, Idle);
    }

    /// <inheritdoc/>
    public void Dispose() => wake.Dispose();

    /// <summary>Keeps the value off the cache lines of whatever lies beside the signal: waiters read it over and over.</summary>
    [StructLayout(LayoutKind.Explicit, Size = 128)]
    struct State
    {
        [FieldOffset(64)] public int Value;
    }
}
