using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Moves the load of what rests on others down to the ground in one go, where the sweeps have not yet.</summary>
// A sweep moves a load over one contact. So a stack of n bodies knows its weight after n of them, and until then it sinks; contacts that are soft enough
// to be stable meanwhile stay soft, and a stack of 100 boxes a metre shorter. Here each body, from the top down, hands the momentum that it has left after
// the warm start to what it rests on (LoadTransfer); what that does to all of an island is taken as far as it lowers the kinetic energy of the island, which
// at rest is the measure of what contacts are after, so that the stage can give none.
//
// The contacts through which a load is handed are held: they keep the speed of their surfaces at zero with no softness, and know no overlap within a band
// about zero. A soft row would give back in the sweep what it was handed.
sealed unsafe partial class LoadPathStage(Solver solver, Bodies bodies, BufferPool pool) : ISolverStage
{
    // Bundles, bodies, nodes and islands share this many blocks at most; any number gives the same bits.
    const int MaximumBlocks = 16;
    const int LeastBundlesPerBlock = 8;
    const int LeastBodiesPerBlock = 256;
    // Steps of acceleration up to which a contact is quiet.
    internal const float QuietSteps = 2;
    // Part of its tolerance up to which a body that rests alone is none of the graph's: half, as it may have more left after other substeps than the first.
    const float AloneShare = 0.5f;
    // Part of the tolerance from which on a body takes part, and from which on an island is worked on again that was worked on in the last substep.
    const float ActiveShare = 0.05f;

    SupportGraph graph;
    // Velocities of the centres before the first integration; in the place of the angular ones, where there are floors, those of the last step.
    Buffer<BodyVelocity> before;
    // Of floors, angular velocities before the first integration, in the place of the linear ones; in that of the angular ones those of the last step.
    Buffer<BodyVelocity> turnsBefore;
    // Room for one link per lane of all bundles of contacts; each block begins where its bundles do.
    Buffer<SupportLink> found;
    // Per body, whether something pushes it from the side that is not among what was found.
    Buffer<byte> spoilt;
    int bundleCount;
    int blockCount;
    // What each block has found in its room.
    readonly (int Start, int Count)[] pieces = new (int, int)[MaximumBlocks];
    // What carries the nodes of the island that a block is working on. Only one at a time: in the first step of a scene each island has something to
    // hand down, and all of their supports would be more memory than the contacts themselves.
    Buffer<LoadSupport> supports;
    // The same for what is relaxed, and for its bodies; not there if nothing is.
    Buffer<PatchRelaxation> patches;
    Buffer<BodyRelaxation> relaxedBodies;
    // The same for columns; not there if none sways.
    Buffer<ColumnBlock> columns;
    // Where each block reads the supports of an island, and where it relaxes its patches and bodies.
    readonly int[] rooms = new int[MaximumBlocks];
    readonly int[] patchRooms = new int[MaximumBlocks];
    readonly int[] bodyRooms = new int[MaximumBlocks];
    // Of each block: whether contacts that it has found may be held, and which it holds that are none of the graph's.
    readonly bool[] mayHold = new bool[MaximumBlocks];
    readonly LoneRests[] lone = new LoneRests[MaximumBlocks];
    // Whether any island that each block has worked on tips over.
    readonly bool[] hasTipped = new bool[MaximumBlocks];
    // Of each block: patches that were relaxed, once for each round.
    readonly int[] relaxed = new int[MaximumBlocks];
    bool hasBegun;

    /// <summary>Patches that were relaxed in the last step, once for each round: what that costs.</summary>
    internal int RelaxedCount
    {
        get
        {
            var sum = 0;
            foreach (var count in relaxed)
                sum += count;
            return sum;
        }
    }

    /// <summary>Bodies that the graph of the last step has.</summary>
    internal int NodeCount => graph.Nodes.Count;

    LoadPathMode Mode => solver.LoadPath;

    bool ISolverStage.ChangesVelocities => false;

