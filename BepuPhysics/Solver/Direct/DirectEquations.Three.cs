using System.Runtime.CompilerServices;

namespace BepuPhysics.Constraints;

// Blocks of joints of three rows, as point joints have, and of one, as limits have: the same as those of any number, to the last bit, but what is known of the
// joint stays in registers, and nothing is counted.
readonly unsafe partial struct DirectEquations<TVectors, TNumbers>
{
    const int Three = 3;

    static void FactorThree(TNumbers* block, DirectRow<TNumbers>* ofRows, TNumbers mask)
    {
        var one = TNumbers.Of(1);
        var first = block[0];
        var inverse = (one / first) & TNumbers.Above(first, ofRows[0].LeastPivot);
        Write(ref ofRows[0].InversePivot, inverse, mask);
        var (a, b) = (block[3] * inverse, block[6] * inverse);
        Write(ref block[3], a, mask);
        Write(ref block[6], b, mask);
        var second = block[4] - a * a * first;
        Write(ref block[4], second, mask);
        inverse = (one / second) & TNumbers.Above(second, ofRows[1].LeastPivot);
        Write(ref ofRows[1].InversePivot, inverse, mask);
        var c = (block[7] - b * a * first) * inverse;
        Write(ref block[7], c, mask);
        var third = block[8] - b * b * first - c * c * second;
        Write(ref block[8], third, mask);
        inverse = (one / third) & TNumbers.Above(third, ofRows[2].LeastPivot);
        Write(ref ofRows[2].InversePivot, inverse, mask);
    }

    // Of two bodies. This and the next for one structure alone, whose sums within vectors are made two at a time: lanes took longer by them.
    static void AddDiagonalThree(
        TNumbers* block, DirectPair<TVectors, TNumbers>* j, DirectPair<TVectors, TNumbers>* w, DirectRow<TNumbers>* ofRows, TNumbers scale, TNumbers mask)
    {
        var (first, second) = TVectors.Sums(OfBoth(j, w), OfBoth(j + 2, w));
        Write(ref block[0], first * scale, mask);
        Write(ref block[3], second * scale, mask);
        (first, second) = TVectors.Sums(OfBoth(j + 2, w + 2), OfBoth(j + 4, w));
        Write(ref block[4], first * scale, mask);
        Write(ref block[6], second * scale, mask);
        (first, second) = TVectors.Sums(OfBoth(j + 4, w + 2), OfBoth(j + 4, w + 4));
        Write(ref block[7], first * scale, mask);
        Write(ref block[8], second * scale, mask);
        for (int row = 0; row < Three; ++row)
            Write(ref ofRows[row].LeastPivot, TNumbers.Of(LeastPivot) * block[row * (Three + 1)], mask);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static TVectors OfBoth(DirectPair<TVectors, TNumbers>* j, DirectPair<TVectors, TNumbers>* w) =>
        default(TVectors) + DirectPair<TVectors, TNumbers>.Multiply(j[0], w[0]) + DirectPair<TVectors, TNumbers>.Multiply(j[1], w[1]);

    static void AddCouplingThree(
        TNumbers* block, DirectPair<TVectors, TNumbers>* j, int stride, int rowCount, DirectPair<TVectors, TNumbers>* w, int strideOfW, bool isFirst)
    {
        for (; rowCount > 0; --rowCount, j += stride, block += Three)
        {
            var (first, second) = TVectors.Sums(
                DirectPair<TVectors, TNumbers>.Multiply(*j, *w), DirectPair<TVectors, TNumbers>.Multiply(*j, w[strideOfW]));
            var third = TVectors.Sum(DirectPair<TVectors, TNumbers>.Multiply(*j, w[2 * strideOfW]));
            block[0] = (isFirst ? default : block[0]) + first;
            block[1] = (isFirst ? default : block[1]) + second;
            block[2] = (isFirst ? default : block[2]) + third;
        }
    }

    static void ScaleThree(TNumbers* diagonal, TNumbers* block, int rowCount)
    {
        var (a, b, c) = (diagonal[3], diagonal[6], diagonal[7]);
        for (; rowCount > 0; --rowCount, block += Three)
        {
            var (first, second) = (block[0], block[1] - block[0] * a);
            block[1] = second;
            block[2] = block[2] - first * b - second * c;
        }
    }

    void EliminateThree(int joint)
    {
        ref var node = ref nodes[joint];
        ref var state = ref states[joint];
        var ofBlocks = blocks + node.FirstBlock;
        var places = live + node.FirstBlock;
        var pivots = rows + node.FirstRow;
        var (x, y, z) = (pivots[0].InversePivot, pivots[1].InversePivot, pivots[2].InversePivot);
        var isFree = IsFree(joint);
        var scaled = stackalloc TNumbers[DirectPlan.MostRows * Three];
        for (int i = 0; i < state.LiveCount; ++i)
        {
            ref var a = ref ofBlocks[places[i]];
            ref var ofA = ref states[a.Joint];
            var left = numbers + a.Place;
            for (int row = 0; row < a.RowCount * Three; row += Three)
                (scaled[row], scaled[row + 1], scaled[row + 2]) = (left[row] * x, left[row + 1] * y, left[row + 2] * z);
            var target = targets + node.FirstTarget + places[i] * (places[i] + 1) / 2;
            for (int l = 0; l < i; ++l)
            {
                ref var b = ref ofBlocks[places[l]];
                if (!Changes(state, ofA, states[b.Joint]))
                    continue;
                var place = numbers + target[places[l]];
                for (int row = 0; row < a.RowCount * Three; row += Three)
                    SubtractThree(scaled + row, numbers + b.Place, ref place, b.RowCount, isFree);
            }
            if (!ofA.IsColumn)
                continue;
            var diagonal = numbers + target[places[i]];
            var mask = isFree & OwnBlock(a.Joint);
            // What is above the diagonal of the matrix nobody reads.
            for (int row = 0; row < a.RowCount; ++row, diagonal += a.RowCount - row)
                SubtractThree(scaled + row * Three, left, ref diagonal, row + 1, mask);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void SubtractThree(TNumbers* scaled, TNumbers* right, ref TNumbers* target, int columns, TNumbers mask)
    {
        var (first, second, third) = (scaled[0], scaled[1], scaled[2]);
        for (; columns > 0; --columns, right += Three, ++target)
            *target = TNumbers.Choose(mask, *target - (first * right[0] + second * right[1] + third * right[2]), *target);
    }

    void EliminateOne(int joint)
    {
        ref var node = ref nodes[joint];
        ref var state = ref states[joint];
        var ofBlocks = blocks + node.FirstBlock;
        var places = live + node.FirstBlock;
        var inversePivot = rows[node.FirstRow].InversePivot;
        var isFree = IsFree(joint);
        var scaled = stackalloc TNumbers[DirectPlan.MostRows];
        for (int i = 0; i < state.LiveCount; ++i)
        {
            ref var a = ref ofBlocks[places[i]];
            ref var ofA = ref states[a.Joint];
            var left = numbers + a.Place;
            for (int row = 0; row < a.RowCount; ++row)
                scaled[row] = left[row] * inversePivot;
            var target = targets + node.FirstTarget + places[i] * (places[i] + 1) / 2;
            for (int l = 0; l < i; ++l)
            {
                ref var b = ref ofBlocks[places[l]];
                if (!Changes(state, ofA, states[b.Joint]))
                    continue;
                var place = numbers + target[places[l]];
                for (int row = 0; row < a.RowCount; ++row)
                    SubtractOne(scaled[row], numbers + b.Place, ref place, b.RowCount, isFree);
            }
            if (!ofA.IsColumn)
                continue;
            var diagonal = numbers + target[places[i]];
            var mask = isFree & OwnBlock(a.Joint);
            for (int row = 0; row < a.RowCount; ++row, diagonal += a.RowCount - row)
                SubtractOne(scaled[row], left, ref diagonal, row + 1, mask);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void SubtractOne(TNumbers scaled, TNumbers* right, ref TNumbers* target, int columns, TNumbers mask)
    {
        for (; columns > 0; --columns, ++right, ++target)
            *target = TNumbers.Choose(mask, *target - scaled * *right, *target);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void SolveForwardThree(TNumbers* diagonal, DirectRow<TNumbers>* x)
    {
        var first = x[0].X;
        var second = x[1].X - diagonal[3] * first;
        var third = x[2].X - diagonal[6] * first - diagonal[7] * second;
        x[0].X = first * x[0].InversePivot;
        x[1].X = second * x[1].InversePivot;
        x[2].X = third * x[2].InversePivot;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void SolveBackThree(TNumbers* diagonal, DirectRow<TNumbers>* x)
    {
        var (second, third) = (x[1].X, x[2].X);
        second -= diagonal[7] * third;
        x[1].X = second;
        x[0].X = x[0].X - diagonal[3] * second - diagonal[6] * third;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void GoForwardThree(TNumbers* block, DirectRow<TNumbers>* x, DirectRow<TNumbers>* later, int rowCount, TNumbers mask)
    {
        var (first, second, third) = (x[0].X, x[1].X, x[2].X);
        for (int row = 0; row < rowCount; ++row, block += Three)
        {
            var sum = default(TNumbers) + block[0] * first + block[1] * second + block[2] * third;
            Write(ref later[row].X, later[row].X - sum, mask);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void GoBackThree(TNumbers* block, DirectRow<TNumbers>* x, DirectRow<TNumbers>* later, int rowCount, TNumbers mask)
    {
        var (x0, x1, x2) = (x[0].InversePivot, x[1].InversePivot, x[2].InversePivot);
        var (first, second, third) = (x[0].X, x[1].X, x[2].X);
        for (int row = 0; row < rowCount; ++row, block += Three)
        {
            var known = later[row].X;
            first -= x0 * block[0] * known;
            second -= x1 * block[1] * known;
            third -= x2 * block[2] * known;
        }
        Write(ref x[0].X, first, mask);
        Write(ref x[1].X, second, mask);
        Write(ref x[2].X, third, mask);
    }
}
