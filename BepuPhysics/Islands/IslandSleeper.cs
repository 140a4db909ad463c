using System;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Puts islands of bodies to sleep that have rested long enough.</summary>
/// <remarks>
/// A body rests while its speed is under its threshold, and may sleep when it has for as many steps as its description says. An island sleeps when all of
/// its dynamic bodies may and no kinematic body that moves touches it; a kinematic body sleeps when all that it holds does, and it has no velocity at all.
/// What sleeps costs no step anything.
/// </remarks>
// An island may sleep when the last of its bodies has rested long enough, so it is looked for in that step; and in every 32nd, as what held it may have
// gone. When it sleeps follows from its own bodies and the number of steps: what else there is in the world does not come into it, and a step without such a
// body ends here after two comparisons.
public sealed unsafe class IslandSleeper
{
    // Bodies that are put to sleep in one step, or as many of those that are awake; an island that has more goes as a whole. To fall asleep takes a body about
    // as long as a step, so that this bounds a step of very many by a part of itself. What is beyond waits a step for others, be they of another part of
    // the world: only there does it matter what else there is.
    const int LeastBodiesPerStep = 8192;
    const int ShareOfAwake = 4;
    const uint StepsBetweenLooks = 32;
    // Shortest step that counts as one of rest, s: of shorter ones one counts in each such time.
    const float LeastRestStep = 1f / 240;

    readonly Bodies bodies;
    readonly Solver solver;
    readonly SleepingIslands islands;
    readonly BufferPool pool;
    // Whether some had to wait in the last step.
    bool hasMore;

    internal IslandSleeper(Bodies bodies, Solver solver, SleepingIslands islands, BufferPool pool)
    {
        this.bodies = bodies;
        this.solver = solver;
        this.islands = islands;
        this.pool = pool;
    }

    /// <summary>Whether the coming step counts as one of those that a body must rest.</summary>
    // What is thrown up, or let go, is slower than any threshold for as long as it takes to gain its speed: .02 s in all, of .1 m/s on earth. The usual number
    // of steps is much longer, but in slow motion a great number of them is not: what was at its highest point, or at the end of its swing, would fall asleep
    // there and hang in the air. So steps are counted as if they were no shorter than those of 240 a second, by their number, which is part of the state.
    internal bool Counts(float dt) => !(dt < LeastRestStep) || solver.StepNumber % (uint)(LeastRestStep / dt) == 0;

    /// <summary>Puts islands to sleep, if there are such as may.</summary>
    internal void Update(IThreadDispatcher? dispatcher)
    {
        if (bodies.RipeCount == 0)
            return;
        var looksAtAll = hasMore || solver.StepNumber % StepsBetweenLooks == 0;
        if (!looksAtAll && bodies.JustRipenedCount == 0)
            return;
        var left = Math.Max(LeastBodiesPerStep, bodies.Awake.Count / ShareOfAwake);
        hasMore = false;
        var kinematics = new QuickList<int>(16, pool);
        pool.TakeAtLeast<RestKind>(Math.Max(1, bodies.Awake.Count), out var kinds);
        Classify(kinds, ref kinematics);
        var search = new IslandSearch(bodies, solver, kinds, pool);
        PutToSleep(search, looksAtAll, ref left, dispatcher);
        search.Dispose(pool);
        pool.Return(ref kinds);
        PutKinematicsToSleep(kinematics, looksAtAll, left);
        kinematics.Dispose(pool);
    }

    void PutToSleep(in IslandSearch search, bool looksAtAll, ref int left, IThreadDispatcher? dispatcher)
    {
        if (search.Count == 0)
            return;
        var slots = new QuickList<int>(search.BodyCount, pool);
        var ends = new QuickList<int>(search.Count, pool);
        for (int i = 0; i < search.Count; ++i)
        {
            var island = search.SlotsOf(i);
            // Who is no number is looked at here, where few are looked at, and keeps its island awake.
            if ((!looksAtAll && !HasJustRipened(island)) || !AreSound(island) || IsOnItsWay(island))
                continue;
            hasMore = slots.Count >= left;
            if (hasMore)
                break;
            foreach (var slot in island)
                slots.AddUnsafely(slot);
            ends.AddUnsafely(slots.Count);
        }
        left -= slots.Count;
        if (slots.Count > 0)
            islands.PutToSleep(slots.AsSpan(), ends.AsSpan(), dispatcher);
        slots.Dispose(pool);
        ends.Dispose(pool);
    }

