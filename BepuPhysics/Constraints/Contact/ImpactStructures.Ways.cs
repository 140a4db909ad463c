using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// How a structure is moved to where it would be, had an impact not been made now but at its time. Its bodies go along circles, or whatever the joints let
// them: moved along straight lines they left their joints, which pulled them back, mostly up, for nothing.
//
// With D the change of velocity, t the time that has passed since the impact and P halfway, the way is t P D: the chord of a circle is along its tangent in
// the middle. Velocities turn along: 2 P - 1 halfway is a mirror that takes the tangent at the beginning of the chord to that at its end, and keeps the
// energy of any velocity and, as it adds only what joints push, the momentum of what nothing else holds.
//
// Gravity: at the time of the impact velocities were those of now less what they have gained since, and with a straight way that is the work of gravity along
// it, to the last digit. What it does along the rest, t (P D - D), is owed by the impact, which bounces by that less.
//
// All this is of the second order in the angles by which bodies turn on the way: where one turns by more, as links of a long chain do, ways are straight. So
// they are of structures that nothing holds, which joints pull wherever they go.
sealed unsafe partial class ImpactStructures
{
    // Greatest angle of a way along joints.
    const float GreatestTurn = 1 / 4f;

    /// <summary>Takes note of the last blow on a structure.</summary>
    /// <param name="island">The structure.</param>
    /// <param name="time">Time since the blow.</param>
    /// <param name="mayBeLed">Whether it may go along its joints, if it hangs in them.</param>
    internal void KeepBlow(int island, float time, bool mayBeLed)
    {
        var (first, end) = PartsOf(island);
        var isLed = mayBeLed && Hangs(island);
        for (int i = first; i < end; ++i)
        {
            parts[i].Change = ChangeOf(i);
            isLed &= Exact.LengthSquared(parts[i].Change.Angular) * time * time < GreatestTurn * GreatestTurn;
        }
        parts[first].IsLed = isLed;
    }

    /// <summary>Whether a structure goes along its joints.</summary>
    internal bool IsLed(int island) => parts[plan.Islands[island].FirstBody].IsLed;

    /// <summary>Takes note of the speeds of what drives, where the structure is hit: it keeps them.</summary>
    internal void KeepDrives(int island)
    {
        ReadVelocities(island);
        var memory = Memory(island);
        for (int i = plan.Islands[island].FirstRow; i < plan.Islands[island].EndRow; ++i)
            driven[i] = memory.Rows[i].Target;
    }

    /// <summary>What the blow adds to the velocity of a part.</summary>
    internal BodyVelocity KeptChangeOf(int part) => parts[part].Change;

    /// <summary>What that is halfway, as the joints let it there.</summary>
    internal BodyVelocity PathOf(int part) => parts[part].Path;

    /// <summary>Finds ways, with the structure half of the straight way on.</summary>
    /// <returns>What the way to a later impact is uphill, beyond a straight one, J for each second until then.</returns>
    internal float FindPaths(int island, in Substep substep)
    {
        var equations = Read(island, substep);
        BeginChanges(island);
        var memory = Memory(island);
        var (first, end) = PartsOf(island);
        for (int i = first; i < end; ++i)
            Write(ref memory.Bodies[i].Velocity, parts[i].Change);
        equations.Project();
        float power = 0;
        for (int i = first; i < end; ++i)
        {
            ref var part = ref parts[i];
            part.Path = Read(memory.Bodies[i].Velocity);
            if (part.Inertia.InverseMass > 0)
                power += Exact.Dot(part.Path.Linear - part.Change.Linear, part.FreeGain.Linear) / part.Inertia.InverseMass;
        }
        return power * substep.InverseDt;
    }

    /// <summary>Scales the blow.</summary>
    internal void ScaleBlow(int island, float scale)
    {
        var (first, end) = PartsOf(island);
        for (int i = first; i < end; ++i)
        {
            ref var part = ref parts[i];
            part.Change = Restitution.Times(part.Change, scale);
            part.Path = Restitution.Times(part.Path, scale);
        }
    }

    /// <summary>Adds the blow to the velocities, and turns them to where the structure will be, with the equations of halfway.</summary>
    internal void Turn(int island)
    {
        ref var set = ref bodies.Awake;
        var (first, end) = PartsOf(island);
        for (int i = first; i < end; ++i)
        {
            ref var velocity = ref set.MotionStates[parts[i].Reference].Velocity;
            velocity.Linear += parts[i].Change.Linear - parts[i].Gain.Linear * 0.5f;
            velocity.Angular += parts[i].Change.Angular - parts[i].Gain.Angular * 0.5f;
        }
        ReadVelocities(island);
        Drive(island);
        var memory = Memory(island);
        Equations(island).Project();
        for (int i = first; i < end; ++i)
        {
            ref var velocity = ref set.MotionStates[parts[i].Reference].Velocity;
            var middle = Read(memory.Bodies[i].Velocity);
            velocity.Linear = middle.Linear * 2 - velocity.Linear;
            velocity.Angular = middle.Angular * 2 - velocity.Angular;
        }
    }

    /// <summary>Makes the equations anew, where the structure now is.</summary>
    internal void Reenter(int island, in Substep substep)
    {
        ref var set = ref bodies.Awake;
        var (first, end) = PartsOf(island);
        for (int i = first; i < end; ++i)
            AddLost(ref parts[i].Lost, parts[i], -1);
        var equations = Read(island, substep);
        FindGains(island, equations);
        for (int i = first; i < end; ++i)
        {
            ref var part = ref parts[i];
            ref var velocity = ref set.MotionStates[part.Reference].Velocity;
            velocity.Linear += part.Gain.Linear * 0.5f + part.Lost.Linear;
            velocity.Angular += part.Gain.Angular * 0.5f + part.Lost.Angular;
            AddLost(ref velocity, part, 1);
        }
        ReadVelocities(island);
        Drive(island);
        isEntered[island] = TakeLost(island, equations);
        BeginChanges(island);
    }

    void Drive(int island)
    {
        var memory = Memory(island);
        for (int i = plan.Islands[island].FirstRow; i < plan.Islands[island].EndRow; ++i)
            memory.Rows[i].Target = driven[i];
    }

    // What joints take of the gain.
    static void AddLost(ref BodyVelocity velocity, in Part part, float sign)
    {
        velocity.Linear += (part.FreeGain.Linear - part.Gain.Linear) * sign;
        velocity.Angular += (part.FreeGain.Angular - part.Gain.Angular) * sign;
    }
}
