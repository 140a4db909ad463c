using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

// Rows for solvers other than the sweeps. Nothing here runs in a sweep, and the sweeps run nothing of it.
public abstract unsafe partial class TypeProcessor
{
    /// <summary>Number of rows of a constraint; 0 where the type is a game's own that does not tell them, and can only be swept over.</summary>
    internal abstract int RowCount { get; }

    /// <summary>Whether a row is along a direction; it is about an axis otherwise.</summary>
    internal abstract bool IsLinear(int row);

    /// <summary>Whether any row sees linear velocities; it sees angular ones alone otherwise.</summary>
    internal abstract bool SeesLinear { get; }

    /// <summary>What bounds the impulse of a row.</summary>
    internal abstract RowLimit LimitOf(int row);

    /// <summary>Reads the rows of a bundle of constraints as a sweep of the substep would find them: for the present velocities, poses and impulses.</summary>
    /// <param name="batch">Where the constraints are.</param>
    /// <param name="bodies">The bodies of the active set.</param>
    /// <param name="substep">The substep, and what its present sweep is for.</param>
    /// <param name="bundle">Index of the bundle in the type batch.</param>
    /// <param name="rows"><see cref="RowCount"/> rows, zero before; lanes without a constraint mean nothing, nor do bodies that the type does not have.</param>
    internal abstract void ReadRows(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int bundle, Span<ConstraintRowWide> rows);

    /// <summary>Adds what the loads of a bundle do to the rotation of its bodies (GeometricStiffness.cs), one constraint after the other.</summary>
    /// <param name="batch">Where the constraints are.</param>
    /// <param name="bodies">The bodies of the active set.</param>
    /// <param name="substep">The substep.</param>
    /// <param name="bundle">Index of the bundle in the type batch.</param>
    /// <param name="stiffness">Stiffness of each body, N m, world axes.</param>
    internal abstract void AddStiffness(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int bundle, Buffer<BodyInertia> stiffness);

    /// <summary>Whether constraints of the type have an error that is a distance.</summary>
    internal abstract bool HasError { get; }

    /// <summary>Greatest distance by which a rigid constraint of some bundles is not met, m; what is no number does not count.</summary>
    internal abstract float GreatestError(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int startBundle, int endBundle);

    /// <summary>Whether constraints of the type say how far their bodies are from where they hold them.</summary>
    internal abstract bool HasSeparation { get; }

    /// <summary>How far the bodies of a constraint are from where it holds them.</summary>
    /// <param name="batch">Where the constraint is.</param>
    /// <param name="bodies">Bodies with poses.</param>
    /// <param name="references">Where its bodies are among these: a vector for each body.</param>
    /// <param name="index">Index of the constraint in the batch.</param>
    internal abstract ConstraintSeparation Separation(ref TypeBatch batch, in SolverBodies bodies, Vector<int>* references, int index);

    /// <summary>Reads how far the constraints of a bundle are off that are meant to be as stiff as can be; lanes without a constraint mean nothing.</summary>
    /// <param name="batch">Where the constraints are.</param>
    /// <param name="bodies">The bodies of the active set.</param>
    /// <param name="substep">The last substep, after which bodies have moved.</param>
    /// <param name="bundle">Index of the bundle in the type batch.</param>
    /// <param name="errors">How far they are off.</param>
    internal abstract void ReadRigidErrors(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int bundle, out JointErrorWide errors);

    /// <summary>Replaces the accumulated impulses of some constraints of a bundle; the velocities of the bodies are the caller's to change.</summary>
    /// <param name="batch">Where the constraints are.</param>
    /// <param name="bundle">Index of the bundle in the type batch.</param>
    /// <param name="impulses">Impulse of each row.</param>
    /// <param name="lanes">Mask of the lanes to write.</param>
    internal abstract void WriteImpulses(ref TypeBatch batch, int bundle, ReadOnlySpan<Vector<float>> impulses, Vector<int> lanes);

    /// <summary>Reads the rows of one constraint.</summary>
    internal void ReadRows(ref TypeBatch batch, in SolverBodies bodies, in Substep substep, int index, Span<ConstraintRow> rows)
    {
        Span<ConstraintRowWide> wide = stackalloc ConstraintRowWide[RowCount];
        wide.Clear();
        ReadRows(ref batch, bodies, substep, index / Vector<float>.Count, wide);
        for (int i = 0; i < wide.Length; ++i)
            rows[i] = Lanes.Read<ConstraintRow, ConstraintRowWide>(ref wide[i], index % Vector<float>.Count);
    }

    /// <summary>Replaces the accumulated impulses of one constraint, row by row.</summary>
    internal void WriteImpulses(ref TypeBatch batch, int index, ReadOnlySpan<float> impulses)
    {
        Span<Vector<float>> wide = stackalloc Vector<float>[RowCount];
        for (int i = 0; i < wide.Length; ++i)
            wide[i] = new(impulses[i]);
        var lanes = Vector<int>.Zero.WithElement(index % Vector<float>.Count, -1);
        WriteImpulses(ref batch, index / Vector<float>.Count, wide, lanes);
    }
}
