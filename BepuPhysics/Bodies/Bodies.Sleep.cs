namespace BepuPhysics;

// Which bodies sleep. All of them lie in one set, beside the active one; who may come and go together is an island (IslandSleeper, IslandAwakener).
public sealed partial class Bodies
{
    /// <summary>Set of the bodies that sleep.</summary>
    internal const int AsleepSet = 1;

    /// <summary>A body that has rested long enough to sleep.</summary>
    internal const long OneRipe = 1;
    /// <summary>A body that had not when the step before began.</summary>
    internal const long OneJustRipened = 1L << 32;

    /// <summary>How many bodies had rested long enough to sleep when the last step began, and how many just so. Workers add to it.</summary>
    internal long RestCounts;

    /// <summary>Whether the centre of a kinematic body with a shape moved when bounds were predicted last. Workers set it.</summary>
    internal bool HasMovingKinematics;

    /// <summary>Bodies that had rested long enough to sleep when the last step began.</summary>
    internal int RipeCount => (int)RestCounts;

    /// <summary>Those of them that had not when the step before began.</summary>
    internal int JustRipenedCount => (int)(RestCounts >> 32);

    /// <summary>Bodies that sleep.</summary>
    internal ref BodySet Asleep => ref Sets[AsleepSet];

    /// <summary>Whether a body that exists sleeps.</summary>
    internal bool IsAsleep(int slot) => Locations[slot].SetIndex == AsleepSet;

    /// <summary>Wakes a body with its island, or puts both to sleep.</summary>
    internal void SetAwake(BodyHandle handle, bool value)
    {
        using var change = world.Change("BodyReference.Awake");
        CheckHandle(handle);
        if (value)
            awakener.Wake(handle);
        else
            sleeper.Sleep(handle);
    }

    /// <summary>Wakes a body that is to be pushed, if it sleeps.</summary>
    internal void WakeToPush(BodyHandle handle, string operation)
    {
        if (!IsAsleep(handle.Slot))
            return;
        using var change = world.Change(operation);
        awakener.Wake(handle);
    }

    /// <summary>Wakes a body and all that it has constraints with.</summary>
    internal void WakeAround(BodyHandle handle) => awakener.WakeAround(handle);

    /// <summary>Handle of the body that has a slot.</summary>
    internal BodyHandle HandleAt(int slot) => new(owners.ValueAt(slot));

    /// <summary>Moves a body of the active set among those that sleep, without its constraints and its leaf, and stops it.</summary>
    internal int PutToSleep(int slot)
    {
        var index = Locations[slot].Index;
        if (Awake.JointCounts.Allocated)
            Asleep.EnsureJointCounts(Pool);
        var added = Asleep.Append(Awake, index);
        Asleep.MotionStates[added].Velocity = default;
        Locations[slot] = new() { SetIndex = AsleepSet, Index = added };
        Awake.RemoveAt(index);
        if (index < Awake.Count)
        {
            Locations[Awake.IndexToHandle[index].Slot].Index = index;
            solver.UpdateBodyIndex(Awake, index);
        }
        return added;
    }

    /// <summary>Moves a body that sleeps into the active set, without its constraints. It has not rested at all then.</summary>
    internal void Awaken(int slot)
    {
        var index = Locations[slot].Index;
        if (Awake.Count == Awake.Capacity)
            Awake.Resize(Awake.Capacity * 2, Pool);
        var added = Awake.Append(Asleep, index);
        Awake.Activity[added].Wake();
        // By this a kinematic body is known to be where the last step has left it, or not.
        Awake.Origins[added].Position = Awake.SoundPoses[added].Position;
        Locations[slot] = new() { SetIndex = 0, Index = added };
        MoveLeafToActiveTree(added);
        Asleep.RemoveAt(index);
        if (index < Asleep.Count)
            Locations[Asleep.IndexToHandle[index].Slot].Index = index;
    }
}
