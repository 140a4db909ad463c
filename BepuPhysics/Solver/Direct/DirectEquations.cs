using System;
using System.Runtime.Intrinsics;

namespace BepuPhysics.Constraints;

/// <summary>The equations of all structures of joints that are solved at once, in numbers of double precision.</summary>
// With v the velocities that all else has left, lambda the impulses, K the block of a joint on the diagonal of J M^-1 J^T and s its softness as part of K:
//
//   (J M^-1 J^T + s K) x = target - J v - s K lambda,   lambda += x,   v += M^-1 J^T x.
//
// Single precision is not enough: in a chain whose end is a million times as heavy as a link all digits are gone before the last pivot. In double precision a
// true pivot of such a chain is a millionth of its diagonal, and what rounding of J leaves of a row that says what others have said is 1e-14 of it.
readonly unsafe partial struct DirectEquations(in DirectPlan plan, double* numbers, DirectPair* jacobians, DirectPair* weighted, DirectRow* rows)
{
    // Part of what a row has on the diagonal below which its pivot is rounding.
    const double LeastPivot = 1e-9;
    /// <summary>Most rows of a joint.</summary>
    internal const int MostRows = 6;

    readonly DirectNode* nodes = plan.Nodes.Span.Memory;
    readonly DirectBlock* blocks = plan.Blocks.Span.Memory;
    readonly int* targets = plan.Targets.Span.Memory;
    readonly DirectCoupling* couplings = plan.Couplings.Span.Memory;
    readonly DirectBody* bodies = plan.Bodies.Span.Memory;

    /// <summary>Works out A, and applies the impulses that are there, times a factor. Before all else.</summary>
    internal void WarmStart(in DirectIsland island, double scale)
    {
        for (int k = island.FirstNode; k < island.EndNode; ++k)
        {
            for (int i = 0; i < nodes[k].RowCount; ++i)
                rows[nodes[k].FirstRow + i].Impulse *= scale;
            if (nodes[k].HasBounds)
                Foresee(ref nodes[k]);
            if (!IsIdle(nodes[k]))
                Weigh(nodes[k]);
        }
        Factor(island);
        for (int k = island.FirstNode; k < island.EndNode; ++k)
        {
            for (int i = 0; i < nodes[k].RowCount && !IsIdle(nodes[k]); ++i)
                Apply(nodes[k], i, rows[nodes[k].FirstRow + i].Impulse);
        }
    }

    // Of a joint that is held there is its own block alone.
    void Factor(in DirectIsland island)
    {
        new Span<double>(numbers + island.FirstNumber, island.EndNumber - island.FirstNumber).Clear();
        for (int k = island.FirstNode; k < island.EndNode; ++k)
        {
            if (!IsIdle(nodes[k]))
                AddDiagonal(nodes[k]);
        }
        for (int i = island.FirstCoupling; i < island.EndCoupling; ++i)
        {
            if (!nodes[couplings[i].Later].IsHeld && !nodes[couplings[i].Earlier].IsHeld)
                AddCoupling(couplings[i]);
        }
        for (int k = island.FirstNode; k < island.EndNode; ++k)
        {
            if (!IsIdle(nodes[k]))
                FactorDiagonal(nodes[k]);
            if (!nodes[k].IsHeld)
                Eliminate(nodes[k]);
        }
    }

    // M^-1 J^T.
    void Weigh(in DirectNode node)
    {
        var j = jacobians + node.Jacobian;
        var w = weighted + node.Jacobian;
        for (int row = 0; row < node.RowCount; ++row)
        {
            for (int slot = 0; slot < node.BodyCount; ++slot, ++j, ++w)
            {
                ref var body = ref bodies[node.Bodies[slot]];
                w->Linear = j->Linear * body.InverseMass;
                w->Angular = body.InverseInertiaX * j->Angular[0] + body.InverseInertiaY * j->Angular[1] + body.InverseInertiaZ * j->Angular[2];
            }
        }
    }

    void AddDiagonal(in DirectNode node)
    {
        var block = numbers + node.Diagonal;
        var count = node.BodyCount;
        for (int row = 0; row < node.RowCount; ++row)
        {
            for (int column = 0; column <= row; ++column)
            {
                var sum = Vector256<double>.Zero;
                for (int slot = 0; slot < count; ++slot)
                    sum += DirectPair.Multiply(jacobians[node.Jacobian + row * count + slot], weighted[node.Jacobian + column * count + slot]);
                block[row * node.RowCount + column] = DirectPair.Sum(sum) * (1 + rows[node.FirstRow].Softness);
            }
            rows[node.FirstRow + row].LeastPivot = LeastPivot * block[row * node.RowCount + row];
        }
    }

    void AddCoupling(in DirectCoupling coupling)
    {
        ref var later = ref nodes[coupling.Later];
        ref var earlier = ref nodes[coupling.Earlier];
        var block = numbers + coupling.Place;
        var j = jacobians + later.Jacobian + coupling.LaterSlot;
        for (int row = 0; row < later.RowCount; ++row, j += later.BodyCount)
        {
            var w = weighted + earlier.Jacobian + coupling.EarlierSlot;
            for (int column = 0; column < earlier.RowCount; ++column, w += earlier.BodyCount)
                *block++ += DirectPair.Sum(DirectPair.Multiply(*j, *w));
        }
    }

    void Eliminate(in DirectNode node)
    {
        var count = node.RowCount;
        var diagonal = numbers + node.Diagonal;
        for (int a = node.FirstBlock; a < node.FirstBlock + node.BlockCount; ++a)
        {
            if (nodes[blocks[a].Joint].IsHeld)
                continue;
            // Times the inverse of L^T: what is left is L D.
            var block = numbers + blocks[a].Place;
            for (int row = nodes[blocks[a].Joint].RowCount; row > 0; --row, block += count)
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
        var target = targets + node.FirstTarget;
        for (int a = node.FirstBlock; a < node.FirstBlock + node.BlockCount; ++a)
        {
            if (nodes[blocks[a].Joint].IsHeld)
            {
                target += a + 1 - node.FirstBlock;
                continue;
            }
            for (int b = node.FirstBlock; b <= a; ++b, ++target)
            {
                if (!nodes[blocks[b].Joint].IsHeld)
                    Subtract(node, blocks[a], blocks[b], numbers + *target);
            }
        }
    }

    // L D L^T of a block; a pivot that is rounding is left out, and what its row asks for is left to the rows that say the same.
    void FactorDiagonal(in DirectNode node)
    {
        var count = node.RowCount;
        var block = numbers + node.Diagonal;
        for (int column = 0; column < count; ++column)
        {
            var pivot = block[column * count + column];
            for (int i = 0; i < column; ++i)
                pivot -= block[column * count + i] * block[column * count + i] * block[i * count + i];
            block[column * count + column] = pivot;
            ref var inverse = ref rows[node.FirstRow + column].InversePivot;
            inverse = pivot > rows[node.FirstRow + column].LeastPivot ? 1 / pivot : 0;
            for (int row = column + 1; row < count; ++row)
            {
                var value = block[row * count + column];
                for (int i = 0; i < column; ++i)
                    value -= block[row * count + i] * block[column * count + i] * block[i * count + i];
                block[row * count + column] = value * inverse;
            }
        }
    }

    void Subtract(in DirectNode node, in DirectBlock a, in DirectBlock b, double* target)
    {
        var count = node.RowCount;
        var scaled = stackalloc double[MostRows];
        var left = numbers + a.Place;
        var columns = nodes[b.Joint].RowCount;
        for (int row = nodes[a.Joint].RowCount; row > 0; --row, left += count)
        {
            for (int i = 0; i < count; ++i)
                scaled[i] = left[i] * rows[node.FirstRow + i].InversePivot;
            var right = numbers + b.Place;
            for (int column = columns; column > 0; --column, right += count)
            {
                var sum = scaled[0] * right[0];
                for (int i = 1; i < count; ++i)
                    sum += scaled[i] * right[i];
                *target++ -= sum;
            }
        }
    }

    // Solves for the changes of the impulses of all that is not held, and applies them.
    void SolveOnce(in DirectIsland island)
    {
        for (int k = island.FirstNode; k < island.EndNode; ++k)
        {
            if (!nodes[k].IsHeld)
                Ask(nodes[k]);
        }
        for (int k = island.FirstNode; k < island.EndNode; ++k)
        {
            if (nodes[k].IsHeld)
                continue;
            SolveForward(nodes[k]);
            GoForward(nodes[k]);
        }
        for (int k = island.EndNode - 1; k >= island.FirstNode; --k)
        {
            if (nodes[k].IsHeld)
                continue;
            GoBack(nodes[k]);
            SolveBack(nodes[k]);
        }
        for (int k = island.FirstNode; k < island.EndNode; ++k)
        {
            if (!nodes[k].IsHeld)
                Apply(nodes[k]);
        }
    }

    // target - J v - s K lambda.
    void Ask(in DirectNode node)
    {
        var j = jacobians + node.Jacobian;
        var softness = rows[node.FirstRow].Softness;
        var velocities = stackalloc DirectPair[Solver.MaximumBodiesPerConstraint];
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            velocities[slot] = bodies[node.Bodies[slot]].Velocity;
            for (int row = 0; row < node.RowCount && softness > 0 && !IsIdle(node); ++row)
                velocities[slot].Add(weighted[node.Jacobian + row * node.BodyCount + slot], softness * rows[node.FirstRow + row].Impulse);
        }
        for (int row = 0; row < node.RowCount; ++row)
        {
            var sum = Vector256<double>.Zero;
            for (int slot = 0; slot < node.BodyCount; ++slot, ++j)
                sum += DirectPair.Multiply(*j, velocities[slot]);
            rows[node.FirstRow + row].X = rows[node.FirstRow + row].Target - DirectPair.Sum(sum);
        }
    }

    void SolveForward(in DirectNode node)
    {
        var count = node.RowCount;
        var x = rows + node.FirstRow;
        var diagonal = numbers + node.Diagonal;
        for (int row = 1; row < count; ++row)
        {
            for (int i = 0; i < row; ++i)
                x[row].X -= diagonal[row * count + i] * x[i].X;
        }
        for (int row = 0; row < count; ++row)
            x[row].X *= x[row].InversePivot;
    }

    void GoForward(in DirectNode node)
    {
        var count = node.RowCount;
        var x = rows + node.FirstRow;
        for (int a = node.FirstBlock; a < node.FirstBlock + node.BlockCount; ++a)
        {
            var block = numbers + blocks[a].Place;
            ref var later = ref nodes[blocks[a].Joint];
            if (later.IsHeld)
                continue;
            for (int row = 0; row < later.RowCount; ++row, block += count)
            {
                double sum = 0;
                for (int i = 0; i < count; ++i)
                    sum += block[i] * x[i].X;
                rows[later.FirstRow + row].X -= sum;
            }
        }
    }

    void GoBack(in DirectNode node)
    {
        var count = node.RowCount;
        var x = rows + node.FirstRow;
        for (int a = node.FirstBlock; a < node.FirstBlock + node.BlockCount; ++a)
        {
            var block = numbers + blocks[a].Place;
            ref var later = ref nodes[blocks[a].Joint];
            if (later.IsHeld)
                continue;
            for (int row = 0; row < later.RowCount; ++row, block += count)
            {
                var known = rows[later.FirstRow + row].X;
                for (int i = 0; i < count; ++i)
                    x[i].X -= x[i].InversePivot * block[i] * known;
            }
        }
    }

    void SolveBack(in DirectNode node)
    {
        var count = node.RowCount;
        var x = rows + node.FirstRow;
        var diagonal = numbers + node.Diagonal;
        for (int row = count - 2; row >= 0; --row)
        {
            for (int i = row + 1; i < count; ++i)
                x[row].X -= diagonal[i * count + row] * x[i].X;
        }
    }

    void Apply(in DirectNode node)
    {
        for (int i = 0; i < node.RowCount; ++i)
        {
            ref var row = ref rows[node.FirstRow + i];
            row.Impulse += row.X;
            Apply(node, i, row.X);
        }
    }

    void Apply(in DirectNode node, int row, double impulse)
    {
        var w = weighted + node.Jacobian + row * node.BodyCount;
        for (int slot = 0; slot < node.BodyCount; ++slot, ++w)
            bodies[node.Bodies[slot]].Velocity.Add(*w, impulse);
    }
}
