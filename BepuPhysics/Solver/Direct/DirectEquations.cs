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
readonly unsafe partial struct DirectEquations<TVectors, TNumbers>(
    in DirectPlan plan, in DirectIsland island, in DirectMemory<TVectors, TNumbers> memory, bool keepsFactors = true)
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
    readonly bool keepsFactors = keepsFactors;
    readonly TNumbers* numbers = memory.Numbers;
    readonly DirectPair<TVectors, TNumbers>* jacobians = memory.Jacobians;
    readonly DirectPair<TVectors, TNumbers>* weighted = memory.Weighted;
    readonly DirectRow<TNumbers>* rows = memory.Rows;
    readonly DirectHold<TNumbers>* holds = memory.Holds;
    readonly DirectBody<TVectors, TNumbers>* bodies = memory.Bodies;
    readonly DirectState* states = memory.States;
    readonly int* live = memory.Live;
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
        for (int k = firstNode; k < endNode; ++k)
        {
            if (IsIdle(k))
                continue;
            var mask = nodes[k].Limit == RowLimit.Positive ? ~holds[k].IsHeld : TNumbers.All;
            ApplyRows(nodes[k], rows + nodes[k].FirstRow, changes: false, mask);
        }
    }

    /// <summary>Takes the impulses back from the bodies of some structures, which they stay known of. None of these has bounds.</summary>
    internal void TakeBack(TNumbers mask)
    {
        for (int k = firstNode; k < endNode; ++k)
        {
            for (int i = 0; i < nodes[k].RowCount; ++i)
                rows[nodes[k].FirstRow + i].X = default(TNumbers) - rows[nodes[k].FirstRow + i].Impulse;
            ApplyRows(nodes[k], rows + nodes[k].FirstRow, changes: true, mask);
        }
    }

    /// <summary>Gives them to bodies that have other inertias since.</summary>
    internal void GiveAgain(TNumbers mask)
    {
        for (int k = firstNode; k < endNode; ++k)
        {
            Weigh(nodes[k]);
            ApplyRows(nodes[k], rows + nodes[k].FirstRow, changes: false, mask);
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
                if (node.SeesLinear)
                    w->Linear = j->Linear * inverseMass;
                w->Angular = x * j->Angular.X + y * j->Angular.Y + z * j->Angular.Z;
            }
        }
    }
}
