using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>A patch of a column: what it takes to solve all patches of the column at once.</summary>
/// <remarks>
/// Its rows are the normals of up to four contacts, friction along two directions and the twist. In double precision: what a column of n bodies does to its
/// momenta has a condition of the order of n^4.
/// </remarks>
unsafe struct ColumnBlock
{
    /// <summary>Rows of a patch.</summary>
    internal const int Rows = 7;
    /// <summary>The first row of friction, and that of the twist.</summary>
    internal const int Friction = 4, Twist = 6;
    // Numbers of a row of the Jacobian: direction of the impulse, and its torques about the centres of the upper and the lower body.
    const int Columns = 9;
    // Part of the diagonal that is added to it: the fourth of four contacts in a plane adds nothing.
    const double Regularization = 1e-9;

    /// <summary>Its place in the order of the island's supports.</summary>
    public int SupportIndex;
    /// <summary>One bit per row that is free to change.</summary>
    public int Free;
    /// <summary>Velocities along the rows; what is to be changed of their impulses.</summary>
    public fixed double Velocities[Rows], Changes[Rows];
    /// <summary>Right side of the system, then its solution.</summary>
    public fixed double Values[Rows];
    /// <summary>The change as it is taken: momentum and angular momentum of the upper body, and what that of the lower one is turned by.</summary>
    public Vector3 Linear, Angular;

    fixed double jacobian[Rows * Columns];
    // Velocities along the rows of this patch, and along those of the one above, by unit impulses of each row.
    fixed double within[Rows * Rows], above[Rows * Rows];
    // Factor of the block, with the inverse of its diagonal, and its coupling with the patch below.
    fixed double factor[Rows * Rows], coupling[Rows * Rows];

