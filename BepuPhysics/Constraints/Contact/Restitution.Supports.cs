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
        // Of what rests only who is about to be hit is looked at: in a heap few are, in a substep. Their other pairs meet earlier or later by as good as
        // nothing, and are looked at when the blow has changed them.
        bool RestBodiesOf(int index)
        {
            ref var pair = ref Pairs[index];
            var restsA = !pair.RestsA && TryRest(pair.A);
            var restsB = pair.B >= 0 && !pair.RestsB && TryRest(pair.B);
            return restsA || restsB;
        }

        // By the first of the contacts that bear it. Of what is in joints the equations of these know what it gains.
        bool TryRest(int body)
        {
            if (owner.structures.PartOf(body) >= 0)
                return false;
            var bearing = owner.groups.FirstOf(body);
            while (bearing >= 0 && !Pairs[bearing].IsLoaded)
                bearing = Pairs[bearing].NextOf(body);
            if (bearing < 0)
                return false;
            if (!resting.Span.Allocated)
                resting = new(16, pool);
            var gain = Pairs[bearing].A == body ? Pairs[bearing].GainA : Pairs[bearing].GainB;
            resting.Add(new() { Body = body, Gain = gain }, pool);
            owner.Contacts(Pairs[bearing]).Push(body, Difference(default, gain));
            NoteRest(body, true);
            return true;
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
