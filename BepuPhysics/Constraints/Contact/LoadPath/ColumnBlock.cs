using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>A patch of a column: what it takes to solve all patches of the column at once.</summary>
/// <remarks>
/// Its rows are the normals of up to four contacts, friction along two directions and the twist. In double precision: what a column of n bodies does to its
/// momenta has a condition of the order of n^4. Matrices lie column by column, so that what is done to a column is done to all of its rows at once.
/// </remarks>
unsafe struct ColumnBlock
{
    /// <summary>Rows of a patch.</summary>
    internal const int Rows = 7;
    /// <summary>The first row of friction, and that of the twist.</summary>
    internal const int Friction = 4, Twist = 6;
    // Numbers of a row of the Jacobian: direction of the impulse, and its torques about the centres of the upper and the lower body.
    const int Columns = 9;
    // From one column to the next.
    const int Stride = RowDoubles.Count;
    // Part of the diagonal that is added to it: the fourth of four contacts in a plane adds nothing.
    const double Regularization = 1e-9;

    /// <summary>Its place in the order of the island's supports.</summary>
    public int SupportIndex;
    /// <summary>One bit per row that is free to change.</summary>
    public int Free;
    /// <summary>Velocities along the rows; what is to be changed of their impulses.</summary>
    public fixed double Velocities[Stride], Changes[Stride];
    /// <summary>Right side of the system, then its solution.</summary>
    public fixed double Values[Stride];
    /// <summary>The change as it is taken: momentum and angular momentum of the upper body, and what that of the lower one is turned by.</summary>
    public Vector3 Linear, Angular;

    fixed double jacobian[Stride * Columns];
    // Velocities along the rows of this patch, and along those of the one above, by unit impulses of each row.
    fixed double within[Stride * Rows], above[Stride * Rows];
    // Factor of the block, with the inverse of its diagonal, and its coupling with the patch below.
    fixed double factor[Stride * Rows], coupling[Stride * Rows];

    readonly bool IsFree(int row) => (Free & 1 << row) != 0;

    /// <summary>Makes all rows zero.</summary>
    internal void Clear() => new Span<double>(Unsafe.AsPointer(ref jacobian[0]), Stride * Columns).Clear();

    /// <summary>Describes a row: an impulse on the upper body along a direction at an arm about its centre.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal void SetRow(int row, Vector3 direction, Vector3 arm, Vector3 toLower)
    {
        double nx = direction.X, ny = direction.Y, nz = direction.Z, x = arm.X, y = arm.Y, z = arm.Z;
        Set(row, 0, nx, ny, nz);
        Set(row, 3, y * nz - z * ny, z * nx - x * nz, x * ny - y * nx);
        x -= toLower.X;
        y -= toLower.Y;
        z -= toLower.Z;
        Set(row, 6, y * nz - z * ny, z * nx - x * nz, x * ny - y * nx);
    }

    /// <summary>Describes the row of the twist about a normal.</summary>
    internal void SetTwist(Vector3 normal)
    {
        Set(Twist, 3, normal.X, normal.Y, normal.Z);
        Set(Twist, 6, normal.X, normal.Y, normal.Z);
    }

    void Set(int row, int column, double x, double y, double z)
    {
        var at = row + column * Stride;
        jacobian[at] = x;
        jacobian[at + Stride] = y;
        jacobian[at + 2 * Stride] = z;
    }

    /// <summary>Finds what impulses do, once all rows are described.</summary>
    /// <param name="block">The patch.</param>
    /// <param name="upper">Of the upper body.</param>
    /// <param name="lower">Of the lower body; none for what nothing moves.</param>
    /// <param name="next">The patch above, or null.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static void FindResponses(ColumnBlock* block, in BodyInertia upper, in BodyInertia lower, ColumnBlock* next)
    {
        double upperMass = upper.InverseMass, mass = upperMass + lower.InverseMass;
        for (int c = 0; c < Rows; ++c)
        {
            var row = block->jacobian + c;
            double nx = row[0], ny = row[Stride], nz = row[2 * Stride];
            Turn(upper.InverseInertiaTensor, row + 3 * Stride, out var ux, out var uy, out var uz);
            Turn(lower.InverseInertiaTensor, row + 6 * Stride, out var lx, out var ly, out var lz);
            (Dot(block, 0, nx, ny, nz) * mass + Dot(block, 3, ux, uy, uz) + Dot(block, 6, lx, ly, lz)).Store(block->within + c * Stride);
            if (next != null)
                (-(Dot(next, 0, nx, ny, nz) * upperMass + Dot(next, 6, ux, uy, uz))).Store(block->above + c * Stride);
        }
    }

    static void Turn(in Symmetric3x3 inertia, double* row, out double x, out double y, out double z)
    {
        double a = row[0], b = row[Stride], c = row[2 * Stride];
        x = inertia.XX * a + inertia.YX * b + inertia.ZX * c;
        y = inertia.YX * a + inertia.YY * b + inertia.ZY * c;
        z = inertia.ZX * a + inertia.ZY * b + inertia.ZZ * c;
    }