    bool HasJustRipened(ReadOnlySpan<int> slots)
    {
        foreach (var slot in slots)
        {
            if (bodies.Awake.Activity[bodies.Locations[slot].Index].HasJustRipened)
                return true;
        }
        return false;
    }

    // What a game has written since the last step counts: a body that was given a velocity rests no more.
    void Classify(in Buffer<RestKind> kinds, ref QuickList<int> kinematics)
    {
        ref var set = ref bodies.Awake;
        for (int i = 0; i < set.Count; ++i)
        {
            ref var motion = ref set.MotionStates[i];
            ref var activity = ref set.Activity[i];
            var speed = Exact.LengthSquared(motion.Velocity.Linear) + Exact.LengthSquared(motion.Velocity.Angular);
            if (!Bodies.IsKinematic(set.LocalInertias[i]))
            {
                kinds[i] = activity.SleepCandidate && speed <= activity.SleepThreshold ? RestKind.Rests : RestKind.Holds;
                continue;
            }
            kinds[i] = speed == 0 ? RestKind.Fixed : RestKind.Holds;
            if (activity.SleepCandidate && speed == 0 && activity.SleepThreshold >= 0 && IsSound(ref set, i))
                kinematics.Add(set.IndexToHandle[i].Slot, pool);
        }
    }

    // What a kinematic body held has fallen asleep, or it held nothing when it came to rest.
    void PutKinematicsToSleep(in QuickList<int> kinematics, bool looksAtAll, int left)
    {
        var slots = kinematics.Span.AsSpan()[..kinematics.Count];
        slots.Sort();
        for (int i = 0; i < slots.Length; ++i)
        {
            var index = bodies.Locations[slots[i]].Index;
            var constraints = bodies.Awake.Constraints[index];
            if (constraints.AsleepCount < constraints.Count ||
                (!looksAtAll && constraints.Count == 0 && !bodies.Awake.Activity[index].HasJustRipened))
                continue;
            if (left <= 0)
            {
                hasMore = true;
                return;
            }
            islands.PutToSleep(slots.Slice(i, 1), [1]);
            --left;
        }
    }

    /// <summary>Puts a body that exists to sleep with its island, whether it rests or not; a kinematic body with all islands that it holds.</summary>
    /// <exception cref="InvalidOperationException">A pose, a velocity or an inertia is no number; nothing was changed.</exception>
    internal void Sleep(BodyHandle body)
    {
        if (bodies.IsAsleep(body.Slot))
            return;
        var found = new QuickList<int>(16, pool);
        var ends = new QuickList<int>(16, pool);
        pool.TakeAtLeast<byte>(bodies.Awake.Count, out var isFound);
        isFound.Clear(0, bodies.Awake.Count);
        try
        {
            var index = bodies.Locations[body.Slot].Index;
            var isKinematic = Bodies.IsKinematic(bodies.Awake.LocalInertias[index]);
            if (isKinematic)
                GatherHeldBy(body.Slot, isFound, ref found, ref ends);
            else
                Gather(body.Slot, isFound, ref found, ref ends);
            if (isKinematic)
            {
                found.Add(body.Slot, pool);
                ends.Add(found.Count, pool);
            }
            for (int i = 0; i < found.Count; ++i)
                CheckSound(found[i]);
            for (int i = 0, start = 0; i < ends.Count; start = ends[i++])
                found.AsSpan()[start..ends[i]].Sort();
            islands.PutToSleep(found.AsSpan(), ends.AsSpan());
        }
        finally
        {
            found.Dispose(pool);
            ends.Dispose(pool);
            pool.Return(ref isFound);
        }
    }

