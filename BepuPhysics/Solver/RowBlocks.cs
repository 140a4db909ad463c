using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Keeps blocks of K that are singular in truth from becoming arbitrary in floats.</summary>
// The linear rows of a point joint have at least the sum of the inverse masses on their diagonal. Angular rows have nothing of the kind:
// a body that is locked about one or two axes, which games do, has an inverse inertia of rank 2 or 1. Exactly singular it would be given
// up as a whole (inverse 0); rotated into the world it is singular but for rounding, and its inverse is noise times ten million.
// A millionth of the trace on the diagonal is ten times the rounding. Where K is zero it adds zero.
// Where K is regular it makes a row softer by a millionth times the spread of the inverse inertias: 0.03 % for a 2 m rod of 10 cm.
static class RowBlocks
{
    const float RelativeFirmness = 1f / (1 << 20);

    /// <summary>A 2 x 2 block of angular rows, fit for inversion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Symmetric2x2Wide Firm(in Symmetric2x2Wide m) =>
        Symmetric2x2Wide.AddDiagonal(m, (m.XX + m.YY) * new Vector<float>(RelativeFirmness));

    /// <summary>A 3 x 3 block of angular rows, fit for inversion.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Symmetric3x3Wide Firm(in Symmetric3x3Wide m) =>
        Symmetric3x3Wide.AddDiagonal(m, (m.XX + m.YY + m.ZZ) * new Vector<float>(RelativeFirmness));
}
