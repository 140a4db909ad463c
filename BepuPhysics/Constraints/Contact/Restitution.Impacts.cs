using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints.Contact;

// Impacts in the order of their times, in one group of pairs after the other.
sealed unsafe partial class Restitution
{
    // Impacts of one pair in one substep.
    const int MaximumImpacts = 16;
    // Part of the substep, and of the speed, within which impacts are alike.
    internal const float AlikeShare = 1e-3f;
    // Cosine of the angle between the normals of one floor.
    const float SameDirection = 0.9999f;

    void Bounce(int block, in Substep substep, BufferPool workerPool)
    {
        var impacts = new Impacts(this, workerPool);
        for (int group = groups.FirstGroup(block); group < groups.FirstGroup(block + 1); ++group)
            impacts.Make(group, substep);
        impacts.Dispose();
    }

    // Of one worker.
    partial struct Impacts(Restitution owner, BufferPool pool)
    {
        ImpactQueue queue = new(pool);
        SharedImpact impact = new(owner.structures, pool);
        // Not allocated where nobody rests.
        QuickList<RestingBody> resting;

        readonly ref QuickList<BouncingPair> Pairs => ref owner.pairs;

        public void Dispose()
        {
            queue.Dispose();
            impact.Dispose();
            resting.DisposeIfTaken(pool);
        }

        public void Make(int group, in Substep substep)
        {
            if (!queue.Fill(ref Pairs, owner.groups, group))
                return;
            if (!owner.structures.IsEmpty)
                EnterStructures(group, substep);
            MakeImpacts(substep);
            Separate(group, substep.Dt);
            // Who was in the way.
            MakeImpacts(substep);
            LeaveSupports();
            if (!owner.structures.IsEmpty)
                LeaveStructures(group);
            HideOverlaps(group);
        }

        readonly void HideOverlaps(int group)
        {
            if (!owner.structures.IsEmpty)
                ShowStructures(group);
            for (int i = 0; i < owner.groups.CountOf(group); ++i)
            {
                ref var pair = ref Pairs[owner.groups.Pair(group, i)];
                if (pair.Overlaps)
                    owner.Contacts(pair).Hide(ref pair.Hidden, pair.Sunk);
            }
        }

        void MakeImpacts(in Substep substep)
        {
            var dt = substep.Dt;
            while (!queue.IsEmpty)
            {
                var first = queue.First;
                if (RestBodiesOf(first))
                {
                    LookAt(first, dt);
                    continue;
                }
                var time = Pairs[first].Time;
                if (TryMakeLone(first, time, dt))
                    continue;
                impact.Begin(time, dt);
                Join(first);
                // What does not bounce is by itself.
                for (int i = 0; i < impact.PairCount && Pairs[first].Coefficient > 0; ++i)
                    JoinNeighbours(impact.Pair(i), time, dt);
                impact.Solve();
                var contacts = owner.Contacts(Pairs[first]);
                if (impact.HasStructures)
                    FindPaths(contacts, time, substep);
                for (int i = 0; i < impact.PairCount; ++i)
                {
                    ref var pair = ref Pairs[impact.Pair(i)];
                    pair.Joins = false;
                    pair.Impulse += impact.NormalImpulse(i);
                    pair.Friction += impact.FrictionImpulse(i);
                    // Whom his joints hold is not asked again.
                    if (impact.HasStructures && impact.IsHeld(i))
                        pair.ImpactCount = MaximumImpacts;
                }
                for (int i = 0; i < impact.BodyCount; ++i)
                {
                    if (!impact.TryGetChange(i, out var body, out var change))
                        continue;
                    Strike(contacts, body, change, time);
                }
                if (impact.HasStructures)
                {
                    PushStructures(contacts, time, substep);
                    LookAtPairsOfAll(dt);
                    continue;
                }
                // When all have changed: a pair of two of them is looked at once, for the second one.
                var second = impact.BodyCount == 2 && impact.TryGetChange(1, out var other, out _) ? other : -1;
                for (int i = 0; i < impact.BodyCount; ++i)
                {
                    if (impact.TryGetChange(i, out var body, out _))
                        LookAtPairsOf(body, i == 0 ? second : -1, dt);
                }
            }
        }

        bool TryMakeLone(int index, float time, float dt)
        {
            ref var pair = ref Pairs[index];
            if (pair.Coefficient > 0 || pair.ContactCount > 1)
                return false;
            if (owner.structures.PartOf(pair.A) >= 0 || owner.structures.PartOf(pair.B) >= 0)
                return false;
            var contacts = owner.Contacts(pair);
            Unsafe.SkipInit(out LoneImpact lone);
            if (!lone.TryMake(pair, contacts, time, dt))
                return false;
            Note(ref pair);
            pair.Impulse += lone.Impulse;
            pair.Friction += lone.Friction;
            Strike(contacts, pair.A, lone.ChangeOfA, time);
            if (pair.B >= 0)
                Strike(contacts, pair.B, lone.ChangeOfB, time);
            LookAtPairsOf(pair.A, pair.B, dt);
            if (pair.B >= 0)
                LookAtPairsOf(pair.B, -1, dt);
            return true;
        }

