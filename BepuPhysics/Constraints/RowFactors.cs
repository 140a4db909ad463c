using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Factors a symmetric positive semidefinite block of two rows as L D L^T.</summary>
/// <remarks>
/// Angular rows need more than an inverse by cofactors. A body that is locked about one or two axes, which games do, has an inverse inertia
/// of rank 2 or 1, and K gets the same rank where nothing else turns. Exactly singular, a cofactor inverse gives up all rows; rotated into
/// the world the block is singular but for rounding, and that inverse is noise times any number. Here a pivot that is no more than
/// rounding is dropped: its row asks for something that no impulse can change, and the other rows are solved as if it were not there.
/// </remarks>
readonly struct RowFactor2
{
    /// <summary>Pivots below this part of the trace are rounding: some times 2^-24, for the rotation, the sum and the elimination.</summary>
    internal const float LeastRelativePivot = 1f / (1 << 20);

    readonly Vector<float> inverseX, inverseY;
    readonly Vector<float> yx;

    /// <summary>Factors a matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal RowFactor2(in Symmetric2x2Wide m)
    {
        var least = (m.XX + m.YY) * new Vector<float>(LeastRelativePivot);
        inverseX = Invert(m.XX, least);
        yx = m.YX * inverseX;
        inverseY = Invert(m.YY - yx * m.YX, least);
    }

    /// <summary>The reciprocal of a pivot; zero for one that is dropped.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> Invert(Vector<float> pivot, Vector<float> least) =>
        Wide.Mask(Vector.GreaterThan(pivot, least), Vector<float>.One / pivot);

    /// <summary>A solution of the rows that were not dropped.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal Vector2Wide Solve(in Vector2Wide v)
    {
        var y = (v.Y - yx * v.X) * inverseY;
        return new(v.X * inverseX - yx * y, y);
    }
}

/// <summary>Factors a symmetric positive semidefinite block of three rows as L D L^T; see <see cref="RowFactor2"/>.</summary>
readonly struct RowFactor3
{
    readonly Vector<float> inverseX, inverseY, inverseZ;
    readonly Vector<float> yx, zx, zy;

    /// <summary>Factors a matrix.</summary>
    /// <param name="m">The matrix.</param>
    /// <param name="scale">Trace of what the matrix was before anything was subtracted from it: its rounding is a part of that.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal RowFactor3(in Symmetric3x3Wide m, Vector<float> scale)
    {
        var least = scale * new Vector<float>(RowFactor2.LeastRelativePivot);
        inverseX = RowFactor2.Invert(m.XX, least);
        yx = m.YX * inverseX;
        zx = m.ZX * inverseX;
        inverseY = RowFactor2.Invert(m.YY - yx * m.YX, least);
        var remainderZY = m.ZY - zx * m.YX;
        zy = remainderZY * inverseY;
        inverseZ = RowFactor2.Invert(m.ZZ - zx * m.ZX - zy * remainderZY, least);
    }

    /// <summary>A solution of the rows that were not dropped.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal Vector3Wide Solve(in Vector3Wide v)
    {
        var forwardY = v.Y - yx * v.X;
        var z = (v.Z - zx * v.X - zy * forwardY) * inverseZ;
        var y = forwardY * inverseY - zy * z;
        return new(v.X * inverseX - yx * y - zx * z, y, z);
    }

    /// <summary>Sum of the diagonal.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> Trace(in Symmetric3x3Wide m) => m.XX + m.YY + m.ZZ;
}
