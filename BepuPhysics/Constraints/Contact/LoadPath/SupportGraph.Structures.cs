using System;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

// Structures: bodies that stand on each other, from what does not move or a floor upwards, each on as many others as it likes.
unsafe partial struct SupportGraph
{
    // Of what is grounded: that it is of a structure that sways.
    const byte OfStructure = 4;
    /// <summary>Most bodies of a structure.</summary>
    internal const int MaximumStructure = 512;
    /// <summary>Most supports of one of its bodies.</summary>
    internal const int MaximumSupports = 32;
    const int FirstRoom = 64;
    // Of a body of the structure that is looked at: that it has no place yet.
    const int Unplaced = int.MaxValue;

    // Lists of a structure that is looked at, from the pool while any is.
    struct Structure
    {
        // All that is connected, then what is carried from the ground upwards.
        internal QuickList<int> Bodies, Placed;
        // What stands on each of those that are placed.
        internal QuickList<StandingLoad> Loads;
        // As in the place of a lower body.
        internal int Floor;
    }

    // What moves too fast to rest, and is of no column, is carried all the same where it is of a structure that is balanced, and in which none moves faster
    // than what sways but what may be on top. So that nothing which falls over is held on its way, that is asked in each step. What is balanced may rock on its
    // edges, and has fewer contacts than rest then.
    void FindStructures<TMotions>(SupportLink* found, TMotions motions, BufferPool pool) where TMotions : struct, IFloors
    {
        var structure = new Structure
        {
            Bodies = new(FirstRoom, pool),
            Placed = new(FirstRoom, pool),
            Loads = new(FirstRoom, pool),
        };
        var hasAny = false;
        foreach (var i in swaying.AsSpan())
        {
            var body = byUpper[i].Upper;
            if (grounded[body] != 0 || waiting[body] == Refused)
                continue;
            var isStructure = FindFloor(body, ref structure) && Gather(body, motions, ref structure, pool) &&
                !IsHit(structure.Bodies, motions) && Place(ref structure, pool) && IsBalanced(found, motions, ref structure, pool);
            foreach (var other in structure.Bodies.AsSpan())
                waiting[other] = Refused;
            if (!isStructure)
                continue;
            hasAny = true;
            foreach (var other in structure.Placed.AsSpan())
                AddToStructure(other, structure.Floor, pool);
        }
        structure.Bodies.Dispose(pool);
        structure.Placed.Dispose(pool);
        structure.Loads.Dispose(pool);
        if (hasAny)
            CloseOrder();
    }

    readonly bool FindFloor(int body, ref Structure structure)
    {
        structure.Bodies.Count = structure.Placed.Count = structure.Loads.Count = 0;
        for (int length = 0; length < MaximumStructure; ++length)
        {
            int i = starts[body];
            while (i < starts[body + 1] && byUpper[i].Leans)
                ++i;
            if (i == starts[body + 1])
                return false;
            structure.Floor = body = byUpper[i].Lower;
            if (body < 0)
                return true;
        }
        return false;
    }

    // Goes through all that is connected. What moves too fast may be on top, but carries nothing.
    bool Gather<TMotions>(int start, TMotions motions, ref Structure structure, BufferPool pool) where TMotions : struct, IFloors
    {
        if (!Reach(start, motions, ref structure, pool))
            return false;
        for (int i = 0; i < structure.Bodies.Count; ++i)
        {
            var body = structure.Bodies[i];
            for (int j = starts[body]; j < starts[body + 1]; ++j)
            {
                ref var support = ref byUpper[j];
                if (support.Leans)
                    continue;
                if (support.Lower < 0)
                {
                    if (support.Lower != structure.Floor)
                        return false;
                }
                else if (!Reach(support.Lower, motions, ref structure, pool) || waiting[support.Lower] != Unplaced)
                    return false;
                if (IsLost(support, SupportLink.Floor(structure.Floor), motions))
                    return false;
            }
            for (int j = above[body]; j >= 0; j = nextAbove[j])
            {
                if (!byUpper[j].Leans && !Reach(byUpper[j].Upper, motions, ref structure, pool))
                    return false;
            }
        }
        return true;
    }

