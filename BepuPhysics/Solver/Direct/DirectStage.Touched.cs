using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

// Contacts push and never pull. What they see of a structure is its velocities by the impulses of the substep before; where these are not
// what joints need now, as after a blow, light links seem to fly apart. Contacts stop those that fly into something and let the others
// go, and when the joints have taken it back what the contacts have pushed stays: chains of light links with heavy ends that came to lie
// on a floor were thrown about, some of them without end. So in structures of which anything touches something joints are met before the
// sweeps, too, and contacts see bodies that move as they can.
sealed unsafe partial class DirectStage
{
    // Number of joints of each body of each island that are solved at once.
    Buffer<int> jointCounts;
    // For each island, a bit for each of its structures of which a body has constraints besides. Found in the first substep of a step.
    Buffer<int> touched;

    void CountJoints()
    {
        var bodyCount = plan.Bodies.Count / DirectPlan.Lanes;
        pool.Take(bodyCount, out jointCounts);
        pool.Take(plan.Islands.Count, out touched);
        jointCounts.Clear(0, bodyCount);
        foreach (ref var node in plan.Nodes.AsSpan())
        {
            for (int slot = 0; slot < node.BodyCount; ++slot)
                ++jointCounts[node.Bodies[slot]];
        }
    }

    int IndexOf(in DirectIsland island) => plan.Nodes[island.FirstNode].Island;

    void FindTouched(in DirectIsland island)
    {
        ref var constraints = ref bodies.Awake.Constraints;
        var lanes = 0;
        for (int i = island.FirstBody; i < island.FirstBody + island.DynamicCount; ++i)
        {
            for (int lane = 0; lane < island.MemberCount; ++lane)
                lanes |= (constraints[plan.Bodies[i * DirectPlan.Lanes + lane]].Count > jointCounts[i] ? 1 : 0) << lane;
        }
        touched[IndexOf(island)] = lanes;
    }
}
