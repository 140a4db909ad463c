namespace BepuPhysics.Constraints;

// Limits, servos and motors among the joints of a structure: rows whose impulse has bounds.
//
// Each is either solved with all others, or held: left out, with an impulse at its bound, which is none for a limit. Who is held in a substep is foreseen from
// the impulses of the last one, and reviewed when all velocities are known: what was pushed beyond its bound is held there from now on, and what is held, and
// would go back inside by itself, is solved with the others again. Then all is solved anew. As a rule the first review finds nothing. After a few the last
// word is with the bounds: all that have some keep what they have, brought within, and the others are solved once more. So no bound is overstepped, joints
// that hold both ways are always met, and there is an end to the work.
//
// Of structures side by side those are left as they are that need no other review; their equations come out the same when they are worked out once more.
readonly unsafe partial struct DirectEquations<TVectors, TNumbers>
{
    // How often it may be changed who is held.
    const int MostReviews = 4;
    // Impulses are kept in single precision: one that was at its bound is that close to it.
    const double AtBound = 1 - 1e-6;
    // And one that was just let go is no further beyond than that.
    const double BeyondBound = 1 + 1e-9;
    // Part of the greatest impulse by which one that is held has to turn for all to be solved anew.
    const double LeastTurn = 1e-3;

    /// <summary>Solves for the impulses, and applies what changes of them.</summary>
    /// <param name="mask">The structures in which it does.</param>
    /// <param name="isFactored">Whether there are factors of the same bodies and rows, but for who is held.</param>
    internal void Solve(TNumbers mask, bool isFactored = false)
    {
        // Not before all else has been swept over: what is worked out here is still at hand when it is asked for.
        if (!isFactored)
            FactorAll();
        else if (hasBounds)
            FactorChanged();
        SolveOnce(mask);
        if (!hasBounds)
            return;
        var open = mask;
        for (int review = 0; review < MostReviews; ++review)
        {
            Review(open, out var whoIsHeld, out var impulses);
            open = whoIsHeld | impulses;
            if (!TNumbers.Any(open))
                return;
            if (TNumbers.Any(whoIsHeld))
                FactorChanged();
            SolveOnce(open);
        }
        open = HoldWhatIsBeyond(open);
        if (!TNumbers.Any(open))
            return;
        for (int k = firstNode; k < endNode; ++k)
        {
            if (nodes[k].HasBounds)
                holds[k].IsHeld |= open;
        }
        FactorChanged();
        SolveOnce(open);
    }

    // By the impulses of the last substep, which are brought within bounds that may have become narrower since.
    void Foresee(int joint)
    {
        ref var node = ref nodes[joint];
        ref var hold = ref holds[joint];
        ClearChange(node);
        var length = LengthOf(node);
        hold.IsHeld = node.Limit == RowLimit.Positive
            ? TNumbers.AtMost(rows[node.FirstRow].Impulse, default)
            : TNumbers.AtMost(hold.MostImpulse * TNumbers.Of(AtBound), length);
        var isBeyond = IsBeyond(joint, length);
        if (!TNumbers.Any(isBeyond))
            return;
        FindProjection(joint, length);
        for (int i = 0; i < node.RowCount; ++i)
        {
            ref var row = ref rows[node.FirstRow + i];
            Write(ref row.Impulse, row.Impulse + row.X, isBeyond);
        }
    }

    // Of some structures: in which it has changed who is held, and in which impulses of those that are.
    void Review(TNumbers open, out TNumbers whoIsHeld, out TNumbers impulses)
    {
        whoIsHeld = impulses = default;
        // First those that are held, all by the same velocities. What they would do by themselves, as in a sweep, says where they belong.
        for (int k = firstNode; k < endNode; ++k)
        {
            if (!nodes[k].HasBounds)
                continue;
            var held = open & holds[k].IsHeld;
            if (!TNumbers.Any(held))
                continue;
            Ask(k);
            ref var node = ref nodes[k];
            if (node.Limit == RowLimit.Positive)
            {
                held &= TNumbers.Above(rows[node.FirstRow].X, default);
                if (!TNumbers.Any(held))
                    continue;
                Lean(node, held);
            }
            SolveForward(node);
            SolveBack(node);
            var length = LengthOf(node);
            var goesBack = held & (node.Limit == RowLimit.Positive
                ? TNumbers.Above(length, default)
                : TNumbers.Above(holds[k].MostImpulse, length));
            holds[k].IsHeld &= ~goesBack;
            whoIsHeld |= goesBack;
            FindProjection(k, length);
        }
        for (int k = firstNode; k < endNode; ++k)
        {
            // A limit has no other bound than none.
            if (nodes[k].Limit != RowLimit.Length)
                continue;
            var turns = open & holds[k].IsHeld;
            if (!TNumbers.Any(turns))
                continue;
            turns &= Turns(k);
            if (!TNumbers.Any(turns))
                continue;
            Apply(nodes[k], turns);
            impulses |= turns;
        }
        whoIsHeld |= HoldWhatIsBeyond(open);
    }

    // Whether a limit that nothing leans on in any structure. Most are: all that is worked out of them is whether something begins to.
    bool IsIdle(int joint) => nodes[joint].Limit == RowLimit.Positive && !TNumbers.Any(IsFree(joint));

    // A limit asks for an impulse: what it takes to say how large.
    void Lean(in DirectNode node, TNumbers mask)
    {
        Weigh(node);
        AddDiagonal(node, mask);
        FactorDiagonal(node, mask);
    }

    TNumbers HoldWhatIsBeyond(TNumbers open)
    {
        TNumbers any = default;
        for (int k = firstNode; k < endNode; ++k)
        {
            if (!nodes[k].HasBounds)
                continue;
            var beyond = open & IsFree(k);
            if (!TNumbers.Any(beyond))
                continue;
            ClearChange(nodes[k]);
            var length = LengthOf(nodes[k]);
            beyond &= IsBeyond(k, length);
            if (!TNumbers.Any(beyond))
                continue;
            FindProjection(k, length);
            Apply(nodes[k], beyond);
            holds[k].IsHeld |= beyond;
            any |= beyond;
        }
        return any;
    }

    void ClearChange(in DirectNode node)
    {
        for (int i = 0; i < node.RowCount; ++i)
            rows[node.FirstRow + i].X = default;
    }

    // Of the impulse with the change that is asked for; of a limit, which has one row, with its sign.
    TNumbers LengthOf(in DirectNode node)
    {
        if (node.Limit == RowLimit.Positive)
            return rows[node.FirstRow].Impulse + rows[node.FirstRow].X;
        TNumbers sum = default;
        for (int i = 0; i < node.RowCount; ++i)
        {
            var value = rows[node.FirstRow + i].Impulse + rows[node.FirstRow + i].X;
            sum += value * value;
        }
        return TNumbers.Root(sum);
    }

    TNumbers IsBeyond(int joint, TNumbers length) => nodes[joint].Limit == RowLimit.Positive
        ? TNumbers.Above(default, length)
        : TNumbers.Above(length, holds[joint].MostImpulse * TNumbers.Of(BeyondBound));

    // The change to the nearest impulse within bounds.
    void FindProjection(int joint, TNumbers length)
    {
        ref var node = ref nodes[joint];
        TNumbers part = default;
        if (node.Limit != RowLimit.Positive)
            part = (holds[joint].MostImpulse / length) & TNumbers.Above(length, default);
        for (int i = 0; i < node.RowCount; ++i)
        {
            ref var row = ref rows[node.FirstRow + i];
            row.X = (row.Impulse + row.X) * part - row.Impulse;
        }
    }

    TNumbers Turns(int joint)
    {
        ref var node = ref nodes[joint];
        TNumbers sum = default;
        for (int i = 0; i < node.RowCount; ++i)
            sum += rows[node.FirstRow + i].X * rows[node.FirstRow + i].X;
        var least = TNumbers.Of(LeastTurn) * holds[joint].MostImpulse;
        return TNumbers.Above(sum, least * least);
    }
}
