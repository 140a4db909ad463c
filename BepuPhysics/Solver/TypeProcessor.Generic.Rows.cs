using System;
using System.Numerics;

namespace BepuPhysics.Constraints;

public sealed unsafe partial class TypeProcessor<TBodies, TPrestep, TImpulses, TConstraint>
{
    /// <inheritdoc/>
    internal override int RowCount => TConstraint.RowCount;

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
    internal override void WriteImpulses(ref TypeBatch batch, int bundle, ReadOnlySpan<Vector<float>> impulses, Vector<int> lanes) =>
        TConstraint.WriteImpulses(
            ((TPrestep*)batch.Prestep.Memory)[bundle], impulses, lanes, ref ((TImpulses*)batch.AccumulatedImpulses.Memory)[bundle]);
}
