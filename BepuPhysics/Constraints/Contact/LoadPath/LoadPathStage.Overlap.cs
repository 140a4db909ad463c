using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

// What has sunk into what carries it does not sleep before it is out again.
//
// A stack that falls faster than the load path holds it sinks in on soft contacts as it lands, by up to some hundredths of its boxes. At rest it is held, and
// held contacts push it out by a part of the overlap in each substep, which the load path takes for a motion and stops in the next one. So it rises for some
// seconds, by some millimetres in each, and that is so slow that it would fall asleep long before, and stay as it was for ever.
//
// What is pushed out may be kept from it, by a neighbour that is in the way: that would never sleep. So it is asked only of islands in which nothing
// touches or holds a body but what the graph knows, as it is with stacks and walls, and hardly ever with heaps. Those are pushed out slowly.
sealed unsafe partial class LoadPathStage
{
    // Overlap that is worth waiting for, in half widths of the band in which held contacts know none.
    internal const float LeastOverlap = 6;

    // Part of its overlap that a patch of a heap does not know. What is left is taken out as fast as that of others, so that all of it takes twenty times as
    // long: at four substeps of a sixtieth, two seconds.
    const float HeapShare = 0.95f;
    // Of an island: whether the graph knows all that touches or holds its bodies.
    const byte NotAsked = 0, Known = 1, Missed = 2;

    Buffer<byte> knowledge;

    // A heap is an island with more than the graph knows: an edge, a side or a joint that is in the way. Held contacts are rigid, so what they push out as fast
    // as elsewhere presses those with ever more force, until its body is no longer quiet and is let go; it sinks in on its soft contacts, rests, is held again,
    // and so on for ever. Pushed out slowly the others give way in time.
    //
    // A body that touches the ground alone is pushed out of it as fast as anywhere: what stands on feet by its joints bears down on them as before.
    bool IsOfHeap(in SupportLink link, int node) => (link.Lower >= 0 || TouchesOthers(link.Upper)) && !Knows(graph.IslandOf(node));

    bool TouchesOthers(int body)
    {
        foreach (var constraint in new BodyConstraints(solver, bodies.Awake.Constraints[body]))
        {
            var typeId = solver.Locations[constraint.ConnectingConstraintHandle.Slot].TypeId;
            if (typeId is >= ConstraintTypeIds.ContactTwoBody and < ConstraintTypeIds.ContactTypeCount)
                return true;
        }
        return false;
    }

    // An island sleeps as a whole, so it is enough that one of its bodies does not.
    void KeepAwake(int island)
    {
        if (Knows(island))
            bodies.Awake.Activity[graph.Nodes[graph.Islands[island]].Body].TimestepsUnderThresholdCount = 0;
    }

    void FindOverlaps(int start, int end, ref LoadNode first)
    {
        for (int node = start; node < end; ++node)
        {
            if (graph.Nodes[node].IsSunken)
                first.HasSunken = true;
            if (graph.Nodes[node].Overlaps)
                first.HasOverlaps = true;
        }
    }

    // On a body in the mean of its contacts, as what lands askew has most of it on one side. On the ground with all of them: a box on the uneven ground of a
    // mesh has it at one corner, and keeps it there. What is clamped has a wider band, and stays as it is.
    static bool IsSunken(in SupportLink link, float band)
    {
        float sum = 0, least = float.MaxValue;
        for (int i = 0; i < link.Count; ++i)
        {
            sum += DepthOf(link, i);
            least = MathHelper.Min(least, DepthOf(link, i));
        }
        return (link.HasTwoBodies ? sum / link.Count : least) > LeastOverlap * band;
    }

    // Whoever asks finds the same. What others write meanwhile, as each begins with its nodes, leaves their bodies what they are.
    bool Knows(int island)
    {
        ref var known = ref knowledge[island];
        if (known == NotAsked)
            known = CountUnknown(island) == 0 ? Known : Missed;
        return known == Known;
    }

    int CountUnknown(int island)
    {
        int count = 0;
        for (int node = graph.Islands[island]; node < graph.Islands[island + 1]; ++node)
        {
            var body = graph.Nodes[node].Body;
            count += bodies.Awake.Constraints[body].Count - graph.CountEnds(body);
        }
        return count;
    }
}
