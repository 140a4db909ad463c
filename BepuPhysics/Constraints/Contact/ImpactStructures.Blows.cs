using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// The equations of a structure in one substep, and what they make of blows. Those of different structures are independent of each other.
sealed unsafe partial class ImpactStructures
{
    // What a sweep corrects of a spring's velocity from which on a substep cannot tell it from a joint: half a joint's own share.
    const float LeastMassScale = 1 / 3f;
    // What a servo or a motor can push in a substep that was given no bound, N s.
    const float Boundless = 1e20f;

    /// <summary>The part that a body of the active set is in the structures whose equations are there, or -1.</summary>
    internal int PartOf(int body)
    {
        if (IsEmpty || body < 0)
            return Alone;
        var place = places[body];
        return place >= 0 && isEntered[parts[place].Island] ? place : Alone;
    }

    /// <summary>Structure of a part.</summary>
    internal int IslandOfPart(int part) => parts[part].Island;

    /// <summary>Parts of the dynamic bodies of a structure: the first, and where they end.</summary>
    internal (int First, int End) PartsOf(int island) =>
        (plan.Islands[island].FirstBody, plan.Islands[island].FirstBody + plan.Islands[island].DynamicCount);

    /// <summary>Index in the active set of a part that is dynamic.</summary>
    internal int BodyOf(int part) => parts[part].Reference;

    /// <summary>Inverse inertia of a part in world axes.</summary>
    internal BodyInertia InertiaOf(int part) => parts[part].Inertia;

    /// <summary>What the acceleration of a substep gives a part, in its joints.</summary>
    internal BodyVelocity GainOf(int part) => parts[part].Gain;

    /// <summary>What the last blow on its structure has made of a part.</summary>
    internal BodyVelocity ChangeOf(int part) => Read(Memory(parts[part].Island).Bodies[part].Velocity);

    /// <summary>Makes the equations of a structure, and takes its joints' part out of the velocities. Once in a substep, until it leaves.</summary>
    /// <param name="island">The structure, or -1: then nothing.</param>
    /// <param name="substep">The substep.</param>
    /// <param name="pairs">Pairs that may bounce.</param>
    /// <param name="groups">Their groups.</param>
    internal void Enter(int island, in Substep substep, ReadOnlySpan<BouncingPair> pairs, in ImpactGroups groups)
    {
        if (island < 0 || isEntered[island])
            return;
        ReadGains(island, pairs, groups);
        var equations = Read(island, substep);
        if (!TakeLost(island, equations))
            return;
        isEntered[island] = true;
        FindGains(island, equations);
    }

    // The equations where the bodies are now; they are after velocities as the joints let them, with those that bodies have.
    DirectEquations<OneVector, OneNumber> Read(int island, in Substep substep)
    {
        ReadBodies(island);
        ReadJoints(island, substep);
        var equations = Equations(island);
        equations.Factor();
        return equations;
    }

    /// <summary>Puts back what the joints have yet to take; nothing where there is no structure, -1.</summary>
    internal void Leave(int island)
    {
        if (island < 0 || !isEntered[island])
            return;
        isEntered[island] = false;
        var (first, end) = PartsOf(island);
        for (int i = first; i < end; ++i)
        {
            ref var velocity = ref bodies.Awake.MotionStates[parts[i].Reference].Velocity;
            velocity.Linear += parts[i].Lost.Linear;
            velocity.Angular += parts[i].Lost.Angular;
        }
    }

    /// <summary>Begins a blow on a structure.</summary>
    internal void BeginBlow(int island)
    {
        var memory = Memory(island);
        for (int i = plan.Islands[island].FirstBody; i < plan.Islands[island].EndBody; ++i)
            memory.Bodies[i].Velocity = default;
    }

    /// <summary>Adds what the blow would make of a part that is free.</summary>
    internal void Push(int part, in BodyVelocity change)
    {
        DirectPair<OneVector, OneNumber> added = default;
        Write(ref added, change);
        Memory(parts[part].Island).Bodies[part].Velocity.Add(added, OneNumber.Of(1));
    }

    /// <summary>Ends the blow: <see cref="ChangeOf"/> says what it makes of each part.</summary>
    internal void EndBlow(int island) => Equations(island).Project();

