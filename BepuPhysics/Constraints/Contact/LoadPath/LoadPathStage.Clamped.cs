using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// What is clamped, as a crate between a door and a wall, in the jaws of a crane or under a press, or a foot that a joint presses into the ground.
//
// A held contact takes out what overlap is beyond its band by a velocity, with no softness. Where something that does not give way presses a body into it,
// that velocity is undone in each sweep. If that is a held contact too, as where a body leans on a thing at either side, both add to their impulses without
// end; no load shows it as they cancel, and the one that is left throws the body when the other opens. If it is soft, its body is no longer quiet once the
// held contact has added enough, is let go, rests, is held again, and so on: it stirs, and never sleeps.
//
// What holds a load bears a part of the weight of its island, or some times that where the faces are steep. A patch that bears more, and overlaps, is
// clamped: there is no way out for it, so the overlap that it has is taken to be none for this step. It goes on to hold the load.
//
// What falls on an island bears on it as much, but gives way: so a patch that does not lean is asked only where a joint, or something that nothing moves and
// that does not carry it, holds a body of the island. Heaps on open ground, and in pits as far as was seen, know nothing of all that.
sealed unsafe partial class LoadPathStage
{
    // Weights of its island beyond which a patch that leans is clamped. A semicircular arch presses its stones with about one, a flat one of a twentieth of
    // its span with two and a half; between two walls a body presses each with one over twice the coefficient of friction. To be wrong costs only that
    // overlaps stay as they are. What a body is thrown with in the end is what is below this: eight substeps of gravity, .3 m/s.
    const float LeaningShare = 8;
    // The same of others. A foot bears by its joints what stands on it, and is to come out of the ground: a machine's of 80 kg on four of 1 kg some twenty.
    // A servo that presses a foot so that it stirs does it with more than 64, a press with more than 128.
    const float PressedShare = 32;
    // Half the width of the band in which a patch that overlaps by some depth at most knows none.
    float BandOf(in SupportLink link, int node, float depth)
    {
        if (!(depth > link.Band))
            return link.Band;
        if (IsClamped(link, node))
            return depth;
        return IsOfHeap(link, node) ? MathHelper.Max(link.Band, HeapShare * depth) : link.Band;
    }

    static float GreatestDepth(in SupportLink link)
    {
        float depth = 0;
        for (int i = 0; i < link.Count; ++i)
            depth = MathHelper.Max(depth, DepthOf(link, i));
        return depth;
    }

    static float DepthOf(in SupportLink link, int contact) =>
        link.Prestep[(contact * ContactPrestepLayout.FloatsPerContact + ContactPrestepLayout.Depth) * Vector<float>.Count];

    // Most patches are not, and need to know but a few bodies for it.
    bool IsClamped(in SupportLink link, int node)
    {
        var island = graph.IslandOf(node);
        var start = graph.Islands[island];
        var end = graph.Islands[island + 1];
        var load = Load(link.Impulses, link.Count) / (link.Leans ? LeaningShare : PressedShare);
        if (!IsMoreThanWeight(load, node, end) || !IsMoreThanWeight(load, start, end))
            return false;
        if (link.Leans)
            return true;
        for (int i = start; i < end; ++i)
        {
            if (IsPressed(graph.Nodes[i].Body))
                return true;
        }
        return false;
    }

    // Whether an impulse is more than what a substep of the acceleration from outside gives some bodies of an island, each in its own direction.
    bool IsMoreThanWeight(float impulse, int start, int end)
    {
        ref var set = ref bodies.Awake;
        float weight = 0;
        for (int i = start; i < end && weight < impulse; ++i)
        {
            var body = graph.Nodes[i].Body;
            weight += Exact.Length(GainOf(body)) / set.LocalInertias[body].InverseMass;
        }
        return weight < impulse;
    }

    // Whether a joint holds a body, or something pushes it that nothing moves, and that is too steep to carry it or above it.
    bool IsPressed(int body)
    {
        ref var set = ref bodies.Awake;
        var gain = GainOf(body);
        var list = set.Constraints[body];
        for (int i = 0, edge = list.First; i < list.Count; ++i, edge = solver.Edges.Next(edge))
        {
            ref var location = ref solver.Locations[solver.Edges.ConstraintSlot(edge)];
            if (location.TypeId >= ConstraintTypeIds.ContactTypeCount)
                return true;
            var place = new ContactPlace(solver, ref solver.TypeBatchAt(location), location.IndexInTypeBatch);
            var count = ConstraintTypeIds.ContactCount(location.TypeId);
            if (!place.IsFixedB || Load(place.Impulses, count) <= 0)
                continue;
            var normal = place.Prestep + ContactPrestepLayout.Normal(count) * Vector<float>.Count;
            var against = -Exact.Dot(gain, new Vector3(normal[0], normal[Vector<float>.Count], normal[2 * Vector<float>.Count]));
            if (against <= SupportFinder.LeastSlope * Exact.Length(gain))
                return true;
        }
        return false;
    }

    Vector3 GainOf(int body) => bodies.Awake.MotionStates[body].Velocity.Linear - before[body].Linear;

    static float Load(float* impulses, int count)
    {
        float load = 0;
        for (int i = 0; i < count; ++i)
            load += impulses[i * Vector<float>.Count];
        return load;
    }
}