    bool ISolverStage.BeginStep()
    {
        relaxed.AsSpan().Clear();
        if (Mode == LoadPathMode.Off)
            return false;
        bundleCount = ContactBundles.Count(solver.ActiveSet);
        if (bundleCount == 0)
            return false;
        blockCount = Math.Min(MaximumBlocks, (bundleCount + LeastBundlesPerBlock - 1) / LeastBundlesPerBlock);
        pool.TakeAtLeast(Math.Max(1, bodies.Awake.Count), out before);
        pool.TakeAtLeast(Math.Max(1, bodies.Awake.Count), out turnsBefore);
        pool.TakeAtLeast(Math.Max(1, bundleCount * Vector<float>.Count), out found);
        pool.TakeAtLeast(Math.Max(1, bodies.Awake.Count), out spoilt);
        spoilt.Clear(0, bodies.Awake.Count);
        hasBegun = true;
        mayHold.AsSpan(0, blockCount).Fill(true);
        return true;
    }

    int ISolverStage.GetBlockCount(SolverPoint point) => point switch
    {
        SolverPoint.BeforeSubsteps => BodyBlockCount,
        SolverPoint.LastBeforeSubsteps or SolverPoint.AmidBeforeFirstWarmStart => 1,
        SolverPoint.BeforeFirstWarmStart or SolverPoint.LastBeforeFirstWarmStart or
            SolverPoint.AfterWarmStart or SolverPoint.LastAfterWarmStart or SolverPoint.AfterSubsteps => blockCount,
        _ => 0,
    };

    // Where nothing rests on anything, or all of it alone, there is no graph to work on.
    int ISolverStage.CountBlocks(SolverPoint point, int most) => point switch
    {
        SolverPoint.LastBeforeSubsteps when !HasFloors && !HasElsewhere => 0,
        SolverPoint.AfterWarmStart when graph.Nodes.Count == 0 && !HasRiders => 0,
        SolverPoint.LastBeforeFirstWarmStart or SolverPoint.LastAfterWarmStart when graph.Nodes.Count == 0 => 0,
        _ => most,
    };

