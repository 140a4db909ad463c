using System;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// Columns: one body on the other, so that each patch knows the one below and the one above alone. A sweep there and back says which contacts bear and where
// friction holds. With that known what is left is a system of equations whose blocks lie along a line, and which is solved at once, in as many operations as
// there are bodies (subspace minimization: Silcowitz, Niebuhr and Erleben, Projected Gauss-Seidel subspace minimization method for interactive rigid body
// dynamics, 2010). Sweeps alone take of the order of n^4 rounds for n bodies, and of n^2 with conjugate directions.
readonly unsafe ref partial struct LoadRelaxation
{
    // Rounds of a sweep and a solution: what sways takes two or three.
    const int MaximumColumnRounds = 8;
    // Solutions of a round. After each the rows that are farthest beyond their bounds are put there, and are no longer free.
    const int MaximumSolutions = 13;
    // Part of the greatest excess that is put to its bound with it. Were all, the column would be cut in more places than it opens.
    const double ExcessShare = 0.5;
    // Part of its limit up to which friction holds.
    const float HoldingShare = 0.999f;

    /// <summary>Relaxes a column.</summary>
    /// <param name="blocks">Room for one per body.</param>
    internal void RunColumn(Span<ColumnBlock> blocks)
    {
        for (int i = 0; i < patches.Length; ++i)
            Prepare(i);
        OrderUpwards(blocks);
        fixed (ColumnBlock* column = blocks)
        {
            for (int i = 0; i < blocks.Length; ++i)
                DescribeRows(ref column[i]);
            for (int i = 0; i < blocks.Length; ++i)
                FindResponses(column, i, blocks.Length);
            float first = 0;
            for (int round = 0; ; ++round)
            {
                var change = Sweep(column, blocks.Length);
                if (round == 0)
                    first = change;
                if (round == MaximumColumnRounds || !(change > LeastChange * first) || !Minimize(column, blocks.Length))
                    break;
            }
        }
    }

    // There and back. Says what that has changed.
    [MethodImpl(MethodImplOptions.NoInlining)]
    float Sweep(ColumnBlock* column, int count)
    {
        for (int i = 0; i < patches.Length; ++i)
            patches[i].Start = supports[i].Present;
        for (int i = count - 1; i >= 0; --i)
            Solve(column[i].SupportIndex);
        for (int i = 0; i < count; ++i)
            Solve(column[i].SupportIndex);
        return Change();
    }

    void OrderUpwards(Span<ColumnBlock> blocks)
    {
        Span<int> above = stackalloc int[SupportGraph.MaximumColumn];
        int patch = 0;
        for (int i = 0; i < patches.Length; ++i)
        {
            if (patches[i].Lower < 0)
                patch = i;
            else
                above[patches[i].Lower] = i;
        }
        for (int i = 0; i < blocks.Length; ++i)
        {
            blocks[i].SupportIndex = patch;
            patch = above[patches[patch].Upper];
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void DescribeRows(ref ColumnBlock block)
    {
        ref var patch = ref patches[block.SupportIndex];
        ref var support = ref supports[block.SupportIndex];
        for (int i = 0; i < ColumnBlock.Friction; ++i)
        {
            var bears = Bears(support, i);
            block.SetRow(i, bears ? support.Normal : default, bears ? support.Arms[i] : default, support.ToLower);
        }
        block.SetRow(ColumnBlock.Friction, patch.X, support.Center, support.ToLower);
        block.SetRow(ColumnBlock.Friction + 1, patch.Y, support.Center, support.ToLower);
        block.SetTwist(support.Normal);
    }

    static bool Bears(in LoadSupport support, int contact) => contact < support.Count && (support.Open & 1 << contact) == 0;

    [MethodImpl(MethodImplOptions.NoInlining)]
    void FindResponses(ColumnBlock* column, int index, int count)
    {
        ref var patch = ref patches[column[index].SupportIndex];
        var lower = patch.Lower < 0 ? default : inertias[nodes[patch.Lower].Body];
        column[index].FindResponses(inertias[nodes[patch.Upper].Body], lower, index + 1 < count ? column + index + 1 : null);
    }

    // Of the impulses that are within their bounds those that lower the energy most, where the others stay as they are or come to theirs. Says whether any do.
    [MethodImpl(MethodImplOptions.NoInlining)]
    bool Minimize(ColumnBlock* column, int count)
    {
        for (int i = 0; i < count; ++i)
            FindFree(ref column[i]);
        for (int solution = 1; ; ++solution)
        {
            ColumnBlock.Solve(column, count);
            double worst = 0;
            for (int i = 0; i < count; ++i)
                worst = Math.Max(worst, Excess(column[i]));
            var changed = false;
            for (int i = 0; i < count; ++i)
                changed |= Bound(ref column[i], worst * ExcessShare);
            if (!changed || solution == MaximumSolutions)
                break;
        }
        for (int i = 0; i < count; ++i)
            SetDirection(ref column[i]);
        return Go(column, count);
    }

    // What bears is free, and friction below its limit.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void FindFree(ref ColumnBlock block)
    {
        ref var patch = ref patches[block.SupportIndex];
        ref var support = ref supports[block.SupportIndex];
        Read(patch.Upper, out var upper);
        Read(patch.Lower, out var lower);
        block.FindVelocities(upper.Linear - lower.Linear, upper.Angular, lower.Angular);
        block.Free = 0;
        float load = 0, lever = 0;
        for (int i = 0; i < support.Count; ++i)
        {
            if (Bears(support, i) && support.After[i] > 0)
                block.Free |= 1 << i;
            load += support.After[i];
            lever += support.After[i] * Exact.Distance(support.Arms[i], support.Center);
        }
        var limit = support.Friction * load * HoldingShare;
        if (Exact.LengthSquared(support.FrictionAfter) < limit * limit)
            block.Free |= 3 << ColumnBlock.Friction;
        if (MathF.Abs(support.TwistAfter) < support.Friction * lever * HoldingShare)
            block.Free |= 1 << ColumnBlock.Twist;
    }

    // By how much, as an impulse, the free rows of a patch are beyond their bounds.
    [MethodImpl(MethodImplOptions.NoInlining)]
    double Excess(in ColumnBlock block)
    {
        ref var support = ref supports[block.SupportIndex];
        double excess = 0, load = 0;
        for (int i = 0; i < support.Count; ++i)
        {
            var normal = support.After[i] + block.Changes[i];
            if ((block.Free & 1 << i) != 0)
                excess = Math.Max(excess, -normal);
            load += Math.Max(0, normal);
        }
        if ((block.Free & 3 << ColumnBlock.Friction) == 0)
            return excess;
        FrictionOf(block, out var x, out var y);
        return Math.Max(excess, Math.Sqrt(x * x + y * y) - support.Friction * load);
    }

    void FrictionOf(in ColumnBlock block, out double x, out double y)
    {
        ref var patch = ref patches[block.SupportIndex];
        ref var support = ref supports[block.SupportIndex];
        x = Exact.Dot(support.FrictionAfter, patch.X) + block.Changes[ColumnBlock.Friction];
        y = Exact.Dot(support.FrictionAfter, patch.Y) + block.Changes[ColumnBlock.Friction + 1];
    }

    // Puts what is beyond its bound by so much there. Says whether any row is less free than before.
    [MethodImpl(MethodImplOptions.NoInlining)]
    bool Bound(ref ColumnBlock block, double least)
    {
        ref var support = ref supports[block.SupportIndex];
        var free = block.Free;
        double load = 0, lever = 0;
        for (int i = 0; i < support.Count; ++i)
        {
            var normal = support.After[i] + block.Changes[i];
            if ((free & 1 << i) != 0 && normal < 0 && -normal >= least)
            {
                block.Changes[i] = -support.After[i];
                free &= ~(1 << i);
            }
            normal = Math.Max(0, support.After[i] + block.Changes[i]);
            load += normal;
            lever += normal * Exact.Distance(support.Arms[i], support.Center);
        }
        FrictionOf(block, out var x, out var y);
        double limit = support.Friction * load, length = Math.Sqrt(x * x + y * y);
        if (length > limit && ((free & 3 << ColumnBlock.Friction) == 0 || length - limit >= least))
        {
            block.Changes[ColumnBlock.Friction] += x * (limit / length - 1);
            block.Changes[ColumnBlock.Friction + 1] += y * (limit / length - 1);
            free &= ~(3 << ColumnBlock.Friction);
        }
        var twist = support.TwistAfter + block.Changes[ColumnBlock.Twist];
        var bounded = Math.Clamp(twist, -support.Friction * lever, support.Friction * lever);
        if (bounded != twist)
        {
            block.Changes[ColumnBlock.Twist] = bounded - support.TwistAfter;
            free &= ~(1 << ColumnBlock.Twist);
        }
        var changed = free != block.Free;
        block.Free = free;
        return changed;
    }

    // The change as a direction whose end is within all bounds.
    [MethodImpl(MethodImplOptions.NoInlining)]
    void SetDirection(ref ColumnBlock block)
    {
        ref var patch = ref patches[block.SupportIndex];
        ref var support = ref supports[block.SupportIndex];
        ref var direction = ref patch.Direction;
        direction = default;
        float load = 0, lever = 0;
        for (int i = 0; i < support.Count; ++i)
        {
            var normal = MathHelper.Max(0, support.After[i] + (float)block.Changes[i]);
            direction.Normals[i] = normal - support.After[i];
            load += normal;
            lever += normal * Exact.Distance(support.Arms[i], support.Center);
        }
        var friction = support.FrictionAfter +
            patch.X * (float)block.Changes[ColumnBlock.Friction] + patch.Y * (float)block.Changes[ColumnBlock.Friction + 1];
        direction.Friction = LoadTransfer.Limit(friction, support.Friction * load) - support.FrictionAfter;
        var twist = support.Friction * lever;
        direction.Twist = Math.Clamp(support.TwistAfter + (float)block.Changes[ColumnBlock.Twist], -twist, twist) - support.TwistAfter;
    }

    // As far as it lowers the energy: both ends are within all bounds, which are convex. Says whether it does.
    [MethodImpl(MethodImplOptions.NoInlining)]
    bool Go(ColumnBlock* column, int count)
    {
        for (int i = 0; i < count; ++i)
        {
            ref var support = ref supports[column[i].SupportIndex];
            support.Sum(patches[column[i].SupportIndex].Direction, out column[i].Linear, out column[i].Angular);
            if (i == 0)
                continue;
            // What it is for its lower body, which is the upper one of the patch below.
            column[i - 1].Linear -= column[i].Linear;
            column[i - 1].Angular -= column[i].Angular - Exact.Cross(support.ToLower, column[i].Linear);
        }
        float slope = 0, curvature = 0;
        for (int i = 0; i < count; ++i)
        {
            Read(patches[column[i].SupportIndex].Upper, out var body);
            slope += Exact.Dot(body.Linear, column[i].Linear) + Exact.Dot(body.Angular, column[i].Angular);
            curvature += Exact.LengthSquared(column[i].Linear) * body.InverseMass + Exact.Dot(column[i].Angular, body.InverseInertia * column[i].Angular);
        }
        // Not if a number went wrong: the comparison is false then.
        var part = -slope / curvature;
        if (!(part > 0))
            return false;
        part = MathHelper.Min(part, 1);
        for (int i = 0; i < count; ++i)
        {
            ref var patch = ref patches[column[i].SupportIndex];
            ref var support = ref supports[column[i].SupportIndex];
            nodes[patch.Upper].Linear += column[i].Linear * part;
            nodes[patch.Upper].Angular += column[i].Angular * part;
            for (int c = 0; c < support.Count; ++c)
                support.After[c] = MathHelper.Max(0, support.After[c] + patch.Direction.Normals[c] * part);
            support.FrictionAfter += patch.Direction.Friction * part;
            support.TwistAfter += patch.Direction.Twist * part;
        }
        return true;
    }
}