        static void Note(ref BouncingPair pair)
        {
            ++pair.ImpactCount;
            if (pair.Coefficient == 0)
                pair.Stopped = MathHelper.Max(pair.Stopped, pair.Speed);
        }

        void Join(int index)
        {
            RestBodiesOf(index);
            ref var pair = ref Pairs[index];
            Note(ref pair);
            pair.Joins = true;
            impact.Add(index, pair, owner.Contacts(pair));
        }

        // What meets at the same time, as fast, is one impact. So is all that a body meets in a substep of one floor, whether that is of one piece or of tiles:
        // contacts of one patch are not told apart either.
        void JoinNeighbours(int index, float time, float dt)
        {
            JoinNeighboursOfAll(Pairs[index].A, index, time, dt);
            if (Pairs[index].B >= 0)
                JoinNeighboursOfAll(Pairs[index].B, index, time, dt);
        }

        void JoinNeighboursOf(int body, int index, float time, float dt)
        {
            for (int i = owner.groups.FirstOf(body); i >= 0 && impact.HasRoom; i = Pairs[i].NextOf(body))
            {
                ref var pair = ref Pairs[i];
                if (pair.Joins || !(pair.Coefficient > 0) || !(Pairs[index].Coefficient > 0))
                    continue;
                var meets = pair.Time < BouncingPair.Never;
                if ((meets && IsAlike(pair, Pairs[index], time, dt)) || (IsOneFloor(pair, Pairs[index]) && (meets || MeetsBarelyLater(pair, dt))))
                    Join(i);
            }
        }

        // At the same time and as fast: nothing but rounding would say which is the first. The slower of two at the same time is later, as in a row of spheres
        // that touch, of which some approach by their rounding.
        static bool IsAlike(in BouncingPair pair, in BouncingPair other, float time, float dt) =>
            pair.Time - time <= AlikeShare * dt && MathF.Abs(pair.Speed - other.Speed) <= AlikeShare * other.Speed;

        bool IsOneFloor(in BouncingPair a, in BouncingPair b) =>
            a.A == b.A && a.B == b.B && Exact.Dot(owner.Contacts(a).Normal, owner.Contacts(b).Normal) > SameDirection;

        // Whether a pair that has not met at the end of the substep does so before the next has gone on by what is alike.
        bool MeetsBarelyLater(in BouncingPair pair, float dt)
        {
            var contacts = owner.Contacts(pair);
            for (int i = 0; i < pair.ContactCount; ++i)
            {
                var speed = -pair.Rows[i].Along(contacts.VelocityA, contacts.VelocityB);
                if (pair.WithGain(i, speed) > owner.RestingSpeed(pair, contacts, pair.Gained[i], dt) &&
                    contacts.Gap(i, pair.Rows[i]) <= pair.ReachOfAlike(speed, dt))
                    return true;
            }
            return false;
        }

        readonly void Strike(in ContactRows contacts, int body, in BodyVelocity change, float time)
        {
            contacts.Push(body, change);
            Shift(contacts, body, change.Linear * -time);
            if (body < owner.Strikes.Count)
                owner.Strikes[body].Add(change.Linear, time);
        }

        readonly void Shift(in ContactRows contacts, int body, Vector3 way)
        {
            contacts.Move(body, way);
            for (int i = owner.groups.FirstOf(body); i >= 0; i = Pairs[i].NextOf(body))
                owner.Contacts(Pairs[i]).NoteMove(Pairs[i].A == body ? way : -way);
        }

        // The pairs of a body whose motion has changed, but for that with somebody who is looked at later.
        void LookAtPairsOf(int body, int later, float dt)
        {
            for (int i = owner.groups.FirstOf(body); i >= 0; i = Pairs[i].NextOf(body))
            {
                ref var pair = ref Pairs[i];
                if (later >= 0 && (pair.A == later || pair.B == later))
                    continue;
                LookAt(i, dt);
            }
        }

        void LookAt(int index, float dt)
        {
            ref var pair = ref Pairs[index];
            owner.Predict(ref pair, owner.Contacts(pair), dt);
            if (pair.ImpactCount >= MaximumImpacts)
                pair.Time = BouncingPair.Never;
            queue.Update(ref Pairs, index);
        }

        // What this leaves, as others are in the way or the overlap is deep, the next steps take out.
        void Separate(int group, float dt)
        {
            for (int i = 0; i < owner.groups.CountOf(group); ++i)
            {
                ref var pair = ref Pairs[owner.groups.Pair(group, i)];
                if (!(pair.Overlap > 0))
                    continue;
                var contacts = owner.Contacts(pair);
                var massA = contacts.InertiaA.InverseMass;
                var massB = contacts.InertiaB.InverseMass;
                if (!(massA + massB > 0))
                    continue;
                var way = pair.Overlap / (massA + massB);
                Shift(contacts, pair.A, contacts.Normal * (way * massA));
                if (pair.B >= 0)
                    Shift(contacts, pair.B, contacts.Normal * -(way * massB));
                LookAtPairsOf(pair.A, pair.B, dt);
                if (pair.B >= 0)
                    LookAtPairsOf(pair.B, -1, dt);
            }
        }
    }
}
