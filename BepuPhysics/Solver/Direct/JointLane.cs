using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>What all joints of a type have in common.</summary>
readonly struct JointKind
{
    /// <summary>Number of rows.</summary>
    internal readonly int RowCount;
    /// <summary>Number of bodies.</summary>
    internal readonly int BodyCount;
    /// <summary>What bounds the impulse.</summary>
    internal readonly RowLimit Limit;
    /// <summary>A bit for each row that is along a direction.</summary>
    internal readonly int LinearRows;
    /// <summary>Whether rows see linear velocities.</summary>
    internal readonly bool SeesLinear;

    /// <summary>Of a type.</summary>
    internal JointKind(TypeProcessor processor)
    {
        (RowCount, BodyCount, Limit) = (processor.RowCount, processor.BodiesPerConstraint, processor.LimitOf(0));
        SeesLinear = processor.SeesLinear;
        for (int row = 0; row < RowCount; ++row)
            LinearRows |= (processor.IsLinear(row) ? 1 : 0) << row;
    }

    /// <summary>Whether it is a limit, a servo or a motor.</summary>
    internal bool HasBounds => Limit != RowLimit.None;

    /// <summary>Whether any row is along a direction.</summary>
    internal bool HasLinear => LinearRows != 0;

    /// <summary>Whether any row is about an axis.</summary>
    internal bool HasAngular => LinearRows != (1 << RowCount) - 1;
}

/// <summary>The rows of one joint of a bundle, as they are read to solve it at once.</summary>
/// <param name="kind">Its type.</param>
/// <param name="rows">Rows of the bundle.</param>
/// <param name="lane">Its lane.</param>
/// <param name="references">Reference to its first body in the type batch.</param>
/// <param name="targets">What its first row is after; others are <see cref="DirectPlan.MostLanes"/> apart.</param>
readonly ref struct JointLane(in JointKind kind, ReadOnlySpan<ConstraintRowWide> rows, int lane, ref int references, ref double targets)
{
    readonly ReadOnlySpan<ConstraintRowWide> rows = rows;
    /// <summary>Its type.</summary>
    internal readonly JointKind Kind = kind;

    readonly int lane = lane;
    /// <summary>Reference to its first body in the type batch.</summary>
    internal readonly ref int References = ref references;

    readonly ref double targets = ref targets;

    /// <summary>Number of rows.</summary>
    internal int RowCount => rows.Length;

    /// <summary>Number of bodies.</summary>
    internal int BodyCount => Kind.BodyCount;

    /// <summary>What bounds its impulse.</summary>
    internal RowLimit Limit => Kind.Limit;

    /// <summary>Whether a row is along a direction.</summary>
    internal bool IsLinear(int row) => (Kind.LinearRows >> row & 1) != 0;

    /// <summary>Index of one of its bodies in the active set.</summary>
    internal int Body(int slot) => Body(ref References, slot);

    /// <summary>Index in the active set of one of the bodies of a joint.</summary>
    internal static int Body(ref int references, int slot) => Unsafe.Add(ref references, slot * Vector<float>.Count) & EncodedBody.IndexMask;

    /// <summary>What a row is after: J v, m/s or rad/s. May be lessened.</summary>
    internal ref double Target(int row) => ref Unsafe.Add(ref targets, row * DirectPlan.MostLanes);

    /// <summary>Whether it is meant to be as stiff as can be.</summary>
    internal bool IsHard => Lane(rows[0].HardMask) != 0;

    /// <summary>Greatest length of its impulse.</summary>
    internal float MaximumImpulse => Lane(rows[0].MaximumImpulse);

    /// <summary>How far a row is off.</summary>
    internal float PositionError(int row) => Lane(rows[row].PositionError);

    /// <summary>How far the joint is off, along directions and about axes.</summary>
    internal (double Linear, double Angular) Error()
    {
        double linear = 0, angular = 0;
        for (int row = 0; row < RowCount; ++row)
        {
            double off = PositionError(row);
            if (IsLinear(row))
                linear += off * off;
            else
                angular += off * off;
        }
        return (Math.Sqrt(linear), Math.Sqrt(angular));
    }

    /// <summary>What a row is after, before it was lessened.</summary>
    internal float TargetVelocity(int row) => Lane(rows[row].TargetVelocity);

    /// <summary>Impulse of a row.</summary>
    internal float Impulse(int row) => Lane(rows[row].Impulse);

    /// <summary>Softness of a row as a part of its own K.</summary>
    /// <param name="row">The row.</param>
    /// <param name="hardSoftness">That of what is as stiff as can be.</param>
    internal double Softness(int row, double hardSoftness) => Softness(rows, row, lane, hardSoftness);

    /// <summary>Softness of a row of one joint of a bundle.</summary>
    /// <param name="rows">Rows of the bundle.</param>
    /// <param name="row">The row.</param>
    /// <param name="lane">Lane of the joint.</param>
    /// <param name="hardSoftness">That of what is as stiff as can be.</param>
    internal static double Softness(ReadOnlySpan<ConstraintRowWide> rows, int row, int lane, double hardSoftness) => LaneOf(rows[0].HardMask, lane) != 0
        ? hardSoftness
        : LaneOf(rows[row].ImpulseScale, lane) / Math.Max(LaneOf(rows[row].MassScale, lane), LeastMassScale);

    // Of a spring that is so soft that it does nothing.
    const double LeastMassScale = 1e-12;

    /// <summary>The Jacobian of a row by one of its bodies: six numbers, a vector apart.</summary>
    internal ref float Jacobian(int row, int slot) => ref Unsafe.Add(
        ref Unsafe.As<RowJacobianWide, float>(ref Unsafe.AsRef(in rows[row]).Of(slot)), lane);

    /// <summary>Square of the arm at which a row turns a body.</summary>
    internal double ArmSquared(int row, int slot)
    {
        ref var first = ref Jacobian(row, slot);
        double x = Unsafe.Add(ref first, 3 * Vector<float>.Count), y = Unsafe.Add(ref first, 4 * Vector<float>.Count);
        double z = Unsafe.Add(ref first, 5 * Vector<float>.Count);
        return x * x + y * y + z * z;
    }

    /// <summary>What an impulse along a row by itself changes of the row's velocity: the diagonal of J M^-1 J^T.</summary>
    internal double InverseMass(int row, Buffer<BodyInertia> inertias)
    {
        double sum = 0;
        for (int slot = 0; slot < BodyCount; ++slot)
        {
            ref var inertia = ref inertias[Body(slot)];
            ref var inverse = ref inertia.InverseInertiaTensor;
            ref var j = ref Jacobian(row, slot);
            if (Kind.SeesLinear)
                sum += inertia.InverseMass * (Square(j, 0) + Square(j, 1) + Square(j, 2));
            double x = Column(j, 3), y = Column(j, 4), z = Column(j, 5);
            sum += x * x * inverse.XX + y * y * inverse.YY + z * z * inverse.ZZ + 2 * (x * y * inverse.YX + x * z * inverse.ZX + y * z * inverse.ZY);
        }
        return sum;
    }

    static double Column(in float first, int column) => Unsafe.Add(ref Unsafe.AsRef(in first), column * Vector<float>.Count);

    static double Square(in float first, int column) => Column(first, column) * Column(first, column);

    T Lane<T>(in Vector<T> vector) where T : unmanaged => LaneOf(vector, lane);

    /// <summary>A number of one joint of a bundle. By address: an element of a vector is a copy of it otherwise.</summary>
    internal static ref T LaneOf<T>(in Vector<T> vector, int lane) where T : unmanaged => ref GatherScatter.Get(ref Unsafe.AsRef(in vector), lane);
}
