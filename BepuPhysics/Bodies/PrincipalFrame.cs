using System.Numerics;
using System.Runtime.InteropServices;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>The principal frame of a body's inertia, and what it was found for: a local inertia may be written to at any time.</summary>
/// <param name="toBody">Rotation from the principal frame to the body's.</param>
/// <param name="offDiagonal">Entries YX, ZX and ZY of the tensor.</param>
/// <param name="diagonalKey">A number that stands for the diagonal.</param>
[StructLayout(LayoutKind.Sequential, Size = 32)]
readonly struct PrincipalFrame(Quaternion toBody, Vector3 offDiagonal, float diagonalKey)
{
    readonly Quaternion toBody = toBody;
    readonly Vector3 offDiagonal = offDiagonal;
    readonly float diagonalKey = diagonalKey;

    /// <summary>Stands for the diagonal: the frame depends on its differences. A body's inertia is set as a whole, not to confuse this.</summary>
    internal static Vector<float> DiagonalKey(in Symmetric3x3Wide tensor) =>
        tensor.XX - tensor.YY * new Vector<float>(2.71875f) + tensor.ZZ * new Vector<float>(1.71875f);
}
