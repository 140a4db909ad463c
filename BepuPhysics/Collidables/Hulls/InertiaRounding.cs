using System;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>Rounds an inverse inertia tensor to floats so that its small moments survive.</summary>
/// <remarks>
/// A rod of 1:1,000 turns a million times as easily about its axis as across it. At an angle to the axes of the frame every entry is then as large as
/// the first, and rounding each to its nearest float leaves the second 5 % off, at 1:3,000 of the wrong sign. But there are many floats nearly as
/// near, and the large moment may be off by its own small part. What counts is the error relative to the tensor: with T = L L^T the tensor
/// and E the error, the matrix L^-1 E L^-T. Its six entries are linear in the steps by which the six floats are moved, so the steps that are sought
/// are those to the point of a lattice in six dimensions that is nearest to a given point. They are found nearly: a reduced basis (Lenstra,
/// Lenstra and Lovasz 1982) and the nearest plane of each dimension in turn (Babai 1986).
/// </remarks>
static class InertiaRounding
{
    /// <summary>Greatest relative error that leaves each entry at its nearest float.</summary>
    const double Negligible = 2e-3;
    const int Attempts = 4;
    const double AttemptStep = 2e-4;
    const int Size = 6;

    /// <summary>Rounds a tensor.</summary>
    /// <param name="inverse">A positive definite tensor.</param>
    /// <param name="rounded">Floats that stand for it; zeros stay zeros.</param>
    /// <returns>Bound on the error of v.T.v, relative, for any v; infinite when the tensor is not positive definite to a double's precision.</returns>
    public static double Round(in InertiaTensor inverse, out Symmetric3x3 rounded)
    {
        ReadOnlySpan<double> tensor = [inverse.XX, inverse.YX, inverse.YY, inverse.ZX, inverse.ZY, inverse.ZZ];
        Span<float> entries = stackalloc float[Size];
        for (int i = 0; i < Size; ++i)
            entries[i] = (float)tensor[i];
        var error = double.PositiveInfinity;
        if (Root.TryCreate(tensor, out var root))
        {
            Span<double> whitened = stackalloc double[Size];
            error = Error(root, tensor, 1, entries, whitened);
            // Where steps lead into the floats of half or double the spacing they are no good: another target near by has others.
            for (int attempt = 0; error > Negligible && attempt < Attempts; ++attempt)
                Refine(root, tensor, 1 + attempt * AttemptStep, entries, ref error);
        }
        rounded = new(entries[0], entries[1], entries[2], entries[3], entries[4], entries[5]);
        return error;
    }

    static void Refine(in Root root, ReadOnlySpan<double> tensor, double scale, Span<float> entries, ref double error)
    {
        Span<double> memory = stackalloc double[Lattice.MemoryLength];
        var lattice = new Lattice(memory);
        Span<double> vector = stackalloc double[Size];
        for (int i = 0; i < Size; ++i)
        {
            // No step for what is zero by symmetry.
            if (entries[i] == 0)
                continue;
            vector.Clear();
            vector[i] = Spacing(entries[i]);
            root.Whiten(vector);
            lattice.Add(vector, i);
        }
        Span<double> steps = stackalloc double[Size];
        lattice.Reduce();
        Error(root, tensor, scale, entries, vector);
        lattice.FindNearest(vector, steps);
        Span<float> moved = stackalloc float[Size];
        for (int i = 0; i < Size; ++i)
            moved[i] = (float)(entries[i] - steps[i] * Spacing(entries[i]));
        var movedError = Error(root, tensor, 1, moved, vector);
        if (!(movedError < error))
            return;
        moved.CopyTo(entries);
        error = movedError;
    }

    // To the next float away from zero.
    static double Spacing(float value) => (double)MathF.BitIncrement(MathF.Abs(value)) - MathF.Abs(value);

    static double Error(in Root root, ReadOnlySpan<double> tensor, double scale, ReadOnlySpan<float> entries, Span<double> whitened)
    {
        var sum = 0.0;
        for (int i = 0; i < Size; ++i)
            whitened[i] = entries[i] - tensor[i] * scale;
        root.Whiten(whitened);
        for (int i = 0; i < Size; ++i)
            sum += whitened[i] * whitened[i];
        return Math.Sqrt(sum);
    }

    /// <summary>The inverse of the lower triangular root of the tensor.</summary>
    readonly struct Root(double xx, double yx, double yy, double zx, double zy, double zz)
    {
        public static bool TryCreate(ReadOnlySpan<double> t, out Root root)
        {
            var a = Math.Sqrt(t[0]);
            double b = t[1] / a, d = t[3] / a;
            var c = Math.Sqrt(t[2] - b * b);
            var e = (t[4] - d * b) / c;
            var f = Math.Sqrt(t[5] - d * d - e * e);
            double xx = 1 / a, yy = 1 / c, zz = 1 / f;
            root = new(xx, -b * xx * yy, yy, (b * e * yy - d) * xx * zz, -e * yy * zz, zz);
            return double.IsFinite(xx) && double.IsFinite(yy) && double.IsFinite(zz);
        }

        /// <summary>Entries of a symmetric matrix E to those of L^-1 E L^-T, so that the sum of their squares is that of the matrix.</summary>
        public void Whiten(Span<double> e)
        {
            // Rows of L^-1 E, as far as they are needed.
            double x0 = xx * e[0];
            double y0 = yx * e[0] + yy * e[1], y1 = yx * e[1] + yy * e[2];
            double z0 = zx * e[0] + zy * e[1] + zz * e[3], z1 = zx * e[1] + zy * e[2] + zz * e[4], z2 = zx * e[3] + zy * e[4] + zz * e[5];
            // Entries off the diagonal stand for two.
            var twice = Math.Sqrt(2);
            e[0] = x0 * xx;
            e[1] = y0 * xx * twice;
            e[2] = y0 * yx + y1 * yy;
            e[3] = z0 * xx * twice;
            e[4] = (z0 * yx + z1 * yy) * twice;
            e[5] = z0 * zx + z1 * zy + z2 * zz;
        }
    }
}
