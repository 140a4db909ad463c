using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>The only loops of the solver, specialised by the JIT for each type of constraint.</summary>
public sealed unsafe partial class TypeProcessor<TBodies, TPrestep, TImpulses, TConstraint> : TypeProcessor
    where TBodies : unmanaged, IBodySlots where TPrestep : unmanaged where TImpulses : unmanaged
    where TConstraint : unmanaged, IConstraint<TBodies, TPrestep, TImpulses>
{
    /// <summary>Creates the processor.</summary>
    public TypeProcessor() : base(TBodies.Count, sizeof(TPrestep) / sizeof(Vector<float>), sizeof(TImpulses) / sizeof(Vector<float>)) { }

    /// <inheritdoc/>
    internal override bool CarriesPointLoad => TConstraint.CarriesPointLoad;
    /// <inheritdoc/>
    internal override bool MakesHubs => TConstraint.MakesHubs;
    /// <inheritdoc/>
    internal override bool ClosesGaps => TConstraint.ClosesGaps;

    /// <inheritdoc/>
    internal override void ShiftOrigin(ref TypeBatch batch, Vector3 shift)
    {
        if (!TConstraint.HasPlaces)
            return;
        var prestep = (TPrestep*)batch.Prestep.Memory;
        for (int i = 0; i < batch.BundleCount; ++i)
        {
            var isUsed = Vector.LessThan(Vector<int>.Indices, new Vector<int>(batch.ConstraintCount - i * Vector<int>.Count));
            TConstraint.ShiftOrigin(ref prestep[i], Vector3Wide.Mask(isUsed, Vector3Wide.Broadcast(shift)));
        }
    }

    /// <inheritdoc/>
    internal override void WarmStart(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int startBundle, int endBundle)
    {
        var references = (Vector<int>*)batch.BodyReferences.Memory + startBundle * TBodies.Count;
        var prestep = (TPrestep*)batch.Prestep.Memory;
        var impulses = (TImpulses*)batch.AccumulatedImpulses.Memory;
        var places = PlaceMask;
        // What gathers hand to kernels begins with a line, and so do the frames of kernels.
        var above = stackalloc byte[StackLine.Length];
        var line = stackalloc byte[StackLine.BytesBelow(above, sizeof(Slots))];
        var slots = (Slots*)line;
        SlotRows* rows = &slots->Rows, next = &slots->NextRows;
        if (startBundle < endBundle)
            Locate(references, places, out *rows);
        for (int i = startBundle; i < endBundle; ++i, references += TBodies.Count)
        {
            Gather(references, *rows, bodies, TConstraint.WarmStartAccess, substep, out slots->Bodies);
            if (i + 1 < endBundle)
                Locate(references + TBodies.Count, places, out *next);
            TConstraint.WarmStart(ref slots->Bodies, substep, ref prestep[i], ref impulses[i]);
            Scatter(*rows, bodies, TConstraint.WarmStartAccess, ref slots->Bodies);
            if ((TConstraint.CarriesPointLoad || TConstraint.MayTurnFar) && substep.Index == 0)
                LookAtLoad(references, bodies, substep, slots->Bodies, prestep[i], impulses[i]);
            var spare = rows;
            rows = next;
            next = spare;
        }
    }

    /// <inheritdoc/>
    internal override void Solve(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int startBundle, int endBundle)
    {
        var references = (Vector<int>*)batch.BodyReferences.Memory + startBundle * TBodies.Count;
        var prestep = (TPrestep*)batch.Prestep.Memory;
        var impulses = (TImpulses*)batch.AccumulatedImpulses.Memory;
        var places = PlaceMask;
        // What gathers hand to kernels begins with a line, and so do the frames of kernels.
        var above = stackalloc byte[StackLine.Length];
        var line = stackalloc byte[StackLine.BytesBelow(above, sizeof(Slots))];
        var slots = (Slots*)line;
        SlotRows* rows = &slots->Rows, next = &slots->NextRows;
        if (startBundle < endBundle)
            Locate(references, places, out *rows);
        for (int i = startBundle; i < endBundle; ++i, references += TBodies.Count)
        {
            Gather(references, *rows, bodies, TConstraint.SolveAccess, substep, out slots->Bodies);
            if (i + 1 < endBundle)
                Locate(references + TBodies.Count, places, out *next);
            TConstraint.Solve(ref slots->Bodies, substep, ref prestep[i], ref impulses[i]);
            Scatter(*rows, bodies, TConstraint.SolveAccess, ref slots->Bodies);
            var spare = rows;
            rows = next;
            next = spare;
        }
    }

    /// <inheritdoc/>
    internal override void WarmStartSplit(
        ref TypeBatch batch, in SolverBodies bodies, in SplitBodies split, in Substep substep, int startBundle, int endBundle)
    {
        var references = (Vector<int>*)batch.BodyReferences.Memory;
        var prestep = (TPrestep*)batch.Prestep.Memory;
        var impulses = (TImpulses*)batch.AccumulatedImpulses.Memory;
        for (int i = startBundle; i < endBundle; ++i)
        {
            Locate(references + i * TBodies.Count, PlaceMask, out var rows);
            Gather(references + i * TBodies.Count, rows, bodies, TConstraint.WarmStartAccess | SplitAccess, substep, out var slots);
            ScaleInverseMass(i, split, ref slots);
            TConstraint.WarmStart(ref slots, substep, ref prestep[i], ref impulses[i]);
            WriteParts(i, split, ref slots);
        }
    }

    /// <inheritdoc/>
    internal override void SolveSplit(
        ref TypeBatch batch, in SolverBodies bodies, in SplitBodies split, in Substep substep, int startBundle, int endBundle)
    {
        var references = (Vector<int>*)batch.BodyReferences.Memory;
        var prestep = (TPrestep*)batch.Prestep.Memory;
        var impulses = (TImpulses*)batch.AccumulatedImpulses.Memory;
        for (int i = startBundle; i < endBundle; ++i)
        {
            Locate(references + i * TBodies.Count, PlaceMask, out var rows);
            Gather(references + i * TBodies.Count, rows, bodies, TConstraint.SolveAccess | SplitAccess, substep, out var slots);
            ScaleInverseMass(i, split, ref slots);
            // Constraints of split bodies do not see each other's impulses until the parts are joined.
            BodySlots.At(ref slots, 0).HubMask = new(-1);
            // Nor does a warm start look at what they are off by.
            BodySlots.At(ref slots, 0).CorrectionFlags = Vector<int>.Zero;
            TConstraint.Solve(ref slots, substep, ref prestep[i], ref impulses[i]);
            WriteParts(i, split, ref slots);
        }
    }

    // Once per step: the load changes little from substep to substep.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void LookAtLoad(
        Vector<int>* references, in SolverBodies bodies, in Substep substep, in TBodies slots, in TPrestep prestep, in TImpulses impulses)
    {
        var isStiffened = TConstraint.TryGetGeometricStiffness(slots, substep, prestep, impulses, out var stiffnessA, out var stiffnessB, out var turnsFar);
        if (TConstraint.MayTurnFar)
            MarkCorrection(ref references[0], turnsFar, LookAtGap(references, bodies, substep, prestep, impulses));
        if (TConstraint.TakesAlong)
            LookForNeighbours(references, bodies, slots, prestep, impulses);
        if (!isStiffened)
            return;
        ReadLoadedArms(slots, prestep, impulses, stiffnessA, stiffnessB, out var squareA, out var squareB);
        bodies.AddStiffness(new(references[0] & PlaceMask), stiffnessA, squareA);
        bodies.AddStiffness(new(references[TBodies.Count - 1] & PlaceMask), stiffnessB, squareB);
    }

    // Squares of the arms of bodies that are stiffened; zero of others.
    static void ReadLoadedArms(
        in TBodies slots, in TPrestep prestep, in TImpulses impulses, in Symmetric3x3Wide stiffnessA, in Symmetric3x3Wide stiffnessB,
        out Vector<float> squareA, out Vector<float> squareB)
    {
        TConstraint.ReadArms(slots, prestep, impulses, out var armA, out var armB);
        squareA = Wide.Mask(IsLoaded(stiffnessA), armA.LengthSquared());
        squareB = Wide.Mask(IsLoaded(stiffnessB), armB.LengthSquared());
    }

    static Vector<int> IsLoaded(in Symmetric3x3Wide stiffness) => Vector.GreaterThan(stiffness.XX + stiffness.YY + stiffness.ZZ, Vector<float>.Zero);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void LookForNeighbours(Vector<int>* references, in SolverBodies bodies, in TBodies slots, in TPrestep prestep, in TImpulses impulses)
    {
        var inverseMassA = BodySlots.At(ref Unsafe.AsRef(in slots), 0).InverseMass;
        var inverseMassB = BodySlots.At(ref Unsafe.AsRef(in slots), TBodies.Count - 1).InverseMass;
        var lightA = LinkInertia.IsLight(inverseMassA, inverseMassB);
        var lightB = LinkInertia.IsLight(inverseMassB, inverseMassA);
        if (!Vector.EqualsAll(lightA | lightB, Vector<int>.Zero))
            AddNeighbours(references, bodies, slots, prestep, impulses, lightA, lightB);
    }

    // Of none that is kinematic, and of no empty lane: neither is light.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void AddNeighbours(
        Vector<int>* references, in SolverBodies bodies, in TBodies slots, in TPrestep prestep, in TImpulses impulses, Vector<int> lightA, Vector<int> lightB)
    {
        var isFirm = TConstraint.IsFirm(prestep);
        lightA &= isFirm;
        lightB &= isFirm;
        if (Vector.EqualsAll(lightA | lightB, Vector<int>.Zero))
            return;
        TConstraint.ReadArms(slots, prestep, impulses, out var armA, out var armB);
        ref var bodyA = ref BodySlots.At(ref Unsafe.AsRef(in slots), 0);
        ref var bodyB = ref BodySlots.At(ref Unsafe.AsRef(in slots), TBodies.Count - 1);
        var referencesA = references[0] & PlaceMask;
        var referencesB = references[TBodies.Count - 1] & PlaceMask;
        for (var lanes = Wide.Bits(lightA); lanes != 0; lanes &= lanes - 1)
        {
            var lane = BitOperations.TrailingZeroCount(lanes);
            var arm = Lanes.Read<Vector3, Vector3Wide>(ref armA, lane);
            bodies.AddNeighbour(referencesA[lane], arm, bodyA.InverseMass[lane], referencesB[lane], bodyB.InverseMass[lane]);
        }
        for (var lanes = Wide.Bits(lightB); lanes != 0; lanes &= lanes - 1)
        {
            var lane = BitOperations.TrailingZeroCount(lanes);
            var arm = Lanes.Read<Vector3, Vector3Wide>(ref armB, lane);
            bodies.AddNeighbour(referencesB[lane], arm, bodyB.InverseMass[lane], referencesA[lane], bodyA.InverseMass[lane]);
        }
    }

    // Joints that close a gap which is still there. Hardly ever is there one.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> LookAtGap(Vector<int>* references, in SolverBodies bodies, in Substep substep, in TPrestep prestep, in TImpulses impulses)
    {
        var closes = CorrectionFlags(references[0]) & new Vector<int>(EncodedBody.GapMask);
        return Vector.EqualsAll(closes, Vector<int>.Zero) ? closes : MeasureGap(references, closes, bodies, substep, prestep, impulses);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector<int> MeasureGap(
        Vector<int>* references, Vector<int> closes, in SolverBodies bodies, in Substep substep, in TPrestep prestep, in TImpulses impulses)
    {
        // A warm start has not read all of it.
        Gather(references, PlaceMask, bodies, TConstraint.SolveAccess, substep, out _, out var slots);
        var isFixed = Vector<int>.Zero;
        for (int slot = 0; slot < TBodies.Count; ++slot)
            isFixed |= Vector.Equals(BodySlots.At(ref slots, slot).InverseMass, Vector<float>.Zero);
        var waySquared = TConstraint.GapSquared(slots, substep, prestep, impulses, out var opens);
        return JointGap.Follow(closes, waySquared, isFixed, opens);
    }

    // An empty reference keeps all of its bits.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void MarkCorrection(ref Vector<int> references, Vector<int> turnsFar, Vector<int> gap)
    {
        var flags = (turnsFar & new Vector<int>(EncodedBody.TurnFlag)) | gap;
        var marked = Vector.AndNot(references, new Vector<int>(EncodedBody.TurnFlag | EncodedBody.GapMask)) | flags;
        marked |= Vector.Equals(references, new Vector<int>(EncodedBody.Empty));
        // Hardly ever one to write.
        if (!Vector.EqualsAll(marked, references))
            references = marked;
    }

    // Where the rows of the bodies of a bundle are: worked out once for all that is read and written of them.
    struct SlotRows
    {
        public RowOffsets A, B, C, D;
    }

    // What of a bundle's bodies is in memory, and where the rows of the next bundle are: found out while this one is solved, since the first row that is
    // read has to wait until that is in memory.
    struct Slots
    {
        public TBodies Bodies;
        public SlotRows Rows, NextRows;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Gather(
        Vector<int>* references, Vector<int> places, in SolverBodies bodies, BodyAccess access, in Substep substep, out SlotRows rows, out TBodies slots)
    {
        Locate(references, places, out rows);
        Gather(references, rows, bodies, access, substep, out slots);
    }

    // Those of all bodies before the first row is read: one that was written between the rows of two bodies took a seventh of a sweep
    // (Docs/decisions/packed-body-rows.md).
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Locate(Vector<int>* references, Vector<int> places, out SlotRows rows)
    {
        Unsafe.SkipInit(out rows);
        rows.A = new(references[0] & places);
        if (TBodies.Count > 1) rows.B = new(references[1] & places);
        if (TBodies.Count > 2) rows.C = new(references[2] & places);
        if (TBodies.Count > 3) rows.D = new(references[3] & places);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Gather(
        Vector<int>* references, in SlotRows rows, in SolverBodies bodies, BodyAccess access, in Substep substep, out TBodies slots)
    {
        Unsafe.SkipInit(out slots);
        Gather(bodies, rows.A, access, substep, out BodySlots.At(ref slots, 0));
        if (TBodies.Count > 1) Gather(bodies, rows.B, access, substep, out BodySlots.At(ref slots, 1));
        if (TBodies.Count > 2) Gather(bodies, rows.C, access, substep, out BodySlots.At(ref slots, 2));
        if (TBodies.Count > 3) Gather(bodies, rows.D, access, substep, out BodySlots.At(ref slots, 3));
        if ((access & BodyAccess.Hub) != 0)
        {
            BodySlots.At(ref slots, 0).HubMask = HubMask(references[0]);
            if (TConstraint.MayTurnFar) BodySlots.At(ref slots, 0).CorrectionFlags = CorrectionFlags(references[0]);
            if (TBodies.Count > 1) BodySlots.At(ref slots, 1).HubMask = HubMask(references[1]);
            if (TBodies.Count > 2) BodySlots.At(ref slots, 2).HubMask = HubMask(references[2]);
            if (TBodies.Count > 3) BodySlots.At(ref slots, 3).HubMask = HubMask(references[3]);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Scatter(in SlotRows rows, in SolverBodies bodies, BodyAccess access, ref TBodies slots)
    {
        Scatter(bodies, rows.A, access, BodySlots.At(ref slots, 0));
        if (TBodies.Count > 1) Scatter(bodies, rows.B, access, BodySlots.At(ref slots, 1));
        if (TBodies.Count > 2) Scatter(bodies, rows.C, access, BodySlots.At(ref slots, 2));
        if (TBodies.Count > 3) Scatter(bodies, rows.D, access, BodySlots.At(ref slots, 3));
    }

    // More than two bodies of sixteen lanes are beyond what the inliner takes for a loop, and each part of their gathers would be a call.
    static bool IsGatheredByCalls
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TBodies.Count > 2 && Vector<float>.Count > 8;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Gather(in SolverBodies bodies, in RowOffsets rows, BodyAccess access, in Substep substep, out SolverBodyWide body)
    {
        if (IsGatheredByCalls)
            GatherByCall(bodies, rows, access, substep, out body);
        else
            bodies.Gather(rows, access, substep, out body);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void GatherByCall(in SolverBodies bodies, in RowOffsets rows, BodyAccess access, in Substep substep, out SolverBodyWide body) =>
        bodies.Gather(rows, access, substep, out body);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Scatter(in SolverBodies bodies, in RowOffsets rows, BodyAccess access, in SolverBodyWide body)
    {
        if (IsGatheredByCalls)
            ScatterByCall(bodies, rows, access, body);
        else
            bodies.ScatterVelocity(rows, access, body);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ScatterByCall(in SolverBodies bodies, in RowOffsets rows, BodyAccess access, in SolverBodyWide body) =>
        bodies.ScatterVelocity(rows, access, body);

    // What gathers and scatters know of a reference: all of it, but for joints that make hubs, which have flags in theirs. Read once
    // per loop: one call more in the loop and the JIT inlines none of them.
    static Vector<int> PlaceMask
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TConstraint.MakesHubs ? new Vector<int>(~(EncodedBody.HubFlag | EncodedBody.TurnFlag | EncodedBody.GapMask)) : new Vector<int>(-1);
    }

    // All bits of an empty reference are set; what its lane holds means nothing.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> HubMask(Vector<int> references) => Vector.Equals(references & new Vector<int>(EncodedBody.HubFlag), new(EncodedBody.HubFlag));

    // None of an empty reference, of which the sign is set as well: it is not worth a look.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<int> CorrectionFlags(Vector<int> references) =>
        Vector.AndNot(references & new Vector<int>(EncodedBody.TurnFlag | EncodedBody.GapMask), references >> 31);

    // What is split and put together again is the whole body, whatever the constraint reads of it.
    const BodyAccess SplitAccess = BodyAccess.Velocity | BodyAccess.Mass;

    static void ScaleInverseMass(int bundle, in SplitBodies split, ref TBodies slots)
    {
        for (int slot = 0; slot < TBodies.Count; ++slot)
        {
            var shares = ((Vector<float>*)split.Shares)[bundle * TBodies.Count + slot];
            var scale = Vector<float>.One / shares;
            ref var body = ref BodySlots.At(ref slots, slot);
            body.InverseMass *= scale;
            body.InverseInertia *= scale;
        }
    }

    static void WriteParts(int bundle, in SplitBodies split, ref TBodies slots)
    {
        for (int slot = 0; slot < TBodies.Count; ++slot)
        {
            ref var body = ref BodySlots.At(ref slots, slot);
            Rows8 row;
            row.R0 = body.Linear.X;
            row.R1 = body.Linear.Y;
            row.R2 = body.Linear.Z;
            row.R3 = Vector<float>.Zero;
            row.R4 = body.Angular.X;
            row.R5 = body.Angular.Y;
            row.R6 = body.Angular.Z;
            row.R7 = Vector<float>.Zero;
            var first = (bundle * TBodies.Count + slot) * Vector<float>.Count;
            Transpose.Scatter(row, (float*)split.Parts, Rows8.Count, new RowOffsets(new Vector<int>(first) + Vector<int>.Indices));
        }
    }
}
