using System;
using System.Buffers.Binary;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

// Meshes as bytes.
public unsafe partial struct Mesh
{
    // "TBM2", so that another kind of file, or another form, is told apart.
    const uint Magic = 0x324D4254;
    const int PrefixByteCount = 32;
    const int TwoSidedFlag = 1, SolidFlag = 2;

    /// <summary>Loads a mesh from bytes that <see cref="Serialize"/> wrote, on this or any other machine.</summary>
    /// <remarks>Bytes that were damaged are refused, and nothing outside of them is read. A mesh is loaded as it was built, without building it
    /// again.</remarks>
    /// <param name="data">The bytes; more may follow.</param>
    /// <param name="pool">Source of the mesh's memory.</param>
    /// <exception cref="ArgumentException">The bytes are not those of a mesh; nothing was taken from the pool.</exception>
    public Mesh(ReadOnlySpan<byte> data, BufferPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        if (data.Length < PrefixByteCount + MeshHeader.ByteCount)
            throw new ArgumentException($"A mesh has at least {PrefixByteCount + MeshHeader.ByteCount} bytes; there are {data.Length}.", nameof(data));
        if (BinaryPrimitives.ReadUInt32LittleEndian(data) != Magic)
            throw new ArgumentException($"The bytes do not begin with the mark of a mesh: 0x{BinaryPrimitives.ReadUInt32LittleEndian(data):X8}.", nameof(data));
        var header = MemoryMarshal.Read<MeshHeader>(data[PrefixByteCount..]);
        var byteCount = MeshCheck.ByteCount(header);
        if (byteCount < 0 || byteCount > data.Length - PrefixByteCount)
            throw new ArgumentException($"The mesh says that it has {byteCount} bytes; there are {data.Length - PrefixByteCount}.", nameof(data));
        data = data[..(PrefixByteCount + (int)byteCount)];
        if (BinaryPrimitives.ReadUInt64LittleEndian(data[4..]) != Hash(data))
            throw new ArgumentException("The mesh is damaged: its bytes do not have the hash that was written with them.", nameof(data));
        scale = MemoryMarshal.Read<Vector3>(data[12..]);
        MeshBuilder.CheckScale(scale);
        twoSided = (data[24] & TwoSidedFlag) != 0;
        pool.Take(data.Length - PrefixByteCount, out this.data);
        data[PrefixByteCount..].CopyTo(this.data.AsSpan());
        if (MeshCheck.FindFault(Header) is { } fault)
        {
            pool.Return(ref this.data);
            throw new ArgumentException($"The mesh is damaged: {fault}.", nameof(data));
        }
        solid = (data[24] & SolidFlag) != 0;
        if (solid && !Report.IsClosed)
        {
            pool.Return(ref this.data);
            throw new ArgumentException("The mesh is damaged: it says that it is solid, and is not closed.", nameof(data));
        }
    }

    /// <summary>Number of bytes that <see cref="Serialize"/> writes.</summary>
    public readonly int GetSerializedByteCount() => checked(PrefixByteCount + data.Length);

    /// <summary>Writes the mesh as bytes, the same on every machine.</summary>
    /// <param name="data">Receives the bytes; at least <see cref="GetSerializedByteCount"/>.</param>
    /// <exception cref="ArgumentException">There is no room, or the mesh has no memory.</exception>
    public readonly void Serialize(Span<byte> data)
    {
        Validate();
        var byteCount = GetSerializedByteCount();
        if (data.Length < byteCount)
            throw new ArgumentException($"The mesh takes {byteCount} bytes; there is room for {data.Length}.", nameof(data));
        data = data[..byteCount];
        data[..PrefixByteCount].Clear();
        BinaryPrimitives.WriteUInt32LittleEndian(data, Magic);
        MemoryMarshal.Write(data[12..], scale);
        data[24] = (byte)((twoSided ? TwoSidedFlag : 0) | (solid ? SolidFlag : 0));
        this.data.AsSpan().CopyTo(data[PrefixByteCount..]);
        BinaryPrimitives.WriteUInt64LittleEndian(data[4..], Hash(data));
    }

    // Of all that follows it, and the mark.
    static ulong Hash(ReadOnlySpan<byte> data)
    {
        var hash = new StateHash();
        hash.Add(MemoryMarshal.Read<uint>(data));
        hash.Add(data[12..]);
        return hash.Value;
    }
}
