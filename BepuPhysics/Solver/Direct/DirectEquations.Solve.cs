namespace BepuPhysics.Constraints;

// What is asked of the joints, solved with the factors, and what that does to impulses and velocities.
readonly unsafe partial struct DirectEquations<TVectors, TNumbers>
{
    // Solves for the changes of the impulses of all that is not held, and applies them, in the structures of a mask.
    void SolveOnce(TNumbers mask)
    {
        var count = *freeCount;
        for (int i = 0; i < count; ++i)
            Ask(free[i]);
        for (int i = 0; i < count; ++i)
        {
            SolveForward(nodes[free[i]]);
            GoForward(free[i]);
        }
        for (int i = count - 1; i >= 0; --i)
        {
            GoBack(free[i]);
            SolveBack(nodes[free[i]]);
        }
        for (int i = 0; i < count; ++i)
        {
            var isFree = mask & IsFree(free[i]);
            if (TNumbers.Any(isFree))
                Apply(nodes[free[i]], isFree);
        }
    }

    // target - J v - s K lambda.
    void Ask(int joint)
    {
        ref var node = ref nodes[joint];
        var softness = rows[node.FirstRow].Softness;
        var isSoft = TNumbers.Above(softness, default);
        if (node.Limit == RowLimit.Positive)
            isSoft &= IsFree(joint);
        if (TNumbers.Any(isSoft))
        {
            if (node.RowCount == 1 && !node.SeesLinear)
                AskSoftlyOne(node, softness, isSoft);
            else
                AskSoftly(node, softness, isSoft);
            return;
        }
        var j = jacobians + node.Jacobian;
        for (int row = 0; row < node.RowCount; ++row)
        {
            TVectors sum = default;
            for (int slot = 0; slot < node.BodyCount; ++slot, ++j)
            {
                ref var velocity = ref bodies[node.Bodies[slot]].Velocity;
                if (node.SeesLinear)
                    sum += DirectPair<TVectors, TNumbers>.Multiply(*j, velocity);
                else
                    sum += j->Angular * velocity.Angular;
            }
            rows[node.FirstRow + row].X = rows[node.FirstRow + row].Target - TVectors.Sum(sum);
        }
    }

    void AskSoftly(in DirectNode node, TNumbers softness, TNumbers isSoft)
    {
        var velocities = stackalloc DirectPair<TVectors, TNumbers>[Solver.MaximumBodiesPerConstraint];
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            velocities[slot] = bodies[node.Bodies[slot]].Velocity;
            for (int row = 0; row < node.RowCount; ++row)
            {
                ref var w = ref weighted[node.Jacobian + row * node.BodyCount + slot];
                var impulse = softness * rows[node.FirstRow + row].Impulse;
                if (node.SeesLinear)
                    velocities[slot].Add(w, impulse, isSoft);
                else
                    velocities[slot].Angular = TVectors.Choose(isSoft, velocities[slot].Angular + w.Angular * impulse, velocities[slot].Angular);
            }
        }
        var j = jacobians + node.Jacobian;
        for (int row = 0; row < node.RowCount; ++row)
        {
            TVectors sum = default;
            for (int slot = 0; slot < node.BodyCount; ++slot, ++j)
                sum += node.SeesLinear ? DirectPair<TVectors, TNumbers>.Multiply(*j, velocities[slot]) : j->Angular * velocities[slot].Angular;
            rows[node.FirstRow + row].X = rows[node.FirstRow + row].Target - TVectors.Sum(sum);
        }
    }

    // Of one row about an axis, as limits of angles have: the same to the last bit, with all in registers.
    void AskSoftlyOne(in DirectNode node, TNumbers softness, TNumbers isSoft)
    {
        ref var row = ref rows[node.FirstRow];
        var impulse = softness * row.Impulse;
        var j = jacobians + node.Jacobian;
        var w = weighted + node.Jacobian;
        TVectors sum = default;
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            var velocity = bodies[node.Bodies[slot]].Velocity.Angular;
            sum += j[slot].Angular * TVectors.Choose(isSoft, velocity + w[slot].Angular * impulse, velocity);
        }
        row.X = row.Target - TVectors.Sum(sum);
    }

    void SolveForward(in DirectNode node)
    {
        var count = node.RowCount;
        var x = rows + node.FirstRow;
        var diagonal = numbers + node.Diagonal;
        if (count == Three)
        {
            SolveForwardThree(diagonal, x);
            return;
        }
        for (int row = 1; row < count; ++row)
        {
            for (int i = 0; i < row; ++i)
                x[row].X -= diagonal[row * count + i] * x[i].X;
        }
        for (int row = 0; row < count; ++row)
            x[row].X *= x[row].InversePivot;
    }

    void GoForward(int joint)
    {
        ref var node = ref nodes[joint];
        var count = node.RowCount;
        var x = rows + node.FirstRow;
        // What this does to a joint where that is held means nothing.
        var mask = IsFree(joint);
        var places = live + node.FirstBlock;
        for (int a = 0; a < states[joint].LiveCount; ++a)
        {
            ref var later = ref blocks[node.FirstBlock + places[a]];
            var block = numbers + later.Place;
            if (count == Three)
            {
                GoForwardThree(block, x, rows + later.FirstRow, later.RowCount, mask);
                continue;
            }
            for (int row = 0; row < later.RowCount; ++row, block += count)
            {
                TNumbers sum = default;
                for (int i = 0; i < count; ++i)
                    sum += block[i] * x[i].X;
                ref var ofLater = ref rows[later.FirstRow + row].X;
                Write(ref ofLater, ofLater - sum, mask);
            }
        }
    }

    void GoBack(int joint)
    {
        ref var node = ref nodes[joint];
        var count = node.RowCount;
        var x = rows + node.FirstRow;
        var places = live + node.FirstBlock;
        for (int a = 0; a < states[joint].LiveCount; ++a)
        {
            ref var later = ref blocks[node.FirstBlock + places[a]];
            var block = numbers + later.Place;
            var mask = IsFree(later.Joint);
            if (count == Three)
            {
                GoBackThree(block, x, rows + later.FirstRow, later.RowCount, mask);
                continue;
            }
            for (int row = 0; row < later.RowCount; ++row, block += count)
            {
                var known = rows[later.FirstRow + row].X;
                for (int i = 0; i < count; ++i)
                    Write(ref x[i].X, x[i].X - x[i].InversePivot * block[i] * known, mask);
            }
        }
    }

    void SolveBack(in DirectNode node)
    {
        var count = node.RowCount;
        var x = rows + node.FirstRow;
        var diagonal = numbers + node.Diagonal;
        if (count == Three)
        {
            SolveBackThree(diagonal, x);
            return;
        }
        for (int row = count - 2; row >= 0; --row)
        {
            for (int i = row + 1; i < count; ++i)
                x[row].X -= diagonal[i * count + row] * x[i].X;
        }
    }

    void Apply(in DirectNode node, TNumbers mask)
    {
        for (int i = 0; i < node.RowCount; ++i)
        {
            ref var row = ref rows[node.FirstRow + i];
            Write(ref row.Impulse, row.Impulse + row.X, mask);
        }
        ApplyRows(node, rows + node.FirstRow, changes: true, mask);
    }

    // A body's velocity stays in registers until all rows have changed it.
    void ApplyRows(in DirectNode node, DirectRow<TNumbers>* ofRows, bool changes, TNumbers mask)
    {
        if (!node.SeesLinear)
        {
            ApplyAngularRows(node, ofRows, changes, mask);
            return;
        }
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            ref var velocity = ref bodies[node.Bodies[slot]].Velocity;
            var (linear, angular) = (velocity.Linear, velocity.Angular);
            var w = weighted + node.Jacobian + slot;
            for (int row = 0; row < node.RowCount; ++row, w += node.BodyCount)
            {
                var impulse = changes ? ofRows[row].X : ofRows[row].Impulse;
                linear += w->Linear * impulse;
                angular += w->Angular * impulse;
            }
            velocity.Linear = TVectors.Choose(mask, linear, velocity.Linear);
            velocity.Angular = TVectors.Choose(mask, angular, velocity.Angular);
        }
    }

    void ApplyAngularRows(in DirectNode node, DirectRow<TNumbers>* ofRows, bool changes, TNumbers mask)
    {
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            ref var velocity = ref bodies[node.Bodies[slot]].Velocity;
            var angular = velocity.Angular;
            var w = weighted + node.Jacobian + slot;
            for (int row = 0; row < node.RowCount; ++row, w += node.BodyCount)
                angular += w->Angular * (changes ? ofRows[row].X : ofRows[row].Impulse);
            velocity.Angular = TVectors.Choose(mask, angular, velocity.Angular);
        }
    }
}