    // What moves too fast is on top of a structure and none of it; but not what rests, whose load nobody would know.
    bool Reach<TMotions>(int body, TMotions motions, ref Structure structure, BufferPool pool) where TMotions : struct, IFloors
    {
        if (waiting[body] == Unplaced)
            return true;
        if (waiting[body] == Refused || grounded[body] == OfColumn || structure.Bodies.Count == MaximumStructure)
            return false;
        if (!motions.Sways(body, SupportLink.Floor(structure.Floor)))
            return grounded[body] == 0;
        waiting[body] = Unplaced;
        structure.Bodies.Add(body, pool);
        return true;
    }

    // From the ground upwards, each after all that carries it.
    bool Place(ref Structure structure, BufferPool pool)
    {
        foreach (var body in structure.Bodies.AsSpan())
        {
            if (!WaitsForOthers(body))
                structure.Placed.Add(body, pool);
        }
        for (int i = 0; i < structure.Placed.Count; ++i)
            waiting[structure.Placed[i]] = i;
        for (int i = 0; i < structure.Placed.Count; ++i)
        {
            for (int j = above[structure.Placed[i]]; j >= 0; j = nextAbove[j])
            {
                var upper = byUpper[j].Upper;
                if (byUpper[j].Leans || waiting[upper] != Unplaced || WaitsForOthers(upper))
                    continue;
                waiting[upper] = structure.Placed.Count;
                structure.Placed.Add(upper, pool);
            }
        }
        // Where bodies lie on each other in a circle nobody is the next.
        return structure.Placed.Count > 1 && structure.Placed.Count == structure.Bodies.Count;
    }

    readonly bool WaitsForOthers(int body)
    {
        for (int i = starts[body]; i < starts[body + 1]; ++i)
        {
            if (!byUpper[i].Leans && byUpper[i].Lower >= 0 && waiting[byUpper[i].Lower] == Unplaced)
                return true;
        }
        return false;
    }

    // From the top down, what stands on each body is asked to be over what the body stands on.
    readonly bool IsBalanced<TMotions>(SupportLink* found, TMotions motions, ref Structure structure, BufferPool pool) where TMotions : struct, IFloors
    {
        Span<SupportLink> links = stackalloc SupportLink[MaximumSupports];
        Span<StandingLoad> parts = stackalloc StandingLoad[MaximumSupports];
        structure.Loads.EnsureCapacity(structure.Placed.Count, pool);
        structure.Loads.Count = structure.Placed.Count;
        structure.Loads.AsSpan().Clear();
        int contacts = 0;
        for (int i = structure.Placed.Count - 1; i >= 0; --i)
        {
            var body = structure.Placed[i];
            int count = 0;
            for (int j = starts[body]; j < starts[body + 1]; ++j)
            {
                if (byUpper[j].Leans)
                    continue;
                if (count == MaximumSupports)
                    return false;
                contacts += byUpper[j].CarryingCount;
                links[count++] = found[byUpper[j].Found];
            }
            // What is below rests on nothing that may bear it.
            if (count == 0)
                return false;
            ref var load = ref structure.Loads[i];
            if (!motions.IsBalanced(links[..count], SupportLink.Floor(structure.Floor), ref load, parts[..count]))
                return false;
            for (int j = 0; j < count; ++j)
            {
                if (links[j].Lower >= 0)
                    structure.Loads[waiting[links[j].Lower]].Add(parts[j]);
            }
        }
        // Of all together: a brick at the end of a row that rocks has two.
        return contacts >= SupportFinder.LeastContacts * structure.Placed.Count;
    }

    void AddToStructure(int body, int floor, BufferPool pool)
    {
        grounded[body] = OfStructure;
        if (hasFloors)
            floors[body] = floor;
        for (int i = starts[body]; i < starts[body + 1]; ++i)
            byUpper[i].Carries = !byUpper[i].Leans;
        // What rested had its place already.
        if (positions[body] >= 0)
            order[positions[body]] = -1;
        positions[body] = order.Count;
        order.Add(body, pool);
    }

    void CloseOrder()
    {
        int count = 0;
        for (int i = 0; i < order.Count; ++i)
        {
            if (order[i] < 0)
                continue;
            positions[order[i]] = count;
            order[count++] = order[i];
        }
        order.Count = count;
    }
}
