using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuUtilities;

/// <summary>
/// Eight wide values, one per float of a 32-byte row: field k holds float k of every lane's row. See <see cref="Transpose"/>.
/// </summary>
public struct Rows8
{
    /// <summary>First float of each lane's row.</summary>
    public Vector<float> R0;
    /// <summary>Second float of each lane's row.</summary>
    public Vector<float> R1;
    /// <summary>Third float of each lane's row.</summary>
    public Vector<float> R2;
    /// <summary>Fourth float of each lane's row.</summary>
    public Vector<float> R3;
    /// <summary>Fifth float of each lane's row.</summary>
    public Vector<float> R4;
    /// <summary>Sixth float of each lane's row.</summary>
    public Vector<float> R5;
    /// <summary>Seventh float of each lane's row.</summary>
    public Vector<float> R6;
    /// <summary>Eighth float of each lane's row.</summary>
    public Vector<float> R7;

    /// <summary>Number of wide values.</summary>
    public const int Count = 8;

    /// <summary>Wide value by index. Takes the address of the struct: the named fields stay in registers, this does not.</summary>
    public Vector<float> this[int index]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        readonly get => Unsafe.Add(ref Unsafe.AsRef(in R0), index);
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        set => Unsafe.Add(ref R0, index) = value;
    }
}
