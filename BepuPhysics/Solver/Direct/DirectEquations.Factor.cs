using System.Runtime.CompilerServices;

namespace BepuPhysics.Constraints;

// The factors A = L D L^T, joint after joint.
//
// When it has changed who is held only what depends on it is worked out anew, to the same bits. The column of a joint is its pivots and the blocks below them;
// eliminating it changes the columns of the joints of these blocks. So those of who has changed, and of all that follow from them towards the root, are
// worked out, and in the other columns the blocks of who is held no longer, which nobody looked after while it was. Of two that are left when a joint is
// eliminated either may be held in a structure: what is written of them there means nothing, so only where the joint itself is held it is masked.
readonly unsafe partial struct DirectEquations<TVectors, TNumbers>
{
    // Of a joint that is held there is its own block alone.
    void FactorAll()
    {
        for (int k = firstNode; k < endNode; ++k)
            states[k] = new() { Free = TNumbers.Bits(IsFree(k)), IsColumn = true };
        FactorColumns();
    }

    // After it has changed who is held.
    void FactorChanged()
    {
        for (int k = firstNode; k < endNode; ++k)
        {
            ref var state = ref states[k];
            var free = TNumbers.Bits(IsFree(k));
            (state.IsColumn, state.IsRow) = (keepsFactors ? free != state.Free : true, (free & ~state.Free) != 0);
            // For now of either: what was there has to be taken out.
            state.Free |= free;
        }
        for (int k = firstNode; k < endNode; ++k)
        {
            ref var state = ref states[k];
            ref var node = ref nodes[k];
            for (int a = node.FirstBlock; state.IsColumn && a < node.FirstBlock + node.BlockCount; ++a)
            {
                ref var ofLater = ref states[blocks[a].Joint];
                ofLater.IsColumn |= (state.Free & ofLater.Free) != 0;
            }
        }
        for (int k = firstNode; k < endNode; ++k)
            states[k].Free = TNumbers.Bits(IsFree(k));
        FactorColumns();
    }

    void FactorColumns()
    {
        var count = 0;
        for (int k = firstNode; k < endNode; ++k)
        {
            ref var state = ref states[k];
            if (state.Free != 0)
            {
                free[count++] = k;
                FindLive(k);
            }
            else if (state.IsColumn && nodes[k].Limit == RowLimit.Length)
            {
                AddDiagonal(nodes[k], TNumbers.All);
                FactorDiagonal(nodes[k], TNumbers.All);
            }
        }
        *freeCount = count;
        for (int i = 0; i < count; ++i)
            Assemble(free[i]);
        for (int i = 0; i < count; ++i)
        {
            ref var node = ref nodes[free[i]];
            if (states[free[i]].IsColumn)
                FactorDiagonal(node, TNumbers.All);
            Scale(free[i]);
            if (node.RowCount == 1)
                EliminateOne(free[i]);
            else if (node.RowCount == Three)
                EliminateThree(free[i]);
            else
                Eliminate(free[i]);
        }
    }

    // Which blocks below a joint there are in any structure.
    void FindLive(int joint)
    {
        ref var node = ref nodes[joint];
        ref var state = ref states[joint];
        var count = 0;
        for (int a = 0; a < node.BlockCount; ++a)
        {
            if ((state.Free & states[blocks[node.FirstBlock + a].Joint].Free) != 0)
                live[node.FirstBlock + count++] = a;
        }
        state.LiveCount = count;
    }

    // The column of a joint before any elimination.
    void Assemble(int joint)
    {
        ref var node = ref nodes[joint];
        ref var state = ref states[joint];
        if (state.IsColumn)
            AddDiagonal(node, TNumbers.All);
        for (int i = 0; i < state.LiveCount; ++i)
        {
            ref var block = ref blocks[node.FirstBlock + live[node.FirstBlock + i]];
            if (state.IsColumn || states[block.Joint].IsRow)
                AddBlock(node, block);
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
                    sum += node.SeesLinear ? DirectPair<TVectors, TNumbers>.Multiply(j[slot], w[slot]) : j[slot].Angular * w[slot].Angular;
                Write(ref block[row * node.RowCount + column], TVectors.Sum(sum) * scale, mask);
            }
            Write(ref rows[node.FirstRow + row].LeastPivot, TNumbers.Of(LeastPivot) * block[row * node.RowCount + row], mask);
        }
    }

    static void Write(ref TNumbers place, TNumbers value, TNumbers mask) => place = TNumbers.Choose(mask, value, place);

    // By all bodies that two joints have in common.
    void AddBlock(in DirectNode earlier, in DirectBlock block)
    {
        ref var later = ref nodes[block.Joint];
        var place = numbers + block.Place;
        if (block.FirstCoupling == block.EndCoupling)
        {
            for (int i = earlier.RowCount * later.RowCount - 1; i >= 0; --i)
                place[i] = default;
            return;
        }
        for (int i = block.FirstCoupling; i < block.EndCoupling; ++i)
        {
            var j = jacobians + later.Jacobian + couplings[i].LaterSlot;
            var w = weighted + earlier.Jacobian + couplings[i].EarlierSlot;
            var isFirst = i == block.FirstCoupling;
            if (!earlier.SeesLinear || !later.SeesLinear)
                AddAngularCoupling(place, j, later.BodyCount, later.RowCount, w, earlier.BodyCount, earlier.RowCount, isFirst);
            else if (TNumbers.Count == 1 && earlier.RowCount == Three)
                AddCouplingThree(place, j, later.BodyCount, later.RowCount, w, earlier.BodyCount, isFirst);
            else
                AddCoupling(place, j, later.BodyCount, later.RowCount, w, earlier.BodyCount, earlier.RowCount, isFirst);
        }
    }

    static void AddCoupling(
        TNumbers* block, DirectPair<TVectors, TNumbers>* j, int stride, int rowCount, DirectPair<TVectors, TNumbers>* w, int strideOfW, int columns,
        bool isFirst)
    {
        for (; rowCount > 0; --rowCount, j += stride)
        {
            var (linear, angular) = (j->Linear, j->Angular);
            var ofColumn = w;
            for (int column = 0; column < columns; ++column, ofColumn += strideOfW, ++block)
                *block = (isFirst ? default : *block) + TVectors.Sum(linear * ofColumn->Linear + angular * ofColumn->Angular);
        }
    }

    // Where one of the two is about axes alone.
    static void AddAngularCoupling(
        TNumbers* block, DirectPair<TVectors, TNumbers>* j, int stride, int rowCount, DirectPair<TVectors, TNumbers>* w, int strideOfW, int columns,
        bool isFirst)
    {
        for (; rowCount > 0; --rowCount, j += stride)
        {
            var angular = j->Angular;
            var ofColumn = w;
            for (int column = 0; column < columns; ++column, ofColumn += strideOfW, ++block)
                *block = (isFirst ? default : *block) + TVectors.Sum(angular * ofColumn->Angular);
        }
    }

    // Times the inverse of L^T: what is left is L D.
    void Scale(int joint)
    {
        ref var node = ref nodes[joint];
        ref var state = ref states[joint];
        // Of one row L is one.
        for (int i = 0; i < state.LiveCount && node.RowCount > 1; ++i)
        {
            ref var below = ref blocks[node.FirstBlock + live[node.FirstBlock + i]];
            if (!state.IsColumn && !states[below.Joint].IsRow)
                continue;
            if (node.RowCount == Three)
                ScaleThree(numbers + node.Diagonal, numbers + below.Place, below.RowCount);
            else
                Scale(node, below);
        }
    }

    void Scale(in DirectNode node, in DirectBlock below)
    {
        var count = node.RowCount;
        var diagonal = numbers + node.Diagonal;
        var block = numbers + below.Place;
        for (int row = below.RowCount; row > 0; --row, block += count)
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

    // Whether the elimination of a joint has to change the block of two that are left, a of which goes last.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static bool Changes(in DirectState state, in DirectState ofA, in DirectState ofB) =>
        (ofB.IsColumn | ofA.IsRow) && (state.Free & ofA.Free & ofB.Free) != 0;

    // Where the block of a joint by itself is changed by others. Numbers of one that is held mean nothing, but a servo's have to be its own block there.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    TNumbers OwnBlock(int joint) => nodes[joint].Limit == RowLimit.Length ? IsFree(joint) : TNumbers.All;

    void Eliminate(int joint)
    {
        ref var node = ref nodes[joint];
        ref var state = ref states[joint];
        var ofBlocks = blocks + node.FirstBlock;
        var places = live + node.FirstBlock;
        var pivots = rows + node.FirstRow;
        var count = node.RowCount;
        var isFree = IsFree(joint);
        var scaled = stackalloc TNumbers[DirectPlan.MostRows];
        for (int i = 0; i < state.LiveCount; ++i)
        {
            ref var a = ref ofBlocks[places[i]];
            var target = targets + node.FirstTarget + places[i] * (places[i] + 1) / 2;
            for (int l = 0; l <= i; ++l)
            {
                ref var b = ref ofBlocks[places[l]];
                if (!Changes(state, states[a.Joint], states[b.Joint]))
                    continue;
                var mask = i == l ? isFree & OwnBlock(a.Joint) : isFree;
                var left = numbers + a.Place;
                var place = numbers + target[places[l]];
                for (int row = 0; row < a.RowCount; ++row, left += count, place += b.RowCount)
                {
                    for (int k = 0; k < count; ++k)
                        scaled[k] = left[k] * pivots[k].InversePivot;
                    var right = numbers + b.Place;
                    var end = i == l ? row + 1 : b.RowCount;
                    for (int column = 0; column < end; ++column, right += count)
                    {
                        var sum = scaled[0] * right[0];
                        for (int k = 1; k < count; ++k)
                            sum += scaled[k] * right[k];
                        Write(ref place[column], place[column] - sum, mask);
                    }
                }
            }
        }
    }
}
