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
sealed class WakeSignal : IDisposable
{
    const int Idle = 0;
    const int Parked = 1;
    const int Sent = 2;

    // One SpinWait iteration is normalised to about 37 ns by the runtime: 8 of them 50 times are about 15 microseconds. Waking a
    // parked thread costs about as much, so this is at most twice the cost of the better choice.
    const int SpinRounds = 50;
    const int SpinIterationsPerRound = 8;

    readonly AutoResetEvent wake = new(false);
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
        // On a single processor nobody can send while this thread spins.
        for (int i = Environment.ProcessorCount > 1 ? SpinRounds : 0; i > 0 && Volatile.Read(ref state.Value) != Sent; --i)
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
