using System;
using BepuPhysics.Constraints;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics;

// Constraints that break, and what a game reads of how well one holds.
public sealed unsafe partial class Solver
{
    struct Breakable
    {
        public ConstraintHandle Handle;
        public BreakThreshold Threshold;
        // Sums of the present step.
        public float Impulse;
        public float AngularImpulse;
    }

    QuickList<Breakable> breakable;
    // One more than the place of a constraint in the list, by slot; 0 where it cannot break.
    Buffer<int> breakablePlaces;
    QuickList<BrokenConstraint> broken;

    /// <summary>Number of constraints that may break.</summary>
    internal int BreakableCount => breakable.Count;

    /// <summary>
    /// The constraints that the last step removed because they broke, in the order of the slots of their handles. Valid until the next step begins.
    /// </summary>
    public ReadOnlySpan<BrokenConstraint> BrokenConstraints => broken.Span.Allocated ? broken.Span.AsSpan()[..broken.Count] : default;

    /// <summary>What a constraint bears before it breaks; <see cref="BreakThreshold.Unbreakable"/> unless something else was said.</summary>
    /// <exception cref="ArgumentException">There is no such constraint.</exception>
    public BreakThreshold GetBreakThreshold(ConstraintHandle handle)
    {
        CheckHandle(handle);
        return PlaceOfBreakable(handle.Slot) is > 0 and var place ? breakable[place - 1].Threshold : BreakThreshold.Unbreakable;
    }

    /// <summary>
    /// Chooses what a constraint bears before it breaks. One that had to bear more is removed at the end of the step and listed in
    /// <see cref="BrokenConstraints"/>.
    /// </summary>
    /// <remarks>Wakes the bodies: what has slept until now may be too much for it.</remarks>
    /// <param name="handle">The constraint; no contact, and no type of a game's own that is no joint.</param>
    /// <param name="threshold">Greatest impulses of a step.</param>
    /// <exception cref="ArgumentException">There is no such constraint, its type has no rows, or a threshold is not positive; nothing was changed.</exception>
    public void SetBreakThreshold(ConstraintHandle handle, in BreakThreshold threshold)
    {
        using var change = world.Change("Solver.SetBreakThreshold");
        CheckJoint(handle);
        if (!(threshold.Impulse > 0) || !(threshold.AngularImpulse > 0))
        {
            throw new ArgumentException(
                $"Thresholds must be positive, or infinite, not {threshold.Impulse} N s and {threshold.AngularImpulse} N m s.", nameof(threshold));
        }
        if (Processor(Locations[handle.Slot].TypeId).RowCount == 0)
            throw new ArgumentException($"{handle} is of a type that does not say what its impulses are.", nameof(handle));
        WakeBodiesOf(handle);
        var place = PlaceOfBreakable(handle.Slot);
        if (float.IsPositiveInfinity(threshold.Impulse) && float.IsPositiveInfinity(threshold.AngularImpulse))
        {
            ForgetBreakable(handle.Slot);
            return;
        }
        if (place > 0)
        {
            breakable[place - 1].Threshold = threshold;
            return;
        }
        if (!breakable.Span.Allocated)
            breakable = new QuickList<Breakable>(16, pool);
        if (handle.Slot >= breakablePlaces.Length)
        {
            var previous = breakablePlaces.Length;
            pool.ResizeToAtLeast(ref breakablePlaces, Locations.Length, previous);
            breakablePlaces.Clear(previous, breakablePlaces.Length - previous);
        }
        breakable.Add(new() { Handle = handle, Threshold = threshold }, pool);
        breakablePlaces[handle.Slot] = breakable.Count;
        MakeRoomForBroken();
    }

    // So that a step in which all of them break takes no memory.
    void MakeRoomForBroken()
    {
        if (!broken.Span.Allocated)
            broken = new QuickList<BrokenConstraint>(16, pool);
        broken.EnsureCapacity(breakable.Count, pool);
    }

    int PlaceOfBreakable(int slot) => (uint)slot < (uint)breakablePlaces.Length ? breakablePlaces[slot] : 0;

    void ForgetBreakable(int slot)
    {
        var place = PlaceOfBreakable(slot);
        if (place == 0)
            return;
        var last = breakable[breakable.Count - 1];
        breakablePlaces[last.Handle.Slot] = place;
        breakable[place - 1] = last;
        breakablePlaces[slot] = 0;
        --breakable.Count;
    }

    void BeginBreaking()
    {
        broken.Count = 0;
        for (int i = 0; i < breakable.Count; ++i)
            breakable[i].Impulse = breakable[i].AngularImpulse = 0;
    }

    /// <summary>Adds the impulses of a substep to the sums of some constraints that may break. Called on worker threads.</summary>
    internal void AddBreakingImpulses(int start, int end)
    {
        for (int i = start; i < end; ++i)
        {
            ref var one = ref breakable[i];
            if (IsAsleep(one.Handle.Slot))
                continue;
            ref var location = ref Locations[one.Handle.Slot];
            ref var batch = ref TypeBatchAt(location);
            var processor = Processor(location.TypeId);
            float linear = 0, angular = 0;
            for (int row = 0; row < processor.RowCount; ++row)
            {
                var impulse = processor.Impulse(ref batch, location.IndexInTypeBatch, row);
                if (processor.IsLinear(row))
                    linear += impulse * impulse;
                else
                    angular += impulse * impulse;
            }
            one.Impulse += MathF.Sqrt(linear);
            one.AngularImpulse += MathF.Sqrt(angular);
        }
    }

    /// <summary>Adds what a blow has asked of a constraint, if it may break. Called on worker threads.</summary>
    internal void AddBreakingImpulse(int slot, float linear, float angular)
    {
        if (PlaceOfBreakable(slot) is not (> 0 and var place))
            return;
        breakable[place - 1].Impulse += linear;
        breakable[place - 1].AngularImpulse += angular;
    }

    void BreakOverloaded()
    {
        for (int i = 0; i < breakable.Count; ++i)
        {
            ref var one = ref breakable[i];
            if (one.Impulse > one.Threshold.Impulse || one.AngularImpulse > one.Threshold.AngularImpulse)
                broken.Add(Describe(one), pool);
        }
        if (broken.Count == 0)
            return;
        var comparer = new BySlot();
        QuickSort.Sort(broken.Span, broken.Count, ref comparer);
        for (int i = 0; i < broken.Count; ++i)
            RemoveConstraint(broken[i].Handle);
    }

    BrokenConstraint Describe(in Breakable one)
    {
        ref var location = ref Locations[one.Handle.Slot];
        var processor = Processor(location.TypeId);
        var described = new BrokenConstraint
        {
            Handle = one.Handle,
            TypeId = location.TypeId,
            Impulse = one.Impulse,
            AngularImpulse = one.AngularImpulse,
        };
        for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
        {
            var index = processor.BodyReference(ref TypeBatchAt(location), location.IndexInTypeBatch, slot) & EncodedBody.IndexMask;
            described.AddBody(bodies.Awake.IndexToHandle[index]);
        }
        return described;
    }

    struct BySlot : IComparerRef<BrokenConstraint>
    {
        public readonly int Compare(ref BrokenConstraint a, ref BrokenConstraint b) => a.Handle.Slot.CompareTo(b.Handle.Slot);
    }
}
