using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

public sealed unsafe partial class TypeProcessor<TBodies, TPrestep, TImpulses, TConstraint>
{
    /// <inheritdoc/>
    internal override int RowCount => TConstraint.RowCount;

    /// <inheritdoc/>
    internal override bool IsLinear(int row) => TConstraint.IsLinear(row);

    /// <inheritdoc/>
    internal override bool SeesLinear => (TConstraint.SolveAccess & BodyAccess.Linear) != 0;

    /// <inheritdoc/>
    internal override RowLimit LimitOf(int row) => TConstraint.LimitOf(row);

    /// <inheritdoc/>
    internal override void ReadRows(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int bundle, Span<ConstraintRowWide> rows)
    {
        var references = (Vector<int>*)batch.BodyReferences.Memory + bundle * TBodies.Count;
        Gather(references, PlaceMask, bodies, TConstraint.SolveAccess, substep, out _, out var slots);
        TConstraint.ReadRows(slots, substep, ((TPrestep*)batch.Prestep.Memory)[bundle], ((TImpulses*)batch.AccumulatedImpulses.Memory)[bundle], rows);
    }

    /// <inheritdoc/>
    internal override void AddStiffness(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int bundle, Buffer<BodyInertia> stiffness)
    {
        var references = (Vector<int>*)batch.BodyReferences.Memory + bundle * TBodies.Count;
        Gather(references, PlaceMask, bodies, TConstraint.WarmStartAccess, substep, out _, out var slots);
        ref var prestep = ref ((TPrestep*)batch.Prestep.Memory)[bundle];
        ref var impulses = ref ((TImpulses*)batch.AccumulatedImpulses.Memory)[bundle];
        if (!TConstraint.TryGetGeometricStiffness(slots, substep, prestep, impulses, out var ofFirst, out var ofLast, out _))
            return;
        var margin = new Vector<float>(GeometricStiffness.DirectMargin);
        ofFirst *= margin;
        ofLast *= margin;
        ReadLoadedArms(slots, prestep, impulses, ofFirst, ofLast, out var squareOfFirst, out var squareOfLast);
        var lanes = Math.Min(Vector<float>.Count, batch.ConstraintCount - bundle * Vector<float>.Count);
        for (int lane = 0; lane < lanes; ++lane)
        {
            AddStiffness(references[0][lane], ofFirst, squareOfFirst, lane, stiffness);
            AddStiffness(references[TBodies.Count - 1][lane], ofLast, squareOfLast, lane, stiffness);
        }
    }

    // The square of the longest arm is where an inertia has the inverse mass.
    static void AddStiffness(int reference, in Symmetric3x3Wide added, Vector<float> armSquared, int lane, Buffer<BodyInertia> stiffness)
    {
        if ((reference & EncodedBody.KinematicFlag) != 0)
            return;
        ref var sum = ref stiffness[reference & EncodedBody.IndexMask];
        sum.InverseMass = MathHelper.Max(sum.InverseMass, armSquared[lane]);
        sum.InverseInertiaTensor += Lanes.Read<Symmetric3x3, Symmetric3x3Wide>(ref Unsafe.AsRef(in added), lane);
    }

    /// <inheritdoc/>
    internal override bool HasError => TConstraint.HasError;

    /// <inheritdoc/>
    internal override float GreatestError(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int startBundle, int endBundle)
    {
        var references = (Vector<int>*)batch.BodyReferences.Memory + startBundle * TBodies.Count;
        var greatest = Vector<float>.Zero;
        for (int i = startBundle; i < endBundle; ++i, references += TBodies.Count)
        {
            Gather(references, PlaceMask, bodies, TConstraint.ErrorAccess, substep, out _, out var slots);
            var error = TConstraint.Error(slots, ((TPrestep*)batch.Prestep.Memory)[i]);
            // All bits of the reference of an unused lane are set.
            var exists = ~Vector.Equals(references[0], new Vector<int>(EncodedBody.Empty));
            greatest = Wide.Select(exists & Vector.GreaterThan(error, greatest), error, greatest);
        }
        var most = 0f;
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
            most = MathHelper.Max(most, greatest[lane]);
        return most;
    }

    /// <inheritdoc/>
    internal override bool HasSeparation => TConstraint.HasSeparation;

    /// <inheritdoc/>
    internal override ConstraintSeparation Separation(ref TypeBatch batch, in SolverBodies bodies, Vector<int>* references, int index)
    {
        var bundle = index / Vector<float>.Count;
        Gather(references, PlaceMask, bodies, TConstraint.ErrorAccess, new Substep(0, 1), out _, out var slots);
        TConstraint.Separation(slots, ((TPrestep*)batch.Prestep.Memory)[bundle], out var linear, out var angular);
        return new() { Linear = linear[index % Vector<float>.Count], Angular = angular[index % Vector<float>.Count] };
    }

    /// <inheritdoc/>
    internal override void ReadRigidErrors(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int bundle, out JointErrorWide errors)
    {
        var references = (Vector<int>*)batch.BodyReferences.Memory + bundle * TBodies.Count;
        Gather(references, PlaceMask, bodies, TConstraint.ErrorAccess | BodyAccess.Velocity, substep, out _, out var slots);
        TConstraint.RigidError(slots, substep, ((TPrestep*)batch.Prestep.Memory)[bundle], out errors);
    }

    /// <inheritdoc/>
    internal override void WriteImpulses(ref TypeBatch batch, int bundle, ReadOnlySpan<Vector<float>> impulses, Vector<int> lanes) =>
        TConstraint.WriteImpulses(
            ((TPrestep*)batch.Prestep.Memory)[bundle], impulses, lanes, ref ((TImpulses*)batch.AccumulatedImpulses.Memory)[bundle]);
}
