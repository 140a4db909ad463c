using System.Runtime.CompilerServices;

namespace BepuUtilities;

// The names that existing games call, with results in out parameters: forwards to the operations of the other file.
public partial struct Matrix3x3Wide
{
    /// <summary>Rotation matrix of a unit quaternion; the rows are the rotated axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void CreateFromQuaternion(in QuaternionWide q, out Matrix3x3Wide result) => result = FromQuaternion(q);

    /// <summary>Rotation matrix of a unit quaternion; the rows are the rotated axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide CreateFromQuaternion(in QuaternionWide q) => FromQuaternion(q);

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Broadcast(in Matrix3x3 source, out Matrix3x3Wide broadcast) => broadcast = Broadcast(source);

    /// <summary>Fills every lane with one value.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Matrix3x3Wide Broadcast(in Matrix3x3 source) => Lanes.Broadcast<Matrix3x3, Matrix3x3Wide>(source);

    /// <summary>Reads one lane.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void ReadSlot(ref Matrix3x3Wide wide, int slotIndex, out Matrix3x3 narrow) =>
        narrow = Lanes.Read<Matrix3x3, Matrix3x3Wide>(ref wide, slotIndex);
}