    /// <summary>Adds what the last blow has asked of joints that may break.</summary>
    internal void NoteBlow(int island)
    {
        if (solver.BreakableCount == 0)
            return;
        var memory = Memory(island);
        for (int i = plan.Islands[island].FirstNode; i < plan.Islands[island].EndNode; ++i)
        {
            ref var node = ref plan.Nodes[i];
            var processor = solver.Processor(node.TypeId);
            double linear = 0, angular = 0;
            for (int row = 0; row < node.RowCount; ++row)
            {
                var impulse = DirectLane.Of(ref memory.Rows[node.FirstRow + row].Impulse, 0);
                if (processor.IsLinear(row))
                    linear += impulse * impulse;
                else
                    angular += impulse * impulse;
            }
            solver.AddBreakingImpulse(plan.Members[i * DirectPlan.Lanes].Handle.Slot, (float)Math.Sqrt(linear), (float)Math.Sqrt(angular));
        }
    }

    DirectMemory<OneVector, OneNumber> Memory(int island) => new(memory.Memory, plan.Islands[island]);

    DirectEquations<OneVector, OneNumber> Equations(int island) => new(plan, plan.Islands[island], Memory(island));

    void ReadBodies(int island)
    {
        ref var set = ref bodies.Awake;
        var memory = Memory(island);
        for (int i = plan.Islands[island].FirstBody; i < plan.Islands[island].EndBody; ++i)
        {
            ref var part = ref parts[i];
            ref var motion = ref set.MotionStates[part.Reference & EncodedBody.IndexMask];
            ref var local = ref set.LocalInertias[part.Reference & EncodedBody.IndexMask];
            part.Inertia = default;
            if (IsDynamic(part.Reference))
            {
                part.Inertia.InverseMass = local.InverseMass;
                part.Inertia.InverseInertiaTensor = Symmetric3x3.RotateInverseInertia(local.InverseInertiaTensor, motion.Pose.Orientation);
            }
            ref var body = ref memory.Bodies[i];
            body.InverseMass = OneNumber.Of(part.Inertia.InverseMass);
            body.WriteInertia(0, part.Inertia.InverseInertiaTensor);
            Write(ref body.Velocity, motion.Velocity);
        }
    }

    void ReadJoints(int island, in Substep substep)
    {
        var memory = Memory(island);
        var awake = new SolverBodies(bodies.Awake);
        Span<ConstraintRow> rows = stackalloc ConstraintRow[DirectPlan.MostRows];
        var softness = OneNumber.Of(plan.Islands[island].HasLoops ? SubstepStiffness.DirectSoftness : 0);
        for (int i = plan.Islands[island].FirstNode; i < plan.Islands[island].EndNode; ++i)
        {
            ref var node = ref plan.Nodes[i];
            ref var location = ref solver.Locations[plan.Members[i * DirectPlan.Lanes].Handle.Slot];
            var processor = solver.Processor(node.TypeId);
            processor.ReadRows(ref solver.TypeBatchAt(location), awake, substep, location.IndexInTypeBatch, rows);
            var hasBounds = processor.LimitOf(0) != RowLimit.None;
            memory.Holds[i] = new() { IsHeld = Holds(rows[0], hasBounds) ? default : OneNumber.All };
            for (int row = 0; row < node.RowCount; ++row)
            {
                var jacobians = memory.Jacobians + node.Jacobian + row * node.BodyCount;
                for (int slot = 0; slot < node.BodyCount; ++slot)
                {
                    ref var j = ref Unsafe.Add(ref rows[row].A, slot);
                    Write(ref jacobians[slot], new(j.Linear, j.Angular));
                }
                memory.Rows[node.FirstRow + row] = new() { Softness = softness };
                if (hasBounds)
                    AimDriven(memory, node, row, -1);
            }
        }
    }

    // What drives keeps the speed that it has, or has without what the substep has added to it.
    void AimDriven(in DirectMemory<OneVector, OneNumber> memory, in DirectNode node, int row, int gains)
    {
        var jacobians = memory.Jacobians + node.Jacobian + row * node.BodyCount;
        double along = 0;
        for (int slot = 0; slot < node.BodyCount; ++slot)
        {
            var velocity = memory.Bodies[node.Bodies[slot]].Velocity;
            DirectPair<OneVector, OneNumber> gain = default;
            Write(ref gain, parts[node.Bodies[slot]].FreeGain);
            velocity.Add(gain, OneNumber.Of(gains));
            var product = DirectPair<OneVector, OneNumber>.Multiply(jacobians[slot], velocity);
            var sum = OneVector.Sum(product);
            along += DirectLane.Of(ref sum, 0);
        }
        memory.Rows[node.FirstRow + row].Target = OneNumber.Of(along);
    }

