using System;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>
/// The state of a simulation between two steps, by which it, or another one, can go on from there as if nothing had been: bit for bit, for any
/// number of threads.
/// </summary>
/// <remarks>
/// <para>
/// It holds bodies, statics and constraints with their handles, what sleeps, contacts and what is remembered of them, layers, listeners and sensors, and the
/// settings of the solver; also the handles that will be given out next. It does not hold shapes, which stay where they are and must not be removed while a
/// snapshot needs them, nor what belongs to the game: callbacks, <see cref="CollidableProperty{T}"/>, events that were told.
/// </para>
/// <para>
/// <see cref="Simulation.Save"/> and <see cref="Simulation.Restore"/> copy memory and take none from the system once there is room for the largest state;
/// <see cref="ByteCount"/> says how much one took.
/// </para>
/// </remarks>
public sealed class SimulationSnapshot : IDisposable, IBufferPoolUser
{
    const ulong Magic = 0x746F_6F74_6269_7264;
    // Of what is saved, and in which order.
    const int Format = 1;

    [StructLayout(LayoutKind.Sequential)]
    struct Header
    {
        public ulong Magic;
        public ulong Hash;
        public int Format;
        public int Lanes;
        public long Length;
    }

    readonly BufferPool pool;
    bool hasEnded;

    /// <summary>Makes a snapshot that holds nothing yet.</summary>
    /// <param name="pool">Where its memory comes from; that of the simulation, or any other.</param>
    public SimulationSnapshot(BufferPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        this.pool = pool;
        Copy = new StateCopy(pool);
        pool.AddUser(this);
    }

    internal StateCopy Copy { get; }

    /// <summary>Bytes of the state that it holds; zero if it holds none.</summary>
    public int ByteCount => Copy.Length;

    /// <summary>Bytes that <see cref="WriteTo"/> writes.</summary>
    public unsafe int SerializedByteCount => sizeof(Header) + ByteCount;

    /// <summary>Writes the state in a form that <see cref="ReadFrom"/> takes, in this process or another one.</summary>
    /// <param name="target">At least <see cref="SerializedByteCount"/> bytes.</param>
    /// <exception cref="ArgumentException">There is no room for it; nothing was written.</exception>
    /// <exception cref="InvalidOperationException">The snapshot holds nothing.</exception>
    public unsafe void WriteTo(Span<byte> target)
    {
        CheckFilled();
        if (target.Length < SerializedByteCount)
            throw new ArgumentException($"There are {target.Length} bytes for a snapshot of {SerializedByteCount}.", nameof(target));
        var header = new Header { Magic = Magic, Hash = HashOf(Copy.Bytes), Format = Format, Lanes = Vector<float>.Count, Length = ByteCount };
        MemoryMarshal.Write(target, header);
        Copy.Bytes.CopyTo(target[sizeof(Header)..]);
    }

    /// <summary>Takes a state that was written by <see cref="WriteTo"/>, in place of what the snapshot holds.</summary>
    /// <param name="source">What was written, to the byte.</param>
    /// <exception cref="ArgumentException">
    /// The bytes are not those of a snapshot, are damaged, or were written by another version of the library or with another width of vectors; the snapshot
    /// holds what it held.
    /// </exception>
    public unsafe void ReadFrom(ReadOnlySpan<byte> source)
    {
        CheckAlive();
        if (source.Length < sizeof(Header) || MemoryMarshal.Read<Header>(source) is not { Magic: Magic } header)
            throw new ArgumentException($"These {source.Length} bytes are no snapshot.", nameof(source));
        if (header.Format != Format)
            throw new ArgumentException($"The snapshot has format {header.Format}; this library reads {Format}.", nameof(source));
        if (header.Lanes != Vector<float>.Count)
        {
            throw new ArgumentException(
                $"The snapshot was written with vectors of {header.Lanes} lanes, and here they have {Vector<float>.Count}.", nameof(source));
        }
        var state = source[sizeof(Header)..];
        if (header.Length != state.Length || header.Hash != HashOf(state))
            throw new ArgumentException("The snapshot is damaged: its bytes are not those that were written.", nameof(source));
        Copy.Load(state);
    }

    static ulong HashOf(ReadOnlySpan<byte> state)
    {
        StateHash hash = default;
        hash.Add(state);
        return hash.Value;
    }

    /// <summary>Refuses a snapshot that holds no state.</summary>
    internal void CheckFilled()
    {
        CheckAlive();
        if (Copy.Length == 0)
            throw new InvalidOperationException("The snapshot holds nothing: save a simulation into it first.");
    }

    internal void CheckAlive() => ObjectDisposedException.ThrowIf(hasEnded, this);

    /// <summary>Returns its memory.</summary>
    public void Dispose()
    {
        if (hasEnded)
            return;
        hasEnded = true;
        Copy.Dispose();
        pool.RemoveUser(this);
    }

    void IBufferPoolUser.CheckNotBusy() { }

    void IBufferPoolUser.ForgetMemory()
    {
        hasEnded = true;
        Copy.Abandon();
    }
}
