using System;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
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
        Begin();
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
        End();
    }

    // There and back. Says what that has changed.
    [MethodImpl(MethodImplOptions.NoInlining)]
    float Sweep(ColumnBlock* column, int count)
    {
        for (int i = 0; i < count; ++i)
            patches[i].Begin();
        for (int i = count - 1; i >= 0; --i)
            patches[column[i].SupportIndex].Solve(bodies);
        for (int i = 0; i < count; ++i)
            patches[column[i].SupportIndex].Solve(bodies);
        return Change();
    }

    void OrderUpwards(Span<ColumnBlock> blocks)
    {
        Span<int> above = stackalloc int[SupportGraph.MaximumColumn];
        int patch = 0;
        for (int i = 0; i < blocks.Length; ++i)
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
        block.Clear();
        for (int i = 0; i < ColumnBlock.Friction; ++i)
        {
            var bears = Bears(support, i);
            block.SetRow(i, bears ? support.Normal : default, bears ? support.Arms[i] : default, support.ToLower);
        }
        block.SetRow(ColumnBlock.Friction, patch.X.AsVector3(), support.Center, support.ToLower);
        block.SetRow(ColumnBlock.Friction + 1, patch.Y.AsVector3(), support.Center, support.ToLower);
        block.SetTwist(support.Normal);
    }

    static bool Bears(in LoadSupport support, int contact) => contact < support.Count && (support.Open & 1 << contact) == 0;

    [MethodImpl(MethodImplOptions.NoInlining)]
    void FindResponses(ColumnBlock* column, int index, int count)
    {
        ref var patch = ref patches[column[index].SupportIndex];
        ColumnBlock.FindResponses(column + index, InertiaOf(patch.Upper), InertiaOf(patch.Lower), index + 1 < count ? column + index + 1 : null);
    }

    // Of the impulses that are within their bounds those that lower the energy most, where the others stay as they are or come to theirs. Says whether any do.
    [MethodImpl(MethodImplOptions.NoInlining)]
    bool Minimize(ColumnBlock* column, int count)
    {
        for (int i = 0; i < count; ++i)
            FindFree(column + i);
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
    void FindFree(ColumnBlock* block)
    {
        ref var patch = ref patches[block->SupportIndex];
        ref var support = ref supports[block->SupportIndex];
        ref var upper = ref bodies[patch.Upper];
        ref var lower = ref bodies[patch.Lower];
        ColumnBlock.FindVelocities(block, (upper.Linear - lower.Linear).AsVector3(), upper.Angular.AsVector3(), lower.Angular.AsVector3());
        block->Free = 0;
        float load = 0, lever = 0;
        for (int i = 0; i < support.Count; ++i)
        {
            if (Bears(support, i) && patch.Normals[i] > 0)
                block->Free |= 1 << i;
            load += patch.Normals[i];
            lever += patch.Normals[i] * patch.Levers[i];
        }
        var limit = patch.Friction * load * HoldingShare;
        if (patch.Across[0] * patch.Across[0] + patch.Across[1] * patch.Across[1] < limit * limit)
            block->Free |= 3 << ColumnBlock.Friction;
        if (MathF.Abs(patch.Across[2]) < lever * HoldingShare)
            block->Free |= 1 << ColumnBlock.Twist;
    }

    // By how much, as an impulse, the free rows of a patch are beyond their bounds.
    [MethodImpl(MethodImplOptions.NoInlining)]
    double Excess(in ColumnBlock block)
    {
        ref var patch = ref patches[block.SupportIndex];
        double excess = 0, load = 0;
        for (int i = 0; i < ColumnBlock.Friction; ++i)
        {
            var normal = patch.Normals[i] + block.Changes[i];
            if ((block.Free & 1 << i) != 0)
                excess = Math.Max(excess, -normal);
            load += Math.Max(0, normal);
        }
        if ((block.Free & 3 << ColumnBlock.Friction) == 0)
            return excess;
        FrictionOf(block, out var x, out var y);
        return Math.Max(excess, Math.Sqrt(x * x + y * y) - patch.Friction * load);
    }

    void FrictionOf(in ColumnBlock block, out double x, out double y)
    {
        ref var patch = ref patches[block.SupportIndex];
        x = patch.Across[0] + block.Changes[ColumnBlock.Friction];
        y = patch.Across[1] + block.Changes[ColumnBlock.Friction + 1];
    }

    // Puts what is beyond its bound by so much there. Says whether any row is less free than before.
    [MethodImpl(MethodImplOptions.NoInlining)]
    bool Bound(ref ColumnBlock block, double least)
    {
        ref var patch = ref patches[block.SupportIndex];
        var free = block.Free;
        double load = 0, lever = 0;
        for (int i = 0; i < ColumnBlock.Friction; ++i)
        {
            var normal = patch.Normals[i] + block.Changes[i];
            if ((free & 1 << i) != 0 && normal < 0 && -normal >= least)
            {
                block.Changes[i] = -patch.Normals[i];
                free &= ~(1 << i);
            }
            normal = Math.Max(0, patch.Normals[i] + block.Changes[i]);
            load += normal;
            lever += normal * patch.Levers[i];
        }
        FrictionOf(block, out var x, out var y);
        double limit = patch.Friction * load, length = Math.Sqrt(x * x + y * y);
        if (length > limit && ((free & 3 << ColumnBlock.Friction) == 0 || length - limit >= least))
        {
            block.Changes[ColumnBlock.Friction] += x * (limit / length - 1);
            block.Changes[ColumnBlock.Friction + 1] += y * (limit / length - 1);
            free &= ~(3 << ColumnBlock.Friction);
        }
        var twist = patch.Across[2] + block.Changes[ColumnBlock.Twist];
        var bounded = Math.Clamp(twist, -lever, lever);
        if (bounded != twist)
        {
            block.Changes[ColumnBlock.Twist] = bounded - patch.Across[2];
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
        var normals = patch.Normals +
            Vector128.Create((float)block.Changes[0], (float)block.Changes[1], (float)block.Changes[2], (float)block.Changes[3]);
        normals = RowLanes.Max(normals, Vector128<float>.Zero);
        patch.DirectionNormals = normals - patch.Normals;
        var across = patch.Across + Vector128.Create(
            (float)block.Changes[ColumnBlock.Friction], (float)block.Changes[ColumnBlock.Friction + 1], (float)block.Changes[ColumnBlock.Twist], 0);
        patch.DirectionAcross = patch.Limit(across, normals) - patch.Across;
    }

    // As far as it lowers the energy: both ends are within all bounds, which are convex. Says whether it does.
    [MethodImpl(MethodImplOptions.NoInlining)]
    bool Go(ColumnBlock* column, int count)
    {
        for (int i = 0; i < count; ++i)
        {
            ref var support = ref supports[column[i].SupportIndex];
            support.Sum(DirectionOf(patches[column[i].SupportIndex]), out column[i].Linear, out column[i].Angular);
            if (i == 0)
                continue;
            // What it is for its lower body, which is the upper one of the patch below.
            column[i - 1].Linear -= column[i].Linear;
            column[i - 1].Angular -= column[i].Angular - Exact.Cross(support.ToLower, column[i].Linear);
        }
        float slope = 0, curvature = 0;
        for (int i = 0; i < count; ++i)
        {
            var upper = patches[column[i].SupportIndex].Upper;
            ref var body = ref bodies[upper];
            ref var inertia = ref inertias[nodes[upper].Body];
            slope += Exact.Dot(body.Linear.AsVector3(), column[i].Linear) + Exact.Dot(body.Angular.AsVector3(), column[i].Angular);
            curvature += Exact.LengthSquared(column[i].Linear) * inertia.InverseMass +
                Exact.Dot(column[i].Angular, inertia.InverseInertiaTensor * column[i].Angular);
        }
        // Not if a number went wrong: the comparison is false then.
        var part = -slope / curvature;
        if (!(part > 0))
            return false;
        part = MathHelper.Min(part, 1);
        for (int i = 0; i < count; ++i)
        {
            ref var patch = ref patches[column[i].SupportIndex];
            ref var body = ref bodies[patch.Upper];
            ref var inertia = ref inertias[nodes[patch.Upper].Body];
            body.Linear += (column[i].Linear * (inertia.InverseMass * part)).AsVector128();
            body.Angular += (inertia.InverseInertiaTensor * (column[i].Angular * part)).AsVector128();
            patch.Normals = RowLanes.Max(patch.Normals + patch.DirectionNormals * part, Vector128<float>.Zero);
            patch.Across += patch.DirectionAcross * part;
        }
        return true;
    }

    static PatchImpulses DirectionOf(in PatchRelaxation patch) => patch.Impulses(patch.DirectionNormals, patch.DirectionAcross);
}