    int BodyBlockCount => Math.Clamp(bodies.Awake.Count / LeastBodiesPerBlock, 1, MaximumBlocks);

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        switch (point)
        {
            case SolverPoint.BeforeSubsteps:
                CopyVelocities(block);
                break;
            case SolverPoint.LastBeforeSubsteps:
                if (HasElsewhere)
                    FindElsewhere();
                if (HasFloors)
                    FindReached();
                break;
            case SolverPoint.BeforeFirstWarmStart:
                Find(block, substep);
                break;
            case SolverPoint.AmidBeforeFirstWarmStart:
                Build(substep.Dt);
                break;
            case SolverPoint.LastBeforeFirstWarmStart:
                Fill(block, substep.Dt);
                break;
            case SolverPoint.AfterWarmStart:
                PushRiders(block, substep.Index);
                FindLoads(block, substep);
                break;
            case SolverPoint.LastAfterWarmStart:
                for (int island = block; island < graph.Islands.Count - 1; island += blockCount)
                    Transfer(island, block, substep);
                break;
            case SolverPoint.AfterSubsteps:
                var length = substep.Dt * solver.LastSubstepCount;
                if (HasFloors || hasTipped.AsSpan(0, blockCount).Contains(true))
                    TurnPatches(block, length);
                LetGo(block, HasFloors ? length : 0);
                break;
        }
    }

    void CopyVelocities(int block)
    {
        ref var set = ref bodies.Awake;
        var end = FirstOf(block + 1, BodyBlockCount, set.Count);
        var (hasFloors, hasElsewhere) = (false, false);
        for (int i = FirstOf(block, BodyBlockCount, set.Count); i < end; ++i)
        {
            before[i].Linear = set.MotionStates[i].Velocity.Linear;
            if (set.LocalInertias[i].InverseMass != 0)
                continue;
            hasElsewhere |= Bodies.IsMovedByPose(set, i);
            FindMotion(i);
            hasFloors |= IsFloor(i);
        }
        hasFloorsIn[block] = hasFloors;
        hasElsewhereIn[block] = hasElsewhere;
    }

    ContactBundles BundlesOf(int block) =>
        new(ref solver.ActiveSet, FirstOf(block, blockCount, bundleCount), FirstOf(block + 1, blockCount, bundleCount));

    static int FirstOf(int block, int blockCount, int count) => (int)((long)count * block / blockCount);

    void Find(int block, in Substep substep)
    {
        ref var set = ref bodies.Awake;
        var awake = new SolverBodies(set);
        var finder = new SupportFinder(
            awake, before.Memory, turnsBefore.Memory, set.Constraints.Memory, spoilt.Memory, reached.Memory, elsewhere.Memory,
            QuietSteps * solver.LastSubstepCount, new RestTolerance(Mode == LoadPathMode.Always ? 0 : AloneShare, substep.Dt), substep.WarmStartScale,
            substep.Dt);
        var start = FirstOf(block, blockCount, bundleCount);
        var links = found.Memory + start * Vector<float>.Count;
        int count = 0;
        lone[block] = new() { Riders = riders.Memory + (riders.Allocated ? start * Vector<float>.Count : 0) };
        hasTipped[block] = false;
        for (var bundles = BundlesOf(block); bundles.MoveNext();)
        {
            for (int i = bundles.First; i < bundles.End; ++i)
                count += finder.Find(ref bundles.TypeBatch, i, links + count, ref lone[block]);
        }
        pieces[block] = (start * Vector<float>.Count, count);
    }

    void Build(float dt)
    {
        var used = pieces.AsSpan(0, blockCount);
        int count = 0;
        foreach (var piece in used)
            count += piece.Count;
        if (count == 0)
        {
            graph.Dispose(pool);
            return;
        }
        ref var set = ref bodies.Awake;
        var motions = new Motions(solver, set.MotionStates, before, turnsBefore, set.LocalInertias, set.Constraints, solver.LastSubstepCount, dt);
        var byHandle = SortByHandle();
        graph.Build(found.Memory, used, set.Count, spoilt, motions, pool, byHandle);
        pool.ReturnIfTaken(ref byHandle);
        MakeRooms();
    }

    // Nothing where bodies lie in the order of their handles, as they do until one of them goes or sleeps.
    Buffer<int> SortByHandle()
    {
        ref var set = ref bodies.Awake;
        var isInOrder = true;
        for (int i = 1; i < set.Count; ++i)
            isInOrder &= set.IndexToHandle[i].Slot > set.IndexToHandle[i - 1].Slot;
        if (isInOrder)
            return default;
        pool.TakeAtLeast<int>(set.Count, out var byHandle);
        for (int slot = 0, count = 0; count < set.Count; ++slot)
        {
            if (bodies.Locations[slot].SetIndex == 0)
                byHandle[count++] = bodies.Locations[slot].Index;
        }
        return byHandle;
    }

    void MakeRooms()
    {
        int supportCount = 0, patchCount = 0, relaxedCount = 0;
        for (int block = 0; block < blockCount; ++block)
        {
            int mostSupports = 0, mostPatches = 0, mostBodies = 0;
            for (int island = block; island < graph.Islands.Count - 1; island += blockCount)
            {
                var count = EndOfSupports(island) - FirstSupport(island);
                mostSupports = Math.Max(mostSupports, count);
                if (!MayRelax(island))
                    continue;
                mostPatches = Math.Max(mostPatches, count);
                // And one for what does not move.
                mostBodies = Math.Max(mostBodies, BodiesOf(island) + 1);
            }
            (rooms[block], patchRooms[block], bodyRooms[block]) = (supportCount, patchCount, relaxedCount);
            supportCount += mostSupports;
            patchCount += mostPatches;
            relaxedCount += mostBodies;
        }
        pool.TakeAtLeast(Math.Max(1, supportCount), out supports);
        pool.TakeAtLeast(graph.Islands.Count, out knowledge);
        knowledge.Clear(0, graph.Islands.Count);
        if (relaxedCount > 0)
        {
            pool.TakeAtLeast(Math.Max(1, patchCount), out patches);
            pool.TakeAtLeast(relaxedCount, out relaxedBodies);
        }
        if (graph.LongestColumn > 0)
            pool.TakeAtLeast(blockCount * graph.LongestColumn, out columns);
    }

    bool MayRelax(int island)
    {
        ref var first = ref graph.Nodes[graph.Islands[island]];
        return first.IsRelaxed || first.IsOfColumn || first.MayBeColumn ||
            (Mode == LoadPathMode.Always && SupportGraph.MayTip(BodiesOf(island)));
    }

    int BodiesOf(int island) => graph.Islands[island + 1] - graph.Islands[island];

    int FirstSupport(int island) => graph.Nodes[graph.Islands[island]].FirstSupport;

    int EndOfSupports(int island)
    {
        ref var last = ref graph.Nodes[graph.Islands[island + 1] - 1];
        return last.FirstSupport + last.SupportCount;
    }

    void Fill(int block, float dt)
    {
        var start = FirstOf(block, blockCount, graph.Nodes.Count);
        var end = FirstOf(block + 1, blockCount, graph.Nodes.Count);
        graph.Fill(found.Memory, start, end);
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            SetTolerance(ref node, dt);
            if (node.Floor >= 0)
                FindFloorChange(ref node);
            var turns = Turns(node);
            for (int j = node.FirstSupport; j < node.FirstSupport + node.SupportCount; ++j)
            {
                ref var link = ref graph.Links[j];
                var depth = GreatestDepth(link);
                var band = BandOf(link, i, depth);
                var isLifted = depth > band && MayLift(node);
                link.Spring = ContactMaterialWide.HeldSpring(band, turns, isLifted);
                node.Overlaps |= isLifted;
                node.IsSunken |= depth > LeastOverlap * band && IsSunken(link, band);
            }
        }
    }

    // What a heavy body has left of its velocity is much to a light one below.
    void SetTolerance(ref LoadNode node, float dt)
    {
        ref var set = ref bodies.Awake;
        var inverseMass = set.LocalInertias[node.Body].InverseMass;
        var ratio = 1f;
        for (int i = node.FirstSupport; i < node.FirstSupport + node.SupportCount; ++i)
        {
            var lower = graph.Links[i].Lower;
            if (lower >= 0)
                ratio = MathHelper.Min(ratio, inverseMass / set.LocalInertias[lower].InverseMass);
        }
        node.Gain = Exact.Length(set.MotionStates[node.Body].Velocity.Linear - before[node.Body].Linear);
        node.Tolerance = new RestTolerance(ratio, dt).Of(node.Gain, node.Radius);
    }

    // Finds which bodies of a block have something to hand down, and in which islands that is worth while for any of them.
    void FindLoads(int block, in Substep substep)
    {
        var start = FirstOf(block, blockCount, graph.Nodes.Count);
        var end = FirstOf(block + 1, blockCount, graph.Nodes.Count);
        if (start == end)
            return;
        if (HasFloors)
            PushAlong(start, end, substep.Index);
        if (HasFloors && substep.Index == 0)
            FindLags(start, end);
        for (int island = graph.IslandOf(start); start < end; ++island)
        {
            ref var first = ref graph.Nodes[graph.Islands[island]];
            var endOfIsland = Math.Min(end, graph.Islands[island + 1]);
            if (substep.Index == 0)
                FindOverlaps(start, endOfIsland, ref first);
            // Who has the others of the island can but say the same.
            if (HasLoads(start, endOfIsland, first.IsActive, MotionOf(first, substep.Dt)))
                first.NeedsWork = true;
            start = endOfIsland;
        }
    }

    bool HasLoads(int start, int end, bool isActive, in FloorMotion floor)
    {
        ref var set = ref bodies.Awake;
        // What was taken out in the last substep came from more than one, so its impulses overshoot now: until that has died down, less counts.
        var share = Mode == LoadPathMode.Always ? 0 : isActive ? ActiveShare : 1;
        var needsWork = false;
        for (int i = start; i < end; ++i)
        {
            ref var node = ref graph.Nodes[i];
            ref var velocity = ref set.MotionStates[node.Body].Velocity;
            var speed = Exact.Length(velocity.Linear - floor.At(set.MotionStates[node.Body].Pose.Position - node.Lag)) +
                Exact.Length(velocity.Angular - floor.Angular) * node.Radius;
            node.HasLoad = speed > node.Tolerance * MathHelper.Min(share, ActiveShare);
            needsWork |= speed > node.Tolerance * share;
            node.Linear = default;
            node.Angular = default;
        }
        return needsWork;
    }
}
