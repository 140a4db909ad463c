namespace BepuPhysics.Constraints;

/// <summary>The equations of a structure of joints that is solved at once, or of several equal ones side by side, in numbers of double precision.</summary>
// With v the velocities that all else has left, lambda the impulses, K the block of a joint on the diagonal of J M^-1 J^T and s its softness as part of K:
//
//   (J M^-1 J^T + s K) x = target - J v - s K lambda,   lambda += x,   v += M^-1 J^T x.
//
// Single precision is not enough: in a chain whose end is a million times as heavy as a link all digits are gone before the last pivot. In double precision a
// true pivot of such a chain is a millionth of its diagonal, and what rounding of J leaves of a row that says what others have said is 1e-14 of it.
//
// Who is held (DirectEquations.Bounds.cs) differs between structures that are solved side by side. Numbers of a joint that is held mean nothing where it is,
// and what others would get of them is masked.
readonly unsafe partial struct DirectEquations<TVectors, TNumbers>(in DirectPlan plan, in DirectIsland island, in DirectMemory<TVectors, TNumbers> memory)
    where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
{
    // Part of what a row has on the diagonal below which its pivot is rounding.
    const double LeastPivot = 1e-9;

    readonly DirectNode* nodes = plan.Nodes.Span.Memory;
    readonly DirectBlock* blocks = plan.Blocks.Span.Memory;
    readonly int* targets = plan.Targets.Span.Memory;
    readonly DirectCoupling* couplings = plan.Couplings.Span.Memory;
    readonly int firstNode = island.FirstNode;
    readonly int endNode = island.EndNode;
    readonly bool hasBounds = island.HasBounds;
    readonly TNumbers* numbers = memory.Numbers;
    readonly DirectPair<TVectors, TNumbers>* jacobians = memory.Jacobians;
    readonly DirectPair<TVectors, TNumbers>* weighted = memory.Weighted;
    readonly DirectRow<TNumbers>* rows = memory.Rows;
    readonly DirectHold<TNumbers>* holds = memory.Holds;
    readonly DirectBody<TVectors, TNumbers>* bodies = memory.Bodies;
    readonly int* freeCount = memory.Free;
    readonly int* free = memory.Free + 1;

    /// <summary>Works out A, and applies the impulses that are there, times a factor. Before all else.</summary>
    internal void WarmStart(double scale)
    {
        for (int k = firstNode; k < endNode; ++k)
        {
            for (int i = 0; i < nodes[k].RowCount; ++i)
                rows[nodes[k].FirstRow + i].Impulse *= TNumbers.Of(scale);
            if (nodes[k].HasBounds)
                Foresee(k);
            if (!IsIdle(k))
                Weigh(nodes[k]);
        }
        Factor();
        for (int k = firstNode; k < endNode; ++k)
        {
            if (IsIdle(k))
                continue;
            var mask = nodes[k].Limit == RowLimit.Positive ? ~holds[k].IsHeld : TNumbers.All;
            ApplyRows(nodes[k], rows + nodes[k].FirstRow, changes: false, mask);
        }
    }

    // Of a joint that is held there is its own block alone.
    void Factor()
    {
        var count = 0;
        for (int k = firstNode; k < endNode; ++k)
        {
            if (TNumbers.Any(IsFree(k)))
                free[count++] = k;
            else if (nodes[k].Limit == RowLimit.Length)
                AddDiagonal(nodes[k], TNumbers.All);
        }
        *freeCount = count;
        for (int i = 0; i < count; ++i)
        {
            ClearBlocks(free[i]);
            AddDiagonal(nodes[free[i]], TNumbers.All);
        }
        for (int i = 0; i < count; ++i)
        {
            ref var node = ref nodes[free[i]];
            for (int coupling = node.FirstCoupling; coupling < node.EndCoupling; ++coupling)
            {
                if (TNumbers.Any(IsFree(free[i]) & IsFree(couplings[coupling].Later)))
                    AddCoupling(node, couplings[coupling]);
            }
        }
        for (int i = 0; i < count; ++i)
        {
            FactorDiagonal(nodes[free[i]], TNumbers.All);
            Eliminate(free[i]);
        }
        for (int k = firstNode; k < endNode && hasBounds; ++k)
        {
            if (nodes[k].Limit == RowLimit.Length && !TNumbers.Any(IsFree(k)))
                FactorDiagonal(nodes[k], TNumbers.All);
        }
    }

    void ClearBlocks(int joint)
    {
        ref var node = ref nodes[joint];
        for (int a = node.FirstBlock; a < node.FirstBlock + node.BlockCount; ++a)
        {
            if (!TNumbers.Any(IsFree(joint) & IsFree(blocks[a].Joint)))
                continue;
            var block = numbers + blocks[a].Place;
            for (int i = node.RowCount * nodes[blocks[a].Joint].RowCount - 1; i >= 0; --i)
                block[i] = default;
        }
    }

    TNumbers IsFree(int node) => ~holds[node].IsHeld;

    // M^-1 J^T.
    void Weigh(in DirectNode node)
    {
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            ref var body = ref bodies[node.Bodies[slot]];
            var (inverseMass, x, y, z) = (body.InverseMass, body.InverseInertiaX, body.InverseInertiaY, body.InverseInertiaZ);
            var j = jacobians + node.Jacobian + slot;
            var w = weighted + node.Jacobian + slot;
            for (int row = node.RowCount; row > 0; --row, j += node.BodyCount, w += node.BodyCount)
            {
                w->Linear = j->Linear * inverseMass;
                w->Angular = x * j->Angular.X + y * j->Angular.Y + z * j->Angular.Z;
            }
        }
    }

    void AddDiagonal(in DirectNode node, TNumbers mask)
    {
        var block = numbers + node.Diagonal;
        var count = node.BodyCount;
        var scale = TNumbers.Of(1) + rows[node.FirstRow].Softness;
        if (TNumbers.Count == 1 && node.RowCount == Three && count == 2)
        {
            AddDiagonalThree(block, jacobians + node.Jacobian, weighted + node.Jacobian, rows + node.FirstRow, scale, mask);
            return;
        }
        for (int row = 0; row < node.RowCount; ++row)
        {
            var j = jacobians + node.Jacobian + row * count;
            for (int column = 0; column <= row; ++column)
            {
                var w = weighted + node.Jacobian + column * count;
                TVectors sum = default;
                for (int slot = 0; slot < count; ++slot)
                    sum += DirectPair<TVectors, TNumbers>.Multiply(j[slot], w[slot]);
                Write(ref block[row * node.RowCount + column], TVectors.Sum(sum) * scale, mask);
            }
            Write(ref rows[node.FirstRow + row].LeastPivot, TNumbers.Of(LeastPivot) * block[row * node.RowCount + row], mask);
        }
    }

    static void Write(ref TNumbers place, TNumbers value, TNumbers mask) => place = TNumbers.Choose(mask, value, place);

    void AddCoupling(in DirectNode earlier, in DirectCoupling coupling)
    {
        ref var later = ref nodes[coupling.Later];
        var block = numbers + coupling.Place;
        var j = jacobians + later.Jacobian + coupling.LaterSlot;
        if (TNumbers.Count == 1 && earlier.RowCount == Three)
        {
            AddCouplingThree(block, j, later.BodyCount, later.RowCount, weighted + earlier.Jacobian + coupling.EarlierSlot, earlier.BodyCount);
            return;
        }
        for (int row = 0; row < later.RowCount; ++row, j += later.BodyCount)
        {
            var w = weighted + earlier.Jacobian + coupling.EarlierSlot;
            for (int column = 0; column < earlier.RowCount; ++column, w += earlier.BodyCount)
                *block++ += TVectors.Sum(DirectPair<TVectors, TNumbers>.Multiply(*j, *w));
        }
    }

    void Eliminate(int joint)
    {
        ref var node = ref nodes[joint];
        var isFree = IsFree(joint);
        for (int a = node.FirstBlock; a < node.FirstBlock + node.BlockCount; ++a)
        {
            if (TNumbers.Any(isFree & IsFree(blocks[a].Joint)))
                Scale(node, blocks[a]);
        }
        var target = targets + node.FirstTarget;
        for (int a = node.FirstBlock; a < node.FirstBlock + node.BlockCount; ++a)
        {
            var isFreeToo = isFree & IsFree(blocks[a].Joint);
            if (!TNumbers.Any(isFreeToo))
            {
                target += a + 1 - node.FirstBlock;
                continue;
            }
            for (int b = node.FirstBlock; b <= a; ++b, ++target)
            {
                var mask = isFreeToo & IsFree(blocks[b].Joint);
                if (TNumbers.Any(mask))
                    Subtract(node, blocks[a], blocks[b], numbers + *target, mask);
            }
        }
    }

    // Times the inverse of L^T: what is left is L D.
    void Scale(in DirectNode node, in DirectBlock below)
    {
        var count = node.RowCount;
        var diagonal = numbers + node.Diagonal;
        var block = numbers + below.Place;
        if (count == Three)
        {
            ScaleThree(diagonal, block, nodes[below.Joint].RowCount);
            return;
        }
        for (int row = nodes[below.Joint].RowCount; row > 0; --row, block += count)
        {
            for (int column = 1; column < count; ++column)
            {
                var value = block[column];
                for (int i = 0; i < column; ++i)
                    value -= block[i] * diagonal[column * count + i];
                block[column] = value;
            }
        }
    }

    // L D L^T of a block; a pivot that is rounding is left out, and what its row asks for is left to the rows that say the same.
    void FactorDiagonal(in DirectNode node, TNumbers mask)
    {
        var count = node.RowCount;
        var block = numbers + node.Diagonal;
        if (count == Three)
        {
            FactorThree(block, rows + node.FirstRow, mask);
            return;
        }
        for (int column = 0; column < count; ++column)
        {
            var pivot = block[column * count + column];
            for (int i = 0; i < column; ++i)
                pivot -= block[column * count + i] * block[column * count + i] * block[i * count + i];
            Write(ref block[column * count + column], pivot, mask);
            ref var ofRow = ref rows[node.FirstRow + column];
            var inverse = (TNumbers.Of(1) / pivot) & TNumbers.Above(pivot, ofRow.LeastPivot);
            Write(ref ofRow.InversePivot, inverse, mask);
            for (int row = column + 1; row < count; ++row)
            {
                var value = block[row * count + column];
                for (int i = 0; i < column; ++i)
                    value -= block[row * count + i] * block[column * count + i] * block[i * count + i];
                Write(ref block[row * count + column], value * inverse, mask);
            }
        }
    }

    void Subtract(in DirectNode node, in DirectBlock a, in DirectBlock b, TNumbers* target, TNumbers mask)
    {
        var count = node.RowCount;
        var pivots = rows + node.FirstRow;
        var left = numbers + a.Place;
        var (rowCount, columns) = (nodes[a.Joint].RowCount, nodes[b.Joint].RowCount);
        if (count == 1)
        {
            SubtractOne(pivots->InversePivot, left, rowCount, numbers + b.Place, columns, target, mask);
            return;
        }
        // What is above the diagonal of the matrix nobody reads.
        var isDiagonal = a.Joint == b.Joint;
        if (count == Three)
        {
            SubtractThree(pivots, left, rowCount, numbers + b.Place, columns, isDiagonal, target, mask);
            return;
        }
        var scaled = stackalloc TNumbers[DirectPlan.MostRows];
        for (int row = 0; row < rowCount; ++row, left += count, target += columns)
        {
            for (int i = 0; i < count; ++i)
                scaled[i] = left[i] * pivots[i].InversePivot;
            var right = numbers + b.Place;
            var end = isDiagonal ? row + 1 : columns;
            for (int column = 0; column < end; ++column, right += count)
            {
                var sum = scaled[0] * right[0];
                for (int i = 1; i < count; ++i)
                    sum += scaled[i] * right[i];
                Write(ref target[column], target[column] - sum, mask);
            }
        }
    }
}