    // What rests while its joints go over from the sweeps to being solved at once, or close what they were added with, would sleep with the gaps that they
    // still have: of small bodies that is slower than what counts as rest.
    bool IsOnItsWay(ReadOnlySpan<int> slots)
    {
        if (!solver.MayBeOnTheWay)
            return false;
        foreach (var slot in slots)
        {
            var list = bodies.Awake.Constraints[bodies.Locations[slot].Index];
            var edge = list.First;
            for (int i = 0; i < list.Count; ++i, edge = solver.Edges.Next(edge))
            {
                if (solver.IsOnItsWay(solver.Edges.ConstraintSlot(edge)))
                    return true;
            }
        }
        return false;
    }

    void CheckSound(int slot)
    {
        if (!IsSound(ref bodies.Awake, bodies.Locations[slot].Index))
        {
            throw new InvalidOperationException(
                $"{bodies.HandleAt(slot)} cannot be put to sleep: its pose, velocity or inertia is no number. Nothing was changed.");
        }
    }

    bool AreSound(ReadOnlySpan<int> slots)
    {
        foreach (var slot in slots)
        {
            if (!IsSound(ref bodies.Awake, bodies.Locations[slot].Index))
                return false;
        }
        return true;
    }

    // What a game has written since the last step the next one looks at, if the body is awake then.
    static bool IsSound(ref BodySet set, int index)
    {
        ref var motion = ref set.MotionStates[index];
        return Soundness.IsSound(motion.Pose) && Soundness.IsSound(motion.Velocity) && Soundness.IsSound(set.LocalInertias[index]);
    }

    void GatherHeldBy(int kinematic, Buffer<byte> isFound, ref QuickList<int> found, ref QuickList<int> ends)
    {
        var list = bodies.Awake.Constraints[bodies.Locations[kinematic].Index];
        var edge = list.First;
        for (int i = 0; i < list.Count; ++i, edge = solver.Edges.Next(edge))
        {
            ref var location = ref solver.Locations[solver.Edges.ConstraintSlot(edge)];
            for (int j = 0; location.SetIndex == 0 && j < solver.Processor(location.TypeId).BodiesPerConstraint; ++j)
                Gather(solver.BodySlotOf(location, j), isFound, ref found, ref ends);
        }
    }

    // The dynamic bodies that constraints connect with one of them.
    void Gather(int first, Buffer<byte> isFound, ref QuickList<int> found, ref QuickList<int> ends)
    {
        var next = found.Count;
        Find(first, isFound, ref found);
        if (found.Count == next)
            return;
        for (; next < found.Count; ++next)
        {
            var list = bodies.Awake.Constraints[bodies.Locations[found[next]].Index];
            var edge = list.First;
            for (int i = 0; i < list.Count; ++i, edge = solver.Edges.Next(edge))
            {
                ref var location = ref solver.Locations[solver.Edges.ConstraintSlot(edge)];
                for (int j = 0; j < solver.Processor(location.TypeId).BodiesPerConstraint; ++j)
                    Find(solver.BodySlotOf(location, j), isFound, ref found);
            }
        }
        ends.Add(found.Count, pool);
    }

    void Find(int slot, Buffer<byte> isFound, ref QuickList<int> found)
    {
        var index = bodies.Locations[slot].Index;
        if (bodies.IsAsleep(slot) || isFound[index] != 0 || Bodies.IsKinematic(bodies.Awake.LocalInertias[index]))
            return;
        isFound[index] = 1;
        found.Add(slot, pool);
    }

    internal void CopyState(StateCopy copy)
    {
        copy.Value(ref hasMore);
    }

    /// <summary>Begins anew, as a new simulation does.</summary>
    internal void Clear()
    {
        hasMore = false;
        bodies.RestCounts = 0;
    }
}
