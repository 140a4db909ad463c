using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Finds the contact constraints of a bundle that carry one of their bodies against what pulls at it, and are quiet.</summary>
/// <param name="bodies">The bodies, after the first integration.</param>
/// <param name="before">Their velocities before it, a row each; in its second half that of the last step, by which floors are told.</param>
/// <param name="turnsBefore">Of floors, angular velocities before it, a row each; in the second half those of the last step.</param>
/// <param name="constraints">Their lists of constraints, a row each.</param>
/// <param name="spoilt">Per body: becomes 1 where something pushes it from the side that is not found.</param>
/// <param name="reached">
/// Per body: not zero where it is connected with a kinematic body that moves, or did in the last step; null where there is none. Of those the second half of
/// each row is read too.
/// </param>
/// <param name="elsewhere">
/// Per body: how far a game has moved a kinematic one by its pose since the last step, and how much of that is rounding; null where it has moved none.
/// </param>
/// <param name="quietSteps">Substeps of acceleration up to which a contact is quiet.</param>
/// <param name="tolerance">Up to which velocity a body that rests alone has nothing to hand down.</param>
/// <param name="warmStartScale">Factor by which the warm start takes the accumulated impulses.</param>
/// <param name="dt">Length of a substep, s.</param>
// Only contacts that are quiet carry: their surfaces move no faster along or apart than the acceleration from outside gives in some substeps. What
// slides, rolls fast, tumbles or is hit is left to the sweeps, and so is what rests on something that moves.
readonly unsafe partial struct SupportFinder(
    SolverBodies bodies, BodyVelocity* before, BodyVelocity* turnsBefore, ConstraintList* constraints, byte* spoilt, byte* reached, Vector4* elsewhere,
    float quietSteps, RestTolerance tolerance, float warmStartScale, float dt)
{
    /// <summary>Fewest contacts on which a body rests: on two it may roll or rock, and what it has of momentum is no load.</summary>
    internal const int LeastContacts = 3;
    // Least part of the acceleration from outside along the normal of a contact that carries against it: 37 degrees. What leans on steeper faces, as the
    // stones of an arch, is held by both of its neighbours at once, and no order from the top down is right for it.
    internal const float LeastSlope = 0.8f;
    // Speed of a body up to which it rests, in substeps of acceleration. What sways is left to the sweeps, which damp it: held and let go by turns as its
    // contacts open and close, it would be let down on its springs and lifted again, and a stack that was pushed would sway more and more.
    internal const float RestingSteps = 1;
    // A fall along what pulls at a body is no sway: up to so many times what is quiet, what falls has just been put down, and its momentum is a load like any
    // other. Left to the sweeps, a stack that lands with .05 m/s would sink in as far as its weight presses soft contacts, since each of them stops only what
    // stands already. What falls over moves aside as it falls, and is let go: up to this part of the fall it falls straight.
    internal const float FallingShare = 4;
    internal const float StraightShare = 0.1f;
    // How much faster than what is quiet bodies may be that lean on each other, or are of a column that sways, and the surfaces of their contacts: some steps
    // of acceleration. An arch that is put down falls until it knows its load, and where a stone of it is pushed all others move; let go then it would stand
    // on soft contacts, on which a thin one falls.
    internal const float SwayingShare = 4;

    // Part of its limit from which on friction slides, and least speed of sliding, in substeps of acceleration.
    const float SlidingShare = 0.99f;
    const float SlidingSteps = 0.1f;
    // How far soft contacts sink in under the weight of a body, in substeps of the speed that one gives: 1 / (2 pi / 16)^2. What has been held and opens by
    // less would touch again as soon as it is let go, and so on for ever.
    const float SinkingSteps = 6.5f;

    /// <summary>Holds the contacts of what rests alone on what nothing pushes, and writes what else is found in a bundle, in the order of lanes.</summary>
    /// <param name="batch">The type batch.</param>
    /// <param name="bundle">The bundle.</param>
    /// <param name="found">Room for one per lane.</param>
    /// <param name="lone">Becomes known where contacts are held here.</param>
    /// <returns>How many were found, at most one per lane.</returns>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal int Find(ref TypeBatch batch, int bundle, SupportLink* found, ref LoneRests lone)
    {
        var count = ConstraintTypeIds.ContactCount(batch.TypeId);
        var hasB = batch.TypeId >= ConstraintTypeIds.ContactTwoBody;
        var prestep = (Vector<float>*)batch.Prestep.Memory + bundle * ContactPrestepLayout.PrestepFloats(count);
        var impulses = (Vector<float>*)batch.AccumulatedImpulses.Memory + bundle * ContactPrestepLayout.ImpulseFloats(count);
        var references = (Vector<int>*)batch.BodyReferences.Memory + bundle * (hasB ? 2 : 1);
        // Springs that a game asked for stay springs.
        var carries = Vector.Equals(prestep[ContactPrestepLayout.Spring(count)], Vector<float>.Zero);
        carries &= Vector.GreaterThanOrEqual(references[0], Vector<int>.Zero);
        // On so few contacts nothing rests by itself.
        if (count < LeastContacts && carries != Vector<int>.Zero)
            carries = Vector.AndNot(carries, (hasB ? AreFixed(references[1]) : new(-1)) & IsAlone((int*)references));
        if (carries == Vector<int>.Zero)
            return 0;
        // What is on its way is most of what does not rest: the velocities of the centres tell it from the others.
        SolverBodyWide bodyA = default, bodyB = default;
        Read(references[0], ref bodyA, out var gainA);
        var gain = gainA;
        var fastest = gainA.Length();
        Vector3Wide gainB = default;
        var fixedB = new Vector<int>(-1);
        if (hasB)
        {
            Read(references[1], ref bodyB, out gainB);
            fixedB = AreFixed(references[1]);
            gain = Vector3Wide.Select(fixedB, gainA, gainA + gainB);
            fastest = Wide.Max(fastest, Wide.Select(fixedB, Vector<float>.Zero, gainB.Length()));
        }
        var normal = *(Vector3Wide*)(prestep + ContactPrestepLayout.Normal(count));
        var along = -Vector3Wide.Dot(gain, normal);
        var isUpperA = Vector.GreaterThan(along, Vector<float>.Zero);
        var flat = Vector.GreaterThan(along * along, new Vector<float>(LeastSlope * LeastSlope) * gain.LengthSquared()) & (isUpperA | ~fixedB);
        var leans = Vector.AndNot(carries, flat);
        if (leans != Vector<int>.Zero)
            leans &= Pushes(count, impulses);
        if (hasB && elsewhere != null)
            carries = Vector.AndNot(carries, AreMovedInto(references[1], (float*)(prestep + ContactPrestepLayout.Normal(count))));
        if (count < LeastContacts)
            carries &= flat;
        isUpperA |= fixedB;
        var resting = Wide.Select(flat, new Vector<float>(RestingSteps), new Vector<float>(SwayingShare * quietSteps)) * fastest;
        var rests = Rests(bodyA.Linear - gainA, gainA, resting) & Rests(bodyB.Linear - gainB, gainB, resting);
        var moves = Vector<int>.Zero;
        var offsetB = *(Vector3Wide*)(prestep + ContactPrestepLayout.OffsetB(count));
        Vector3Wide turnGainB = default, givenB = gainB, turnGivenB = default;
        var earlierB = bodyB.Linear - gainB;
        var mayMove = Reached(references[0]);
        var anyMoves = mayMove != Vector<int>.Zero;
        if (hasB && anyMoves)
        {
            // What moves nearly alike may rest on what moves: the graph knows it, and asks each of both.
            var onFloor = fixedB & mayMove;
            if (onFloor != Vector<int>.Zero)
            {
                gainB = Vector3Wide.Select(onFloor, bodyB.Linear - ReadEarlier(before, references[1]), gainB);
                var turn = ReadEarlier(turnsBefore, references[1]);
                turnGivenB = ReadNow(turnsBefore, references[1]);
                turnGainB = Vector3Wide.Mask(onFloor, turnGivenB - turn);
                // What turns moves A along where that is.
                earlierB = bodyB.Linear - gainB - Vector3Wide.Mask(onFloor, Vector3Wide.Cross(turn, offsetB));
            }
            var most = resting + resting + new Vector<float>(FallingShare * quietSteps) * fastest;
            var together = flat & mayMove & Vector.LessThan((bodyA.Linear - gainA - earlierB).LengthSquared(), most * most);
            moves = Vector.AndNot(together, rests);
            rests |= together;
        }
        var wasHeld = ContactMaterialWide.WasHeld(prestep[ContactPrestepLayout.Damping(count)]);
        var maySway = Vector<int>.Zero;
        if (count >= LeastContacts)
        {
            maySway = carries & flat & (moves | ~rests);
            if (maySway != Vector<int>.Zero)
                maySway &= MaySway(bodyA.Linear - gainA, earlierB, fastest, mayMove);
        }
        carries &= rests | maySway;
        // What moves alike may rest, to a floor that moves, as long as its surfaces are quiet.
        var sways = Vector.AndNot(maySway, moves);
        if (carries == Vector<int>.Zero)
        {
            Spoil(leans, references, hasB);
            return 0;
        }

        ReadRest(references[0], ref bodyA);
        var isFloor = Vector<int>.Zero;
        carries &= Vector.GreaterThan(bodyA.InverseMass, Vector<float>.Zero);
        if (hasB)
        {
            ReadRest(references[1], ref bodyB);
            var speed = bodyB.Linear.LengthSquared() + bodyB.Angular.LengthSquared();
            var stands = Vector.Equals(speed, Vector<float>.Zero);
            if (anyMoves)
            {
                // What has just stopped is a floor that moved.
                var stood = Vector.Equals(gainB.LengthSquared() + turnGainB.LengthSquared(), Vector<float>.Zero);
                isFloor = mayMove & flat & fixedB & ~(stands & stood);
                stands = Wide.Select(mayMove, stands & stood | isFloor, stands);
            }
            carries &= Wide.Select(fixedB, stands, Vector.GreaterThan(bodyB.InverseMass, Vector<float>.Zero));
        }
        var quiet = Wide.Select(flat, new Vector<float>(quietSteps), new Vector<float>(SwayingShare * quietSteps)) * fastest;
        var bearable = Wide.Select(maySway, new Vector<float>(SwayingShare * quietSteps) * fastest, quiet);
        var slides = Vector<int>.Zero;
        var sliding = new Vector<float>(SlidingSteps) * fastest;
        var extent = new Vector<float>(float.MaxValue);
        var radius = Vector<float>.Zero;
        for (int i = 0; i < count; ++i)
        {
            var arm = ((ContactPrestepWide*)prestep)[i].OffsetA;
            var armB = arm - offsetB;
            var velocity = bodyA.Linear + Vector3Wide.Cross(bodyA.Angular, arm) - bodyB.Linear - Vector3Wide.Cross(bodyB.Angular, armB);
            var apart = Vector3Wide.Dot(velocity, normal);
            var aside = (velocity - normal * apart).LengthSquared();
            carries &= Vector.LessThan(apart, bearable) & Vector.LessThan(aside, bearable * bearable);
            if (anyMoves)
                sways |= mayMove & Vector.AndNot(maySway, Vector.LessThan(apart, quiet) & Vector.LessThan(aside, quiet * quiet));
            // What the integration has added is no sliding: the warm start takes it away.
            velocity -= gainA - gainB;
            if (anyMoves)
                velocity += Vector3Wide.Cross(turnGainB, armB);
            velocity -= normal * Vector3Wide.Dot(velocity, normal);
            slides |= Vector.GreaterThan(velocity.LengthSquared(), sliding * sliding);
            extent = Wide.Min(extent, Wide.Abs(Vector3Wide.Dot(arm, normal)));
            extent = Wide.Min(extent, Wide.Select(fixedB, extent, Wide.Abs(Vector3Wide.Dot(armB, normal))));
            radius = Wide.Max(radius, Vector3Wide.Select(isUpperA, arm, armB).LengthSquared());
        }
        slides &= IsAtLimit(count, prestep, impulses);
        var band = new Vector<float>(ContactMaterialWide.BandPerExtent) * extent;
        var open = Vector<int>.Zero;
        var near = Vector<int>.Zero;
        var reach = Wide.Mask(wasHeld, fastest * new Vector<float>(SinkingSteps * dt));
        for (int i = 0; i < count; ++i)
        {
            var touches = Vector.GreaterThanOrEqual(((ContactPrestepWide*)prestep)[i].Depth, new Vector<float>(-2) * band);
            open |= Vector.AndNot(new Vector<int>(1 << i), touches | Vector.GreaterThan(impulses[i], Vector<float>.Zero));
            near |= new Vector<int>(1 << i) & Vector.GreaterThan(((ContactPrestepWide*)prestep)[i].Depth, -reach);
        }
        carries = Vector.AndNot(carries, Vector.Equals(open, new Vector<int>((1 << count) - 1)));
        Spoil(Vector.AndNot(leans, carries), references, hasB);
        var whole = count < LeastContacts ? Vector<int>.Zero : flat & Vector.Equals(Vector.AndNot(open, near), Vector<int>.Zero);
        radius = Vector.SquareRoot(radius);
        var alone = Vector.AndNot(carries & flat & fixedB, sways);
        var turns = Vector<int>.Zero;
        if (hasB && alone != Vector<int>.Zero)
        {
            alone &= Wide.Select(isFloor, RestsOnFloor(bodyA.Linear - gainA - earlierB, gainA, gainB, turnGainB, bodyB.Angular, offsetB), ~moves);
            // What callbacks give a floor in each substep is no change of the game's.
            var given = givenB.LengthSquared() + (bodyB.Angular - turnGivenB).LengthSquared();
            alone &= Vector.Equals(given, Vector<float>.Zero) | ~isFloor;
            turns = Turns(bodyB.Angular);
        }
        if (alone != Vector<int>.Zero)
            alone = Vector.AndNot(alone, Overlaps(count, prestep, band));
        if (alone != Vector<int>.Zero)
            alone &= IsBorne(count, bodyA, bodyB, offsetB, Vector3Wide.Mask(isFloor, gainB), turnGainB, normal, impulses, fastest, radius);
        if (alone != Vector<int>.Zero)
            alone &= IsAlone((int*)references);
        if (alone != Vector<int>.Zero)
        {
            lone.AreHeld = true;
            if (anyMoves)
            {
                var changed = ~Vector.Equals(gainB.LengthSquared() + turnGainB.LengthSquared(), Vector<float>.Zero);
                ListRiders(Vector.AndNot(alone & isFloor & changed, slides), references, ref lone);
            }
            Hold(Vector.AndNot(alone, slides), hasB ? turns : new(-1), count, Vector.AndNot(open, near), band, prestep + ContactPrestepLayout.Spring(count));
            carries = Vector.AndNot(carries, alone);
            if (carries == Vector<int>.Zero)
                return 0;
        }

        var lowerA = Vector.AndNot(new Vector<int>(-1), isUpperA);
        var indexA = references[0] & new Vector<int>(EncodedBody.IndexMask);
        var indexB = hasB ? references[1] & new Vector<int>(EncodedBody.IndexMask) : indexA;
        var upper = Wide.Select(lowerA, indexB, indexA);
        var lower = Wide.Select(fixedB, new Vector<int>(SupportLink.Still), Wide.Select(lowerA, indexA, indexB));
        lower = Wide.Select(isFloor, new Vector<int>(SupportLink.Still - 1) - indexB, lower);
        int foundCount = 0;
        for (var lanes = Wide.Bits(carries); lanes != 0; lanes &= lanes - 1)
        {
            var lane = BitOperations.TrailingZeroCount(lanes);
            found[foundCount++] = new()
            {
                Prestep = (float*)prestep + lane,
                Impulses = (float*)impulses + lane,
                Upper = upper[lane],
                Lower = lower[lane],
                Band = band[lane],
                Radius = radius[lane],
                Count = (byte)count,
                Open = (byte)open[lane],
                Near = (byte)near[lane],
                HasTwoBodies = hasB,
                IsUpperA = isUpperA[lane] != 0,
                Slides = slides[lane] != 0,
                Leans = flat[lane] == 0,
                Moves = moves[lane] != 0,
                Sways = sways[lane] != 0,
                IsWhole = whole[lane] != 0,
                WasHeld = wasHeld[lane] != 0,
            };
        }
        return foundCount;
    }

    // Slow, or falling slowly and straight. Where nothing pulls at a body its gain is zero, and nothing is a fall.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    Vector<int> Rests(in Vector3Wide velocity, in Vector3Wide gain, Vector<float> resting)
    {
        var squared = gain.LengthSquared();
        var fall = Vector3Wide.Dot(velocity, gain) / Wide.Max(squared, new Vector<float>(float.Epsilon));
        fall = Wide.Clamp(fall, Vector<float>.Zero, new Vector<float>(FallingShare * quietSteps));
        var aside = Wide.Min(resting * resting, fall * fall * squared * new Vector<float>(StraightShare * StraightShare));
        return Vector.LessThan(velocity.LengthSquared(), resting * resting) | Vector.LessThan((velocity - gain * fall).LengthSquared(), aside);
    }

    // What is connected with a floor that moves the graph asks each of both to its own, and to what does not move.
    Vector<int> MaySway(in Vector3Wide a, in Vector3Wide b, Vector<float> gain, Vector<int> mayMove)
    {
        var most = new Vector<float>(SwayingShare * quietSteps) * gain;
        var maySway = Vector.LessThan(a.LengthSquared(), most * most) & Vector.LessThan(b.LengthSquared(), most * most);
        if (mayMove != Vector<int>.Zero)
            maySway = Wide.Select(mayMove, Vector.LessThan((a - b).LengthSquared(), most * most * new Vector<float>(4)), maySway);
        return maySway;
    }

    // Whether the first bodies are connected with a floor; their others are then, too.
    Vector<int> Reached(Vector<int> references)
    {
        var lanes = Vector<int>.Zero;
        for (int lane = 0; reached != null && lane < Vector<int>.Count; ++lane)
            ((int*)&lanes)[lane] = references[lane] >= 0 && reached[references[lane] & EncodedBody.IndexMask] != 0 ? -1 : 0;
        return lanes;
    }

    // Whether the second bodies were put into the first ones, along the normals, which point to these.
    [MethodImpl(MethodImplOptions.NoInlining)]
    Vector<int> AreMovedInto(Vector<int> references, float* normals)
    {
        var lanes = Vector<int>.Zero;
        for (int lane = 0; lane < Vector<int>.Count; ++lane)
        {
            if (references[lane] < 0)
                continue;
            ref var way = ref elsewhere[references[lane] & EncodedBody.IndexMask];
            var into = way.X * normals[lane] + way.Y * normals[Vector<float>.Count + lane] + way.Z * normals[2 * Vector<float>.Count + lane];
            ((int*)&lanes)[lane] = into > way.W ? -1 : 0;
        }
        return lanes;
    }

    static Vector<int> Pushes(int count, Vector<float>* impulses)
    {
        var pushes = Vector.GreaterThan(impulses[0], Vector<float>.Zero);
        for (int i = 1; i < count; ++i)
            pushes |= Vector.GreaterThan(impulses[i], Vector<float>.Zero);
        return pushes;
    }

    // Says of the bodies of some lanes that something pushes them from the side of which the graph knows nothing. Threads may say it at once.
    void Spoil(Vector<int> lanes, Vector<int>* references, bool hasB)
    {
        for (var left = Wide.Bits(lanes); left != 0; left &= left - 1)
        {
            var lane = BitOperations.TrailingZeroCount(left);
            spoilt[references[0][lane] & EncodedBody.IndexMask] = 1;
            if (hasB)
                spoilt[references[1][lane] & EncodedBody.IndexMask] = 1;
        }
    }

    static Vector<int> IsAtLimit(int count, Vector<float>* prestep, Vector<float>* impulses)
    {
        var load = impulses[0];
        for (int i = 1; i < count; ++i)
            load += impulses[i];
        var limit = new Vector<float>(SlidingShare) * prestep[ContactPrestepLayout.Friction(count)] * load;
        return Vector.GreaterThan(((Vector3Wide*)(impulses + ContactPrestepLayout.FrictionImpulse(count)))->LengthSquared(), limit * limit);
    }

    // The velocities of the centres, and what the integration has added to them.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void Read(Vector<int> references, ref SolverBodyWide body, out Vector3Wide gain)
    {
        var rows = new RowOffsets(references);
        bodies.Gather(rows, BodyAccess.Linear, default, out var read);
        body.Linear = read.Linear;
        var half = Transpose.GatherHalf((float*)before, Rows8.Count, rows);
        gain = body.Linear - new Vector3Wide(half.X, half.Y, half.Z);
    }

    // The velocities of the last step.
    static Vector3Wide ReadEarlier(BodyVelocity* rows, Vector<int> references)
    {
        var half = Transpose.GatherHalf((float*)rows + Rows8.Count / 2, Rows8.Count, new RowOffsets(references));
        return new(half.X, half.Y, half.Z);
    }

    // The velocities before the first integration.
    static Vector3Wide ReadNow(BodyVelocity* rows, Vector<int> references)
    {
        var half = Transpose.GatherHalf((float*)rows, Rows8.Count, new RowOffsets(references));
        return new(half.X, half.Y, half.Z);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void ReadRest(Vector<int> references, ref SolverBodyWide body)
    {
        bodies.Gather(new RowOffsets(references), BodyAccess.Angular | BodyAccess.InverseMass, default, out var read);
        body.Angular = read.Angular;
        body.InverseMass = read.InverseMass;
    }
}
