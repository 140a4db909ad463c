namespace BepuPhysics.Constraints.Contact;

// Impacts of bodies that rest on others. What their acceleration has given them in the substep the contacts that bear them take back, but not before the
// solver: a floor that rests on another gave way to each ball by the speed of a fall of one substep. So they meet others as fast as they really move, and
// what the solver is to take back is put back for it.
sealed unsafe partial class Restitution
{
    // A body that rests, and what the integration of the substep has added to its velocity.
    struct RestingBody
    {
        public int Body;
        public BodyVelocity Gain;
    }

    partial struct Impacts
    {
        void EnterSupports(int group, float dt)
        {
            // Without an impact nobody's speeds matter.
            for (int i = 0; i < owner.groups.CountOf(group) && !queue.IsEmpty; ++i)
            {
                var index = owner.groups.Pair(group, i);
                ref var pair = ref Pairs[index];
                if (!pair.IsLoaded)
                    continue;
                Rest(pair.A, index, pair.GainA);
                if (pair.B >= 0)
                    Rest(pair.B, index, pair.GainB);
            }
            for (int i = 0; i < resting.Count; ++i)
                LookAtPairsOf(resting[i].Body, -1, dt);
        }

        // By the first of the contacts that bear it. Of what is in joints the equations of these know what it gains.
        void Rest(int body, int index, in BodyVelocity gain)
        {
            if (owner.structures.PartOf(body) >= 0)
                return;
            for (int i = owner.groups.FirstOf(body); i != index; i = Pairs[i].NextOf(body))
            {
                if (Pairs[i].IsLoaded)
                    return;
            }
            if (!resting.Span.Allocated)
                resting = new(16, pool);
            resting.Add(new() { Body = body, Gain = gain }, pool);
            owner.Contacts(Pairs[index]).Push(body, Difference(default, gain));
            NoteRest(body, true);
        }

        readonly void NoteRest(int body, bool rests)
        {
            for (int i = owner.groups.FirstOf(body); i >= 0; i = Pairs[i].NextOf(body))
            {
                ref var pair = ref Pairs[i];
                if (pair.A == body)
                    pair.RestsA = rests;
                else
                    pair.RestsB = rests;
            }
        }

        void LeaveSupports()
        {
            for (int i = 0; i < resting.Count; ++i)
            {
                var body = resting[i].Body;
                owner.Contacts(Pairs[owner.groups.FirstOf(body)]).Push(body, resting[i].Gain);
                NoteRest(body, false);
            }
            resting.Count = 0;
        }
    }
}
