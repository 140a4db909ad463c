using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

// Columns: one body on the other, from what does not move or a floor upwards, each on a whole face.
unsafe partial struct SupportGraph
{
    // Of what is grounded: that it is of a column that sways.
    const byte OfColumn = 3;
    /// <summary>Most bodies of a column.</summary>
    internal const int MaximumColumn = 128;

    /// <summary>Whether an island of so many bodies is small enough to be relaxed if it tips over.</summary>
    internal static bool MayTip(int count) => count is >= 2 and <= MaximumStructure;

    // Islands whose bodies have one support each: where none bears two, they are columns.
    void FindSingle(int islandCount)
    {
        LongestColumn = 0;
        for (int i = 0; i < islandCount; ++i)
        {
            ref var first = ref Nodes[Islands[i]];
            var count = Islands[i + 1] - Islands[i];
            if (!MayTip(count))
                continue;
            if (count > MaximumColumn)
                continue;
            var isSingle = true;
            for (int j = Islands[i]; isSingle && j < Islands[i + 1]; ++j)
                isSingle = Nodes[j].SupportCount == 1;
            first.MayBeColumn = isSingle;
            if (isSingle && count > LongestColumn)
                LongestColumn = count;
        }
    }

    // What moves too fast to rest is carried all the same where it is of a column that nothing else touches or holds, but what may be on top of it. In the
    // order from the ground upwards it has no place, as the order of all others would be another then.
    void FindSwaying<TMotions>(SupportLink* found, int bodyCount, TMotions motions, BufferPool pool) where TMotions : struct, IFloors
    {
        foreach (var i in swaying.AsSpan())
        {
            ref var support = ref byUpper[i];
            if (!support.Sways || support.Lower < 0)
                continue;
            nextAbove[i] = above[support.Lower];
            above[support.Lower] = i;
        }
        // From here on, whether a body was looked at.
        waiting.Clear(0, bodyCount);
        var column = new QuickList<int>(MaximumColumn, pool);
        foreach (var i in swaying.AsSpan())
        {
            var body = byUpper[i].Upper;
            if (grounded[body] != 0 || !byUpper[i].IsWhole || !FindBottom(body, out var bottom))
                continue;
            if (IsColumn(found, bottom, motions, ref column))
                AddColumn(column);
            foreach (var other in column.AsSpan())
                waiting[other] = Seen;
        }
        column.Dispose(pool);
    }

    // The lowest below a body, if one stands on the other down to it, and none of them was looked at before.
    bool FindBottom(int body, out int bottom)
    {
        bottom = body;
        for (int length = 0; length < MaximumColumn; ++length)
        {
            if (waiting[bottom] == Seen || !StandsOnWholeFace(bottom))
                return false;
            waiting[bottom] = Seen;
            ref var support = ref byUpper[starts[bottom]];
            if (support.Lower < 0)
                return true;
            bottom = support.Lower;
        }
        return false;
    }

    readonly bool StandsOnWholeFace(int body) => starts[body + 1] - starts[body] == 1 && byUpper[starts[body]].IsWhole;

    // What lands moving aside rocks, and is held where all of it is balanced: so what falls over is not held again on its way. Else faces that were not held
    // are as if they were no faces.
    readonly bool IsColumn<TMotions>(SupportLink* found, int bottom, TMotions motions, ref QuickList<int> column) where TMotions : struct, IFloors
    {
        column.Count = 0;
        var isColumn = Climb(bottom, motions, ref column);
        int held = 0;
        while (held < column.Count && byUpper[starts[column[held]]].WasHeld)
            ++held;
        if (held < column.Count && !(isColumn && IsBalanced(column, found, motions)))
        {
            isColumn = grounded[column[held]] == 0;
            column.Count = held;
        }
        return isColumn && column.Count > 1 && Sways(column) && !IsHit(column, motions);
    }

    // What moves too fast, or on less than a face, is on top of a column and none of it; but not what rests, whose load nobody would know.
    readonly bool Climb<TMotions>(int bottom, TMotions motions, ref QuickList<int> column) where TMotions : struct, IFloors
    {
        var floor = SupportLink.Floor(byUpper[starts[bottom]].Lower);
        for (int body = bottom; ;)
        {
            if (starts[body + 1] - starts[body] != 1)
                return false;
            ref var support = ref byUpper[starts[body]];
            if (!support.IsWhole || IsLost(support, floor, motions) || !motions.Sways(body, floor))
            {
                if (grounded[body] != 0)
                    return false;
                break;
            }
            if (column.Count == MaximumColumn)
                return false;
            column.AddUnsafely(body);
            var next = above[body];
            // One below, and one above.
            var constraints = motions.CountConstraints(body);
            if (next < 0)
            {
                if (constraints > 2)
                    return false;
                break;
            }
            if (nextAbove[next] >= 0 || constraints != 2)
                return false;
            body = byUpper[next].Upper;
        }
        return true;
    }

    readonly bool Sways(in QuickList<int> column)
    {
        foreach (var body in column.AsSpan())
        {
            if (grounded[body] == 0)
                return true;
        }
        return false;
    }

    static bool IsHit<TMotions>(in QuickList<int> bodies, TMotions motions) where TMotions : struct, IFloors
    {
        foreach (var body in bodies.AsSpan())
        {
            if (motions.IsHit(body))
                return true;
        }
        return false;
    }

    readonly bool IsBalanced<TMotions>(in QuickList<int> column, SupportLink* found, TMotions motions) where TMotions : struct, IFloors
    {
        var floor = SupportLink.Floor(byUpper[starts[column[0]]].Lower);
        var load = default(StandingLoad);
        for (int i = column.Count - 1; i >= 0; --i)
        {
            if (!motions.IsBalanced(found[byUpper[starts[column[i]]].Found], floor, ref load))
                return false;
        }
        return true;
    }

    // Where both of its bodies rest to their floor, a support whose surfaces are not quiet is none, as on the ground.
    static bool IsLost<TMotions>(in Support support, int floor, TMotions motions) where TMotions : struct, IFloors =>
        floor >= 0 && support.Sways && support.Moves && motions.RestsOn(support.Upper, floor) && (support.Lower < 0 || motions.RestsOn(support.Lower, floor));

    void AddColumn(in QuickList<int> column)
    {
        var floor = byUpper[starts[column[0]]].Lower;
        foreach (var body in column.AsSpan())
        {
            grounded[body] = OfColumn;
            if (hasFloors)
                floors[body] = floor;
            byUpper[starts[body]].Carries = true;
        }
    }
}