    // Of bodies as they are, for equations that are there.
    void ReadVelocities(int island)
    {
        var memory = Memory(island);
        for (int i = plan.Islands[island].FirstBody; i < plan.Islands[island].EndBody; ++i)
            Write(ref memory.Bodies[i].Velocity, bodies.Awake.MotionStates[parts[i].Reference & EncodedBody.IndexMask].Velocity);
        for (int i = plan.Islands[island].FirstNode; i < plan.Islands[island].EndNode; ++i)
        {
            ref var node = ref plan.Nodes[i];
            for (int row = 0; row < node.RowCount && solver.Processor(node.TypeId).LimitOf(0) != RowLimit.None; ++row)
                AimDriven(memory, node, row, 0);
        }
    }

    // Whether a joint holds in no time.
    static bool Holds(in ConstraintRow row, bool hasBounds) =>
        (row.IsHard || row.MassScale > LeastMassScale) && (!hasBounds || row.MaximumImpulse > Boundless);

    // False where what is no number, or beyond all, would be written into a whole structure: it is as free in this substep.
    bool TakeLost(int island, in DirectEquations<OneVector, OneNumber> equations)
    {
        equations.Project();
        ref var set = ref bodies.Awake;
        var memory = Memory(island);
        var (first, end) = PartsOf(island);
        for (int i = first; i < end; ++i)
        {
            var velocity = Read(memory.Bodies[i].Velocity);
            if (!(Exact.LengthSquared(velocity.Linear) + Exact.LengthSquared(velocity.Angular) <= Limits.GreatestSoundSquare))
                return false;
        }
        for (int i = first; i < end; ++i)
        {
            ref var velocity = ref set.MotionStates[parts[i].Reference].Velocity;
            var allowed = Read(memory.Bodies[i].Velocity);
            parts[i].Lost = new(velocity.Linear - allowed.Linear, velocity.Angular - allowed.Angular);
            velocity = allowed;
        }
        return true;
    }

    // Of bodies that have no pair nobody knows it; as a rule all are in one field of gravity.
    void ReadGains(int island, ReadOnlySpan<BouncingPair> pairs, in ImpactGroups groups)
    {
        var (first, end) = PartsOf(island);
        Vector3 common = default;
        for (int i = end - 1; i >= first; --i)
        {
            var pair = groups.FirstOf(parts[i].Reference);
            if (pair >= 0)
                common = (pairs[pair].A == parts[i].Reference ? pairs[pair].GainA : pairs[pair].GainB).Linear;
        }
        for (int i = first; i < end; ++i)
        {
            var pair = groups.FirstOf(parts[i].Reference);
            parts[i].FreeGain = pair < 0 ? new(common, default) : pairs[pair].A == parts[i].Reference ? pairs[pair].GainA : pairs[pair].GainB;
        }
    }

    void FindGains(int island, in DirectEquations<OneVector, OneNumber> equations)
    {
        BeginChanges(island);
        var memory = Memory(island);
        var (first, end) = PartsOf(island);
        for (int i = first; i < end; ++i)
            Write(ref memory.Bodies[i].Velocity, parts[i].FreeGain);
        equations.Project();
        for (int i = first; i < end; ++i)
            parts[i].Gain = Read(memory.Bodies[i].Velocity);
    }

    // From here on only changes are asked about, of which servos and motors leave nothing.
    void BeginChanges(int island)
    {
        var memory = Memory(island);
        for (int i = plan.Islands[island].FirstRow; i < plan.Islands[island].EndRow; ++i)
            memory.Rows[i].Target = default;
        BeginBlow(island);
    }

    static BodyVelocity Read(DirectPair<OneVector, OneNumber> velocity) => new(
        DirectLane.Read<OneVector, OneNumber>(ref velocity.Linear, 0), DirectLane.Read<OneVector, OneNumber>(ref velocity.Angular, 0));

    static void Write(ref DirectPair<OneVector, OneNumber> velocity, in BodyVelocity value)
    {
        DirectLane.Write<OneVector, OneNumber>(ref velocity.Linear, 0, value.Linear.X, value.Linear.Y, value.Linear.Z);
        DirectLane.Write<OneVector, OneNumber>(ref velocity.Angular, 0, value.Angular.X, value.Angular.Y, value.Angular.Z);
    }
}
