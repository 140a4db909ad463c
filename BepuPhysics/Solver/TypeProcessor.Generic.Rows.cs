using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints;

public sealed unsafe partial class TypeProcessor<TBodies, TPrestep, TImpulses, TConstraint>
{
    /// <inheritdoc/>
    internal override int RowCount => TConstraint.RowCount;

    /// <inheritdoc/>
    internal override bool IsLinear(int row) => TConstraint.IsLinear(row);

    /// <inheritdoc/>
    internal override RowLimit LimitOf(int row) => TConstraint.LimitOf(row);

    /// <inheritdoc/>
    internal override void ReadRows(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int bundle, Span<ConstraintRowWide> rows)
    {
        var references = (Vector<int>*)batch.BodyReferences.Memory + bundle * TBodies.Count;
        Gather(references, PlaceMask, bodies, TConstraint.SolveAccess, substep, out _, out var slots);
        rows.Clear();
        TConstraint.ReadRows(slots, substep, ((TPrestep*)batch.Prestep.Memory)[bundle], ((TImpulses*)batch.AccumulatedImpulses.Memory)[bundle], rows);
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
        Gather(references, PlaceMask, bodies, BodyAccess.Pose, new Substep(0, 1), out _, out var slots);
        TConstraint.Separation(slots, ((TPrestep*)batch.Prestep.Memory)[bundle], out var linear, out var angular);
        return new() { Linear = linear[index % Vector<float>.Count], Angular = angular[index % Vector<float>.Count] };
    }

    /// <inheritdoc/>
    internal override void WriteImpulses(ref TypeBatch batch, int bundle, ReadOnlySpan<Vector<float>> impulses, Vector<int> lanes) =>
        TConstraint.WriteImpulses(
            ((TPrestep*)batch.Prestep.Memory)[bundle], impulses, lanes, ref ((TImpulses*)batch.AccumulatedImpulses.Memory)[bundle]);
}