    // Of each row, three of its numbers times a vector.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static RowDoubles Dot(ColumnBlock* block, int column, double x, double y, double z)
    {
        var numbers = block->jacobian + column * Stride;
        return RowDoubles.Load(numbers) * x + RowDoubles.Load(numbers + Stride) * y + RowDoubles.Load(numbers + 2 * Stride) * z;
    }

    /// <summary>Takes the velocities along the rows.</summary>
    /// <param name="block">The patch.</param>
    /// <param name="linear">Velocity of the upper body less that of the lower one.</param>
    /// <param name="upper">Angular velocity of the upper body.</param>
    /// <param name="lower">Angular velocity of the lower body.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static void FindVelocities(ColumnBlock* block, Vector3 linear, Vector3 upper, Vector3 lower)
    {
        (Dot(block, 0, linear.X, linear.Y, linear.Z) + Dot(block, 3, upper.X, upper.Y, upper.Z) - Dot(block, 6, lower.X, lower.Y, lower.Z))
            .Store(block->Velocities);
        default(RowDoubles).Store(block->Changes);
    }

    /// <summary>Changes of all rows of a column that are free, such that nothing moves along them, beside those of the others, which are given.</summary>
    internal static void Solve(ColumnBlock* column, int count)
    {
        for (int i = 0; i < count; ++i)
        {
            SetGoal(column, i, count);
            Factorize(column + i, i > 0 ? column + i - 1 : null);
        }
        for (int i = count - 1; i >= 0; --i)
            Substitute(column + i, i + 1 < count ? column + i + 1 : null);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void SetGoal(ColumnBlock* column, int index, int count)
    {
        var block = column + index;
        var below = index > 0 ? block - 1 : null;
        var next = index + 1 < count ? block + 1 : null;
        var goal = -RowDoubles.Load(block->Velocities);
        var row = stackalloc double[Stride];
        row[Rows] = 0;
        for (int c = 0; c < Rows; ++c)
        {
            if (IsGiven(block, c))
                goal -= RowDoubles.Load(block->within + c * Stride) * block->Changes[c];
            if (below != null && IsGiven(below, c))
                goal -= RowDoubles.Load(below->above + c * Stride) * below->Changes[c];
            if (next == null || !IsGiven(next, c))
                continue;
            // What a row above does to those here is what each of these does to it.
            for (int r = 0; r < Rows; ++r)
                row[r] = block->above[r * Stride + c];
            goal -= RowDoubles.Load(row) * next->Changes[c];
        }
        (goal & RowDoubles.Mask(block->Free)).Store(block->Values);
    }

    static bool IsGiven(ColumnBlock* block, int row) => !block->IsFree(row) && block->Changes[row] != 0;

    // The next block of the factor, and of the solution of its lower triangle.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Factorize(ColumnBlock* block, ColumnBlock* below)
    {
        var free = RowDoubles.Mask(block->Free);
        var goal = RowDoubles.Load(block->Values);
        double* coupling = block->coupling, factor = block->factor;
        for (int c = 0; below != null && c < Rows; ++c)
        {
            var sum = below->IsFree(c) ? RowDoubles.Load(below->above + c * Stride) & free : default;
            for (int k = 0; k < c; ++k)
                sum -= RowDoubles.Load(coupling + k * Stride) * below->factor[k * Stride + c];
            sum *= below->factor[c * Stride + c];
            sum.Store(coupling + c * Stride);
            goal -= sum * below->Values[c];
        }
        goal.Store(block->Values);
        for (int c = 0; c < Rows; ++c)
        {
            var isFree = block->IsFree(c);
            var sum = isFree ? RowDoubles.Load(block->within + c * Stride) & free : default;
            for (int k = 0; below != null && k < Rows; ++k)
                sum -= RowDoubles.Load(coupling + k * Stride) * coupling[k * Stride + c];
            for (int k = 0; k < c; ++k)
                sum -= RowDoubles.Load(factor + k * Stride) * factor[k * Stride + c];
            var column = factor + c * Stride;
            sum.Store(column);
            var inverse = isFree ? 1 / Math.Sqrt(Math.Max(column[c], 0) + block->within[c * Stride + c] * Regularization) : 1;
            sum *= inverse;
            sum.Store(column);
            column[c] = inverse;
        }
        for (int r = 0; r < Rows; ++r)
        {
            var sum = block->Values[r];
            for (int k = 0; k < r; ++k)
                sum -= factor[k * Stride + r] * block->Values[k];
            block->Values[r] = sum * factor[r * Stride + r];
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Substitute(ColumnBlock* block, ColumnBlock* next)
    {
        for (int r = Rows - 1; r >= 0; --r)
        {
            var sum = block->Values[r];
            for (int k = 0; next != null && k < Rows; ++k)
                sum -= next->coupling[r * Stride + k] * next->Values[k];
            for (int k = r + 1; k < Rows; ++k)
                sum -= block->factor[r * Stride + k] * block->Values[k];
            block->Values[r] = sum * block->factor[r * Stride + r];
            if (block->IsFree(r))
                block->Changes[r] = block->Values[r];
        }
    }
}
