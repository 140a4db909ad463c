using System;
using System.Numerics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Numbers points in the order in which they first come; equal ones get the same number. Zero is equal to its negative.</summary>
unsafe ref struct MeshWeld
{
    readonly BufferPool pool;
    // Numbers by hash, plus one, so that zero is an empty place. At least twice as many places as points.
    Buffer<int> table;
    Buffer<Vector3> points;
    int shift;

    public MeshWeld(int expectedCount, BufferPool pool)
    {
        this.pool = pool;
        pool.TakeAtLeast(Math.Max(64, expectedCount), out points);
        CreateTable(points.Length);
    }

    /// <summary>Number of different points.</summary>
    public int Count { get; private set; }

    /// <summary>The points by their numbers.</summary>
    public readonly Vector3* Points => points.Memory;

    /// <summary>Number of a point.</summary>
    public int Add(Vector3 point)
    {
        // Makes one zero of two.
        point += Vector3.Zero;
        var mask = (1 << (64 - shift)) - 1;
        var place = Hash(point);
        for (; table.Memory[place] != 0; place = (place + 1) & mask)
        {
            // Finite numbers, of which only the zeros are equal without being the same.
            if (points.Memory[table.Memory[place] - 1] == point)
                return table.Memory[place] - 1;
        }
        if (Count == points.Length)
        {
            Grow();
            return Add(point);
        }
        points.Memory[Count] = point;
        table.Memory[place] = ++Count;
        return Count - 1;
    }

    readonly int Hash(Vector3 point)
    {
        uint x = BitConverter.SingleToUInt32Bits(point.X), y = BitConverter.SingleToUInt32Bits(point.Y), z = BitConverter.SingleToUInt32Bits(point.Z);
        // Odd constants from the digits of the golden ratio and of the square roots of 2 and 3; the high bits are the mixed ones.
        var key = (x | (ulong)y << 32) * 0x9E3779B97F4A7C15 ^ z * 0x6A09E667F3BCC909ul;
        key = (key ^ key >> 32) * 0xBB67AE8584CAA73B;
        return (int)(key >> shift);
    }

    void Grow()
    {
        pool.Return(ref table);
        pool.ResizeToAtLeast(ref points, checked(2 * Count), Count);
        CreateTable(points.Length);
        var mask = (1 << (64 - shift)) - 1;
        for (int i = 0; i < Count; ++i)
        {
            var place = Hash(points.Memory[i]);
            while (table.Memory[place] != 0)
                place = (place + 1) & mask;
            table.Memory[place] = i + 1;
        }
    }

    void CreateTable(int capacity)
    {
        var power = 1;
        while (1L << power < 2L * capacity)
            ++power;
        pool.Take(1 << power, out table);
        table.Clear(0, table.Length);
        shift = 64 - power;
    }

    public void Dispose()
    {
        pool.ReturnIfTaken(ref table);
        pool.Return(ref points);
    }
}
