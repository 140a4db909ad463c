using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// What has sunk into what carries it does not sleep before it is out again.
//
// A stack that falls faster than the load path holds it sinks in on soft contacts as it lands, by up to some hundredths of its boxes. At rest it is held, and
// held contacts push it out by a part of the overlap in each substep, which the load path takes for a motion and stops in the next one. So it rises for some
// seconds, by some millimetres in each, and that is so slow that it would fall asleep long before, and stay as it was for ever.
//
// What is pushed out may be kept from it, by a neighbour that is in the way: that would never sleep. So it is asked only of islands in which nothing
// touches or holds a body but what the graph knows, as it is with stacks and walls, and hardly ever with heaps.
sealed unsafe partial class LoadPathStage
{
    // Overlap that is worth waiting for, in half widths of the band in which held contacts know none.
    const float LeastOverlap = 6;

    // An island sleeps as a whole, so it is enough that one of its bodies does not.
    void KeepAwake(int start, int end)
    {
        if (KnowsAll(start, end))
            bodies.Awake.Activity[graph.Nodes[start].Body].TimestepsUnderThresholdCount = 0;
    }

    bool AnyIsSunken(int start, int end)
    {
        for (int node = start; node < end; ++node)
        {
            if (graph.Nodes[node].IsSunken)
                return true;
        }
        return false;
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

    // Each patch is a constraint of its upper body, and of the lower one if it has any.
    bool KnowsAll(int start, int end)
    {
        int patches = 0, constraints = 0;
        for (int node = start; node < end; ++node)
        {
            ref var carried = ref graph.Nodes[node];
            constraints += bodies.Awake.Constraints[carried.Body].Count;
            for (int i = carried.FirstSupport; i < carried.FirstSupport + carried.SupportCount; ++i)
                patches += graph.Links[i].Lower >= 0 ? 2 : 1;
        }
        return patches == constraints;
    }
}
