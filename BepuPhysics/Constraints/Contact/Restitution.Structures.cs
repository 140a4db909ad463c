namespace BepuPhysics.Constraints.Contact;

// Impacts of bodies in joints: what happens to one of a structure happens to all.
sealed unsafe partial class Restitution
{
    partial struct Impacts
    {
        void EnterStructures(int group, in Substep substep)
        {
            // Without an impact nobody's speeds matter.
            for (int i = 0; i < owner.groups.CountOf(group) && !queue.IsEmpty; ++i)
            {
                ref var pair = ref Pairs[owner.groups.Pair(group, i)];
                if (!pair.IsInStructure)
                    continue;
                var (a, b) = owner.structures.IslandsOf(pair);
                owner.structures.Enter(a, substep, Pairs, owner.groups);
                owner.structures.Enter(b, substep, Pairs, owner.groups);
            }
            // Their speeds are others now; and in the first substep nobody knew who is in joints.
            for (int i = 0; i < owner.groups.CountOf(group); ++i)
            {
                if (Pairs[owner.groups.Pair(group, i)].IsInStructure)
                    LookAt(owner.groups.Pair(group, i), substep.Dt);
            }
        }

        // The solver is told of the overlaps of structures that lie on something, and of those without weight, which nothing else would bring apart: what
        // hangs side by side would be pushed apart with a speed that its bounces keep.
        readonly void ShowStructures(int group)
        {
            var any = false;
            for (int i = 0; i < owner.groups.CountOf(group); ++i)
                any |= Pairs[owner.groups.Pair(group, i)].Stays;
            if (!any)
                return;
            NoteBorne(group, true);
            for (int i = 0; i < owner.groups.CountOf(group); ++i)
            {
                ref var pair = ref Pairs[owner.groups.Pair(group, i)];
                var (a, b) = pair.Stays ? owner.structures.IslandsOf(pair) : default;
                if (pair.Stays && (!(pair.GainSquared > 0) || owner.structures.IsBorne(a) || owner.structures.IsBorne(b)))
                    pair.Overlaps = false;
            }
            NoteBorne(group, false);
        }

        readonly void NoteBorne(int group, bool isBorne)
        {
            for (int i = 0; i < owner.groups.CountOf(group); ++i)
            {
                ref var pair = ref Pairs[owner.groups.Pair(group, i)];
                if (!pair.IsLoaded || !pair.IsInStructure)
                    continue;
                // What presses against each other as it hangs is not borne by it.
                var (a, b) = owner.structures.IslandsOf(pair);
                if (a >= 0 && b >= 0)
                    continue;
                owner.structures.NoteBorne(a, isBorne);
                owner.structures.NoteBorne(b, isBorne);
            }
        }

        readonly void LeaveStructures(int group)
        {
            for (int i = 0; i < owner.groups.CountOf(group); ++i)
            {
                ref var pair = ref Pairs[owner.groups.Pair(group, i)];
                if (!pair.IsInStructure)
                    continue;
                var (a, b) = owner.structures.IslandsOf(pair);
                owner.structures.Leave(a);
                owner.structures.Leave(b);
            }
        }

        // Half of their way, for what joints let them do there; then what the impact owes for the whole of it (ImpactStructures.Ways.cs).
        readonly void FindPaths(in ContactRows contacts, float time, in Substep substep)
        {
            float owed = 0;
            for (int i = 0; i < impact.BodyCount; ++i)
            {
                if (!impact.TryGetStructure(i, out var island))
                    continue;
                owner.structures.NoteBlow(island);
                owner.structures.KeepBlow(island, time, impact.GoesAlongJoints);
                if (!owner.structures.IsLed(island))
                    continue;
                owner.structures.KeepDrives(island);
                var (first, end) = owner.structures.PartsOf(island);
                for (int part = first; part < end; ++part)
                    ShiftPart(contacts, owner.structures.BodyOf(part), Times(owner.structures.KeptChangeOf(part), time * -0.5f));
                owed += owner.structures.FindPaths(island, substep) * time;
            }
            var scale = impact.Pay(owed);
            for (int i = 0; i < impact.BodyCount; ++i)
            {
                if (scale == 1 || !impact.TryGetStructure(i, out var island))
                    continue;
                // They are half of the way on of the whole blow.
                var (first, end) = owner.structures.PartsOf(island);
                for (int part = first; part < end && owner.structures.IsLed(island); ++part)
                    ShiftPart(contacts, owner.structures.BodyOf(part), Times(owner.structures.KeptChangeOf(part), time * 0.5f * (1 - scale)));
                owner.structures.ScaleBlow(island, scale);
            }
        }

        // What the impact has made of all bodies of the structures that take part.
        readonly void PushStructures(in ContactRows contacts, float time, in Substep substep)
        {
            for (int i = 0; i < impact.BodyCount; ++i)
            {
                if (!impact.TryGetStructure(i, out var island))
                    continue;
                var alongJoints = owner.structures.IsLed(island);
                if (alongJoints)
                    owner.structures.Turn(island);
                var (first, end) = owner.structures.PartsOf(island);
                for (int part = first; part < end; ++part)
                {
                    var body = owner.structures.BodyOf(part);
                    var change = owner.structures.KeptChangeOf(part);
                    if (!alongJoints)
                        contacts.Push(body, change);
                    var way = alongJoints ? Difference(owner.structures.PathOf(part), Times(change, 0.5f)) : change;
                    ShiftPart(contacts, body, Times(way, -time));
                }
                if (alongJoints)
                    owner.structures.Reenter(island, substep);
            }
        }

        // A body in joints has to be turned with its structure: moved alone it would leave them.
        readonly void ShiftPart(in ContactRows contacts, int body, in BodyVelocity way)
        {
            contacts.Move(body, way.Linear);
            contacts.Turn(body, way.Angular);
            for (int i = owner.groups.FirstOf(body); i >= 0; i = Pairs[i].NextOf(body))
            {
                ref var pair = ref Pairs[i];
                var ofPair = owner.Contacts(pair);
                for (int j = 0; j < pair.ContactCount; ++j)
                    ofPair.NoteMove(j, pair.A == body ? pair.Rows[j].Along(way, default) : pair.Rows[j].Along(default, way));
            }
        }

        void LookAtPairsOfAll(float dt)
        {
            for (int i = 0; i < impact.BodyCount; ++i)
            {
                if (impact.TryGetChange(i, out var body, out _))
                    LookAtPairsOf(body, -1, dt);
                else if (impact.TryGetStructure(i, out var island))
                    LookAtPairsOfStructure(island, dt);
            }
        }

        void LookAtPairsOfStructure(int island, float dt)
        {
            var (first, end) = owner.structures.PartsOf(island);
            for (int part = first; part < end; ++part)
                LookAtPairsOf(owner.structures.BodyOf(part), -1, dt);
        }

        // A table falls on four legs.
        void JoinNeighboursOfAll(int body, int index, float time, float dt)
        {
            var part = owner.structures.PartOf(body);
            if (part < 0)
            {
                JoinNeighboursOf(body, index, time, dt);
                return;
            }
            var (first, end) = owner.structures.PartsOf(owner.structures.IslandOfPart(part));
            for (int i = first; i < end; ++i)
                JoinNeighboursOf(owner.structures.BodyOf(i), index, time, dt);
        }
    }
}
