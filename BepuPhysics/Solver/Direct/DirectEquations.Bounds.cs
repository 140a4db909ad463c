using System;

namespace BepuPhysics.Constraints;

// Limits, servos and motors among the joints of a structure: rows whose impulse has bounds.
//
// Each is either solved with all others, or held: left out, with an impulse at its bound, which is none for a limit. Who is held in a substep is foreseen from
// the impulses of the last one, and reviewed when all velocities are known: what was pushed beyond its bound is held there from now on, and what is held, and
// would go back inside by itself, is solved with the others again. Then all is solved anew. As a rule the first review finds nothing. After a few the last
// word is with the bounds: all that have some keep what they have, brought within, and the others are solved once more. So no bound is overstepped, joints
// that hold both ways are always met, and there is an end to the work.
readonly unsafe partial struct DirectEquations
{
    // How often it may be changed who is held.
    const int MostReviews = 4;
    // Impulses are kept in single precision: one that was at its bound is that close to it.
    const double AtBound = 1 - 1e-6;
    // And one that was just let go is no further beyond than that.
    const double BeyondBound = 1 + 1e-9;
    // Part of the greatest impulse by which one that is held has to turn for all to be solved anew.
    const double LeastTurn = 1e-3;

    enum Change
    {
        None,
        Impulses,
        WhoIsHeld,
    }

    /// <summary>Solves for the impulses, and applies what changes of them.</summary>
    internal void Solve(in DirectIsland island)
    {
        SolveOnce(island);
        if (!island.HasBounds)
            return;
        for (int review = 0; review < MostReviews; ++review)
        {
            var change = Review(island);
            if (change == Change.None)
                return;
            if (change == Change.WhoIsHeld)
                Factor(island);
            SolveOnce(island);
        }
        if (!HoldWhatIsBeyond(island))
            return;
        for (int k = island.FirstNode; k < island.EndNode; ++k)
            nodes[k].IsHeld = nodes[k].HasBounds;
        Factor(island);
        SolveOnce(island);
    }

    // By the impulses of the last substep, which are brought within bounds that may have become narrower since.
    void Foresee(ref DirectNode node)
    {
        ClearChange(node);
        var length = LengthOf(node);
        node.IsHeld = node.Limit == RowLimit.Positive ? rows[node.FirstRow].Impulse <= 0 : length >= node.MostImpulse * AtBound;
        if (!IsBeyond(node, length))
            return;
        FindProjection(node, length);
        for (int i = 0; i < node.RowCount; ++i)
            rows[node.FirstRow + i].Impulse += rows[node.FirstRow + i].X;
    }

    Change Review(in DirectIsland island)
    {
        var change = Change.None;
        // First those that are held, all by the same velocities. What they would do by themselves, as in a sweep, says where they belong.
        for (int k = island.FirstNode; k < island.EndNode; ++k)
        {
            ref var node = ref nodes[k];
            if (!node.IsHeld)
                continue;
            Ask(node);
            if (IsIdle(node) && !MayLean(node))
                continue;
            SolveForward(node);
            SolveBack(node);
            var length = LengthOf(node);
            if (node.Limit == RowLimit.Positive ? length > 0 : length < node.MostImpulse)
            {
                node.IsHeld = false;
                change = Change.WhoIsHeld;
            }
            else
                FindProjection(node, length);
        }
        for (int k = island.FirstNode; k < island.EndNode; ++k)
        {
            if (!nodes[k].IsHeld || !Turns(nodes[k]))
                continue;
            Apply(nodes[k]);
            change = change == Change.None ? Change.Impulses : change;
        }
        return HoldWhatIsBeyond(island) ? Change.WhoIsHeld : change;
    }

    // A limit that nothing leans on. Most are: all that is worked out of them is whether something begins to.
    static bool IsIdle(in DirectNode node) => node.IsHeld && node.Limit == RowLimit.Positive;

    // Whether a limit asks for an impulse; what it takes to say how large is worked out then.
    bool MayLean(in DirectNode node)
    {
        if (!(rows[node.FirstRow].X > 0))
        {
            ClearChange(node);
            return false;
        }
        Weigh(node);
        AddDiagonal(node);
        FactorDiagonal(node);
        return true;
    }

    bool HoldWhatIsBeyond(in DirectIsland island)
    {
        var any = false;
        for (int k = island.FirstNode; k < island.EndNode; ++k)
        {
            ref var node = ref nodes[k];
            if (!node.HasBounds || node.IsHeld)
                continue;
            ClearChange(node);
            var length = LengthOf(node);
            if (!IsBeyond(node, length))
                continue;
            FindProjection(node, length);
            Apply(node);
            node.IsHeld = true;
            any = true;
        }
        return any;
    }

    void ClearChange(in DirectNode node)
    {
        for (int i = 0; i < node.RowCount; ++i)
            rows[node.FirstRow + i].X = 0;
    }

    // Of the impulse with the change that is asked for; of a limit, which has one row, with its sign.
    double LengthOf(in DirectNode node)
    {
        double sum = 0;
        for (int i = 0; i < node.RowCount; ++i)
        {
            var value = rows[node.FirstRow + i].Impulse + rows[node.FirstRow + i].X;
            if (node.Limit == RowLimit.Positive)
                return value;
            sum += value * value;
        }
        return Math.Sqrt(sum);
    }

    static bool IsBeyond(in DirectNode node, double length) => node.Limit == RowLimit.Positive ? length < 0 : length > node.MostImpulse * BeyondBound;

    // The change to the nearest impulse within bounds.
    void FindProjection(in DirectNode node, double length)
    {
        var part = node.Limit == RowLimit.Positive || !(length > 0) ? 0 : node.MostImpulse / length;
        for (int i = 0; i < node.RowCount; ++i)
        {
            ref var row = ref rows[node.FirstRow + i];
            row.X = (row.Impulse + row.X) * part - row.Impulse;
        }
    }

    bool Turns(in DirectNode node)
    {
        double sum = 0;
        for (int i = 0; i < node.RowCount; ++i)
            sum += rows[node.FirstRow + i].X * rows[node.FirstRow + i].X;
        return sum > LeastTurn * node.MostImpulse * (LeastTurn * node.MostImpulse);
    }
}
