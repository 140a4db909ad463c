using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

// Bodies that lean on each other.
unsafe partial struct SupportGraph
{
    // Of what is grounded: that it leans.
    const byte Leans = 2;
    // Most bodies of an island that leans. A round carries a load over a body, so what is larger does not come to rest in as many as there are.
    const int MaximumRelaxed = 64;
    // What is known of a body's island while such are looked for.
    const int Refused = -1, Accepted = -2, Seen = -3;

    static bool IsSpoilt(in SupportLink link, Buffer<byte> spoilt) => spoilt[link.Upper] != 0 || (link.Lower >= 0 && spoilt[link.Lower] != 0);

    // What leans on each other, as the stones of an arch, is carried in no order from the ground upwards: such bodies are solved with all of their
    // neighbours at once. Between bodies that rest on the ground without it a steep patch does not count: boxes that stand side by side do not lean.
    // Where a body that leans is pushed by steep patches that are not quiet, or which are an edge or a point, nothing can be said of what it leans on.
    void FindLeaning<TMotions>(TMotions motions, BufferPool pool) where TMotions : struct, IFloors
    {
        for (int i = 0; i < leaning.Count; ++i)
        {
            ref var support = ref byUpper[leaning[i]];
            support.Carries = (grounded[support.Upper] == 0 || (support.Lower >= 0 && grounded[support.Lower] == 0)) &&
                grounded[support.Upper] < OfColumn && (support.Lower < 0 || grounded[support.Lower] < OfColumn) &&
                !(hasFloors && (IsOnFloor(support.Upper) || (support.Lower >= 0 && IsOnFloor(support.Lower))));
            if (!support.Carries || support.Lower < 0)
                continue;
            nextAbove[leaning[i]] = above[support.Lower];
            above[support.Lower] = leaning[i];
        }
        // Nothing waits any more: from here on that says whether the island of a body may be relaxed, once it was looked at.
        var island = new QuickList<int>(MaximumRelaxed, pool);
        for (int i = 0; i < leaning.Count; ++i)
        {
            ref var support = ref byUpper[leaning[i]];
            if (support.Carries && waiting[support.Upper] != Refused && waiting[support.Upper] != Accepted)
            {
                var verdict = MayRelax(support.Upper, ref island) ? Accepted : Refused;
                foreach (var body in island.AsSpan())
                    waiting[body] = verdict;
            }
        }
        island.Dispose(pool);
        var found = false;
        for (int i = 0; i < leaning.Count; ++i)
        {
            ref var support = ref byUpper[leaning[i]];
            support.Carries = support.Carries && waiting[support.Upper] == Accepted &&
                MayLean(support.Upper) && (support.Lower < 0 || MayLean(support.Lower));
        }
        for (int i = 0; i < leaning.Count; ++i)
        {
            ref var support = ref byUpper[leaning[i]];
            if (!support.Carries)
                continue;
            found = true;
            AddLeaning(support.Upper, pool);
            if (support.Lower >= 0)
                AddLeaning(support.Lower, pool);
        }
        // What rests on them is carried, too.
        for (int i = 0; found && i < order.Count; ++i)
        {
            if (grounded[order[i]] == 0 && IsGrounded(order[i], motions))
                grounded[order[i]] = 1;
        }
    }

    // Goes through all that is connected with a body.
    bool MayRelax(int start, ref QuickList<int> island)
    {
        island.Count = 0;
        waiting[start] = Seen;
        island.AddUnsafely(start);
        for (int i = 0; i < island.Count; ++i)
        {
            var body = island[i];
            for (int j = starts[body]; j < starts[body + 1]; ++j)
            {
                ref var support = ref byUpper[j];
                if (support.Leans && support.Carries && support.IsSpoilt)
                    return false;
                if ((!support.Leans || support.Carries) && support.Lower >= 0 && !Visit(support.Lower, ref island))
                    return false;
            }
            for (int j = above[body]; j >= 0; j = nextAbove[j])
            {
                if ((byUpper[j].Leans && byUpper[j].IsSpoilt) || !Visit(byUpper[j].Upper, ref island))
                    return false;
            }
        }
        return true;
    }

    bool Visit(int body, ref QuickList<int> island)
    {
        if (waiting[body] == Seen)
            return true;
        if (waiting[body] == Refused || island.Count == MaximumRelaxed)
            return false;
        waiting[body] = Seen;
        island.AddUnsafely(body);
        return true;
    }

    // Whether a body has contacts enough not to roll, and does not slide on all of them.
    readonly bool MayLean(int body)
    {
        if (grounded[body] != 0)
            return true;
        int contacts = 0;
        var slides = true;
        for (int i = starts[body]; i < starts[body + 1]; ++i)
            Count(byUpper[i], ref contacts, ref slides);
        for (int i = above[body]; i >= 0; i = nextAbove[i])
        {
            if (byUpper[i].Leans)
                Count(byUpper[i], ref contacts, ref slides);
        }
        return contacts >= SupportFinder.LeastContacts && !slides;
    }

    static void Count(in Support support, ref int contacts, ref bool slides)
    {
        contacts += support.CarryingCount;
        slides &= support.Slides;
    }

    void FindRelaxed(int islandCount)
    {
        for (int i = 0; i < islandCount; ++i)
        {
            for (int node = Islands[i]; node < Islands[i + 1]; ++node)
                Nodes[Islands[i]].IsRelaxed |= Nodes[node].Leans || Nodes[node].IsOfStructure;
        }
    }

    void AddLeaning(int body, BufferPool pool)
    {
        grounded[body] = Leans;
        if (hasFloors)
            floors[body] = SupportLink.Still;
        if (positions[body] >= 0)
            return;
        positions[body] = order.Count;
        order.Add(body, pool);
    }
}