    readonly bool IsFree(int row) => (Free & 1 << row) != 0;

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
        Set(Twist, 0, 0, 0, 0);
        Set(Twist, 3, normal.X, normal.Y, normal.Z);
        Set(Twist, 6, normal.X, normal.Y, normal.Z);
    }

    void Set(int row, int column, double x, double y, double z)
    {
        var at = row * Columns + column;
        jacobian[at] = x;
        jacobian[at + 1] = y;
        jacobian[at + 2] = z;
    }

    /// <summary>Finds what impulses do, once all rows are described.</summary>
    /// <param name="upper">Of the upper body.</param>
    /// <param name="lower">Of the lower body; none for what nothing moves.</param>
    /// <param name="next">The patch above, or null.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal void FindResponses(in BodyInertia upper, in BodyInertia lower, ColumnBlock* next)
    {
        double upperMass = upper.InverseMass, mass = upperMass + lower.InverseMass;
        for (int c = 0; c < Rows; ++c)
        {
            var at = c * Columns;
            double nx = jacobian[at], ny = jacobian[at + 1], nz = jacobian[at + 2];
            Turn(upper.InverseInertiaTensor, at + 3, out var ux, out var uy, out var uz);
            Turn(lower.InverseInertiaTensor, at + 6, out var lx, out var ly, out var lz);
            for (int r = c; r < Rows; ++r)
            {
                within[r * Rows + c] = within[c * Rows + r] =
                    Dot(r, 0, nx, ny, nz) * mass + Dot(r, 3, ux, uy, uz) + Dot(r, 6, lx, ly, lz);
            }
            for (int r = 0; next != null && r < Rows; ++r)
                above[r * Rows + c] = -(next->Dot(r, 0, nx, ny, nz) * upperMass + next->Dot(r, 6, ux, uy, uz));
        }
    }

    readonly void Turn(in Symmetric3x3 inertia, int at, out double x, out double y, out double z)
    {
        double a = jacobian[at], b = jacobian[at + 1], c = jacobian[at + 2];
        x = inertia.XX * a + inertia.YX * b + inertia.ZX * c;
        y = inertia.YX * a + inertia.YY * b + inertia.ZY * c;
        z = inertia.ZX * a + inertia.ZY * b + inertia.ZZ * c;
    }

    readonly double Dot(int row, int column, double x, double y, double z)
    {
        var at = row * Columns + column;
        return jacobian[at] * x + jacobian[at + 1] * y + jacobian[at + 2] * z;
    }

    /// <summary>Takes the velocities along the rows.</summary>
    /// <param name="linear">Velocity of the upper body less that of the lower one.</param>
    /// <param name="upper">Angular velocity of the upper body.</param>
    /// <param name="lower">Angular velocity of the lower body.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal void FindVelocities(Vector3 linear, Vector3 upper, Vector3 lower)
    {
        for (int r = 0; r < Rows; ++r)
        {
            Velocities[r] = Dot(r, 0, linear.X, linear.Y, linear.Z) + Dot(r, 3, upper.X, upper.Y, upper.Z) - Dot(r, 6, lower.X, lower.Y, lower.Z);
            Changes[r] = 0;
        }
    }

    /// <summary>Changes of all rows of a column that are free, such that nothing moves along them, beside those of the others, which are given.</summary>
    internal static void Solve(ColumnBlock* column, int count)
    {
        for (int i = 0; i < count; ++i)
        {
            SetGoal(column, i, count);
            column[i].Factorize(i > 0 ? column + i - 1 : null);
        }
        for (int i = count - 1; i >= 0; --i)
            column[i].Substitute(i + 1 < count ? column + i + 1 : null);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void SetGoal(ColumnBlock* column, int index, int count)
    {
        ref var block = ref column[index];
        for (int r = 0; r < Rows; ++r)
            block.Values[r] = -block.Velocities[r];
        for (int c = 0; c < Rows; ++c)
        {
            if (!block.IsFree(c) && block.Changes[c] != 0)
            {
                for (int r = 0; r < Rows; ++r)
                    block.Values[r] -= block.within[r * Rows + c] * block.Changes[c];
            }
            if (index > 0 && !column[index - 1].IsFree(c) && column[index - 1].Changes[c] != 0)
            {
                for (int r = 0; r < Rows; ++r)
                    block.Values[r] -= column[index - 1].above[r * Rows + c] * column[index - 1].Changes[c];
            }
            if (index + 1 < count && !column[index + 1].IsFree(c) && column[index + 1].Changes[c] != 0)
            {
                for (int r = 0; r < Rows; ++r)
                    block.Values[r] -= block.above[c * Rows + r] * column[index + 1].Changes[c];
            }
        }
        for (int r = 0; r < Rows; ++r)
            block.Values[r] = block.IsFree(r) ? block.Values[r] : 0;
    }

    // The next block of the factor, and of the solution of its lower triangle.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void Factorize(ColumnBlock* below)
    {
        for (int r = 0; below != null && r < Rows; ++r)
        {
            for (int c = 0; c < Rows; ++c)
            {
                var sum = IsFree(r) && below->IsFree(c) ? below->above[r * Rows + c] : 0;
                for (int k = 0; k < c; ++k)
                    sum -= coupling[r * Rows + k] * below->factor[c * Rows + k];
                coupling[r * Rows + c] = sum * below->factor[c * Rows + c];
            }
        }
        for (int r = 0; r < Rows; ++r)
        {
            for (int c = 0; c <= r; ++c)
            {
                var sum = IsFree(r) && IsFree(c) ? within[r * Rows + c] : 0;
                for (int k = 0; below != null && k < Rows; ++k)
                    sum -= coupling[r * Rows + k] * coupling[c * Rows + k];
                for (int k = 0; k < c; ++k)
                    sum -= factor[r * Rows + k] * factor[c * Rows + k];
                if (c < r)
                    factor[r * Rows + c] = sum * factor[c * Rows + c];
                else
                    factor[r * Rows + r] = IsFree(r) ? 1 / Math.Sqrt(Math.Max(sum, 0) + within[r * Rows + r] * Regularization) : 1;
            }
        }
        for (int r = 0; r < Rows; ++r)
        {
            var sum = Values[r];
            for (int k = 0; below != null && k < Rows; ++k)
                sum -= coupling[r * Rows + k] * below->Values[k];
            for (int k = 0; k < r; ++k)
                sum -= factor[r * Rows + k] * Values[k];
            Values[r] = sum * factor[r * Rows + r];
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void Substitute(ColumnBlock* next)
    {
        for (int k = 0; next != null && k < Rows; ++k)
        {
            for (int r = 0; r < Rows; ++r)
                Values[r] -= next->coupling[k * Rows + r] * next->Values[k];
        }
        for (int r = Rows - 1; r >= 0; --r)
        {
            var sum = Values[r];
            for (int k = r + 1; k < Rows; ++k)
                sum -= factor[k * Rows + r] * Values[k];
            Values[r] = sum * factor[r * Rows + r];
            if (IsFree(r))
                Changes[r] = Values[r];
        }
    }
}
