using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// What is clamped, as a crate between a door and a wall, or in the jaws of a crane.
//
// A held contact takes out what overlap is beyond its band by a velocity, with no softness. Where a body leans on two things that do not give way and
// overlaps both, each of the two velocities undoes the other, and each sweep adds both to the impulses: they grow without end, no load shows it as they
// cancel, and the one that is left throws the body when the other opens. A contact that is soft gives back as much as it adds in the end.
//
// What holds a load bears a part of the weight of its island, or some times that where the faces are steep. A patch that bears more, and overlaps, is
// clamped: there is no way out for it, so the overlap that it has is taken to be none for this step. It goes on to hold the load.
sealed unsafe partial class LoadPathStage
{
    // Weights of its island beyond which a patch of those that lean is clamped. A semicircular arch presses its stones with about one, a flat one of a
    // twentieth of its span with two and a half; between two walls a body presses each with one over twice the coefficient of friction. To be wrong costs
    // only that overlaps stay as they are. What a body is thrown with in the end is what is below this: eight substeps of gravity, .3 m/s.
    const float ClampedShare = 8;

    // Half the width of the band in which a patch knows no overlap.
    float BandOf(in SupportLink link, int node)
    {
        if (!link.Leans)
            return link.Band;
        var width = Vector<float>.Count;
        float depth = 0, load = 0;
        for (int i = 0; i < link.Count; ++i)
        {
            depth = MathHelper.Max(depth, link.Prestep[(i * ContactPrestepLayout.FloatsPerContact + ContactPrestepLayout.Depth) * width]);
            load += link.Impulses[i * width];
        }
        return depth > link.Band && load > ClampedShare * Weight(graph.IslandOf(node)) ? depth : link.Band;
    }

    // What a substep of the acceleration from outside gives all bodies of an island, each in its own direction, N s.
    float Weight(int island)
    {
        ref var set = ref bodies.Awake;
        float weight = 0;
        for (int i = graph.Islands[island]; i < graph.Islands[island + 1]; ++i)
        {
            var body = graph.Nodes[i].Body;
            var gain = Exact.Length(set.MotionStates[body].Velocity.Linear - before[body].Linear);
            weight += gain / set.LocalInertias[body].InverseMass;
        }
        return weight;
    }
}
