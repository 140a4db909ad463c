using System;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

// Supports by the body that they carry, bodies from the ground upwards, and which of them are carried.
unsafe partial struct SupportGraph
{
    // By counting, so that supports of one body stay in the order in which they were found.
    void SortByUpper(SupportLink* found, ReadOnlySpan<(int Start, int Count)> pieces, int bodyCount, Buffer<byte> spoilt, BufferPool pool)
    {
        foreach (var piece in pieces)
        {
            for (int i = piece.Start; i < piece.Start + piece.Count; ++i)
                ++starts[found[i].Upper + 1];
        }
        for (int i = 0; i < bodyCount; ++i)
            starts[i + 1] += starts[i];
        pool.TakeAtLeast<int>(Math.Max(1, bodyCount), out var next);
        starts.CopyTo(0, next, 0, bodyCount);
        foreach (var piece in pieces)
        {
            for (int i = piece.Start; i < piece.Start + piece.Count; ++i)
            {
                ref var link = ref found[i];
                hasFloors |= link.Lower < SupportLink.Still;
                byUpper[next[link.Upper]++] = new()
                {
                    Found = i,
                    Upper = link.Upper,
                    Lower = link.Lower,
                    CarryingCount = (byte)link.CarryingCount,
                    Slides = link.Slides,
                    Leans = link.Leans,
                    Moves = link.Moves,
                    Sways = link.Sways,
                    IsWhole = link.IsWhole,
                    WasHeld = link.WasHeld,
                    IsSpoilt = link.Leans && IsSpoilt(link, spoilt),
                };
            }
        }
        pool.Return(ref next);
    }

    void LinkAbove(int bodyCount, Buffer<int> byHandle, BufferPool pool)
    {
        for (int i = bodyCount - 1; i >= 0; --i)
        {
            var body = byHandle.Allocated ? byHandle[i] : i;
            for (int j = starts[body + 1] - 1; j >= starts[body]; --j)
                LinkAbove(j, pool);
        }
    }

    void LinkAbove(int i, BufferPool pool)
    {
        var lower = byUpper[i].Lower;
        if (byUpper[i].Leans)
            leaning.Add(i, pool);
        else if (byUpper[i].Sways || (byUpper[i].IsWhole && byUpper[i].Moves))
            swaying.Add(i, pool);
        if (lower < 0 || byUpper[i].Leans || byUpper[i].Sways)
            return;
        ++waiting[byUpper[i].Upper];
        nextAbove[i] = above[lower];
        above[lower] = i;
    }

    // A body comes after all that it rests on. Where bodies rest on each other in a circle, the lowest that is left comes next.
    void OrderUpwards<TMotions>(int bodyCount, Buffer<int> byHandle, TMotions motions, BufferPool pool) where TMotions : struct, IHeights, IFloors
    {
        dependsOnMotion = hasFloors || swaying.Count > 0 || byHandle.Allocated;
        int participants = 0;
        for (int place = 0; place < bodyCount; ++place)
        {
            var i = byHandle.Allocated ? byHandle[place] : place;
            if (above[i] < 0 && starts[i + 1] == starts[i])
                continue;
            ++participants;
            if (waiting[i] == 0)
                order.Add(i, pool);
        }
        Buffer<int> byHeight = default;
        int lowest = 0;
        for (int taken = 0; taken < participants; ++taken)
        {
            if (taken == order.Count)
            {
                dependsOnMotion = true;
                if (!byHeight.Allocated)
                    SortByHeight(bodyCount, motions, pool, out byHeight);
                while (positions[byHeight[lowest]] >= 0 || waiting[byHeight[lowest]] == 0)
                    ++lowest;
                waiting[byHeight[lowest]] = 0;
                order.Add(byHeight[lowest], pool);
            }
            var body = order[taken];
            positions[body] = taken;
            grounded[body] = IsGrounded(body, motions) ? (byte)1 : (byte)0;
            for (int i = above[body]; i >= 0; i = nextAbove[i])
            {
                var upper = byUpper[i].Upper;
                if (positions[upper] < 0 && waiting[upper] > 0 && --waiting[upper] == 0)
                    order.Add(upper, pool);
            }
        }
        pool.ReturnIfTaken(ref byHeight);
    }

    static void SortByHeight<THeights>(int bodyCount, THeights heights, BufferPool pool, out Buffer<int> byHeight) where THeights : struct, IHeights
    {
        pool.Take(bodyCount, out byHeight);
        pool.Take<HeightOfBody>(bodyCount, out var keys);
        for (int i = 0; i < bodyCount; ++i)
            keys[i] = new() { Height = heights.Of(i), Body = i };
        var lowestFirst = default(LowestFirst);
        QuickSort.Sort(new Span<HeightOfBody>(keys.Memory, bodyCount), ref lowestFirst);
        for (int i = 0; i < bodyCount; ++i)
            byHeight[i] = keys[i].Body;
        pool.Return(ref keys);
    }

    struct HeightOfBody
    {
        public float Height;
        public int Body;
    }

    struct LowestFirst : IComparerRef<HeightOfBody>
    {
        public readonly int Compare(ref HeightOfBody a, ref HeightOfBody b) => a.Height != b.Height ? a.Height.CompareTo(b.Height) : a.Body.CompareTo(b.Body);
    }

    // What slides on all that it rests on moves.
    readonly bool IsGrounded<TMotions>(int body, TMotions motions) where TMotions : struct, IFloors
    {
        if (hasFloors)
            floors[body] = FloorOf(body, motions);
        int contacts = 0;
        var slides = true;
        for (int i = starts[body]; i < starts[body + 1]; ++i)
        {
            if (byUpper[i].Leans || !Carries(byUpper[i]))
                continue;
            contacts += byUpper[i].CarryingCount;
            slides &= byUpper[i].Slides;
        }
        return contacts >= SupportFinder.LeastContacts && !slides;
    }

    // What is below must itself be carried, and come earlier: what comes later hands its own load on too late.
    readonly bool Carries(in Support support) => !support.Sways && IsBelow(support) && (hasFloors ? SharesFloor(support) : !support.Moves);

    readonly bool IsBelow(in Support support) => support.Lower < 0 ||
        (grounded[support.Lower] != 0 && positions[support.Lower] < positions[support.Upper]);
}
