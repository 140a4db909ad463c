using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>The bodies of the active set as the solver reads and writes them: rows of eight floats, so that each is one transpose.</summary>
unsafe readonly struct SolverBodies(
    MotionState* motions, BodyInertia* inertias, BodyVelocity* displacements, BodyInertia* stiffness, BodyInertia* localInertias)
{
    const int FloatsPerRow = Rows8.Count;
    const int FloatsPerHalf = Transpose.FloatsPerHalf;
    const int FloatsPerMotion = 16;

    /// <summary>The bodies of a set.</summary>
    internal SolverBodies(in BodySet set) : this(
        set.MotionStates.Memory, set.WorldInertias.Memory, set.Displacements.Memory, set.Stiffness.Memory, set.LocalInertias.Memory)
    {
    }

    readonly float* motions = (float*)motions;
    readonly float* inertias = (float*)inertias;
    readonly float* displacements = (float*)displacements;
    readonly float* stiffness = (float*)stiffness;
    readonly float* localInertias = (float*)localInertias;

    /// <summary>Reads the parts of a bundle of bodies that are asked for. Unused lanes read body 0, which is harmless and exists.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal void Gather(in RowOffsets references, BodyAccess access, in Substep substep, out SolverBodyWide body)
    {
        Unsafe.SkipInit(out body);
        if ((access & BodyAccess.Pose) == BodyAccess.Orientation)
        {
            ReadFour(motions, references, out body.Orientation);
        }
        else if ((access & BodyAccess.Pose) == BodyAccess.Position)
        {
            ReadThree(motions + FloatsPerHalf, references, out body.Position);
        }
        else if ((access & BodyAccess.Pose) != 0)
        {
            var row = Transpose.Gather(motions, FloatsPerMotion, references);
            body.Orientation = new(row.R0, row.R1, row.R2, row.R3);
            body.Position = new(row.R4, row.R5, row.R6);
        }
        if ((access & BodyAccess.Velocity) == BodyAccess.Linear)
        {
            ReadThree(motions + FloatsPerRow, references, out body.Linear);
        }
        else if ((access & BodyAccess.Velocity) == BodyAccess.Angular)
        {
            ReadThree(motions + FloatsPerRow + FloatsPerHalf, references, out body.Angular);
        }
        else if ((access & BodyAccess.Velocity) != 0)
        {
            var row = Transpose.Gather(motions + FloatsPerRow, FloatsPerMotion, references);
            body.Linear = new(row.R0, row.R1, row.R2);
            body.Angular = new(row.R4, row.R5, row.R6);
        }
        if ((access & BodyAccess.Mass) == BodyAccess.InverseMass)
        {
            ReadInverseMass(references, out body.InverseMass);
        }
        else if ((access & BodyAccess.Mass) != 0)
        {
            var row = Transpose.Gather(inertias, FloatsPerRow, references);
            body.InverseInertia.XX = row.R0;
            body.InverseInertia.YX = row.R1;
            body.InverseInertia.YY = row.R2;
            body.InverseInertia.ZX = row.R3;
            body.InverseInertia.ZY = row.R4;
            body.InverseInertia.ZZ = row.R5;
            body.InverseMass = row.R6;
        }
        if ((access & BodyAccess.Displacement) != 0)
        {
            // Nothing has moved yet while the first substep is solved.
            body.Translation = default;
            body.Rotation = default;
            if (substep.Index > 0 || substep.IsRelaxation)
            {
                var row = Transpose.Gather(displacements, FloatsPerRow, references);
                body.Translation = new(row.R0, row.R1, row.R2);
                body.Rotation = new(row.R4, row.R5, row.R6);
            }
        }
    }

    /// <summary>
    /// Adds to the geometric stiffness of a bundle of bodies, N m, world axes, and to the square of their longest arm, except for kinematics and unused lanes.
    /// </summary>
    internal void AddStiffness(in RowOffsets references, in Symmetric3x3Wide added, Vector<float> armSquared)
    {
        var row = Transpose.Gather(stiffness, FloatsPerRow, references);
        row.R0 += added.XX;
        row.R1 += added.YX;
        row.R2 += added.YY;
        row.R3 += added.ZX;
        row.R4 += added.ZY;
        row.R5 += added.ZZ;
        row.R6 = Wide.Max(row.R6, armSquared);
        Transpose.Scatter(row, stiffness, FloatsPerRow, references);
    }

    /// <summary>Takes note of a neighbour of a dynamic body (LinkInertia.cs), in the order of the batches.</summary>
    // Float by float: of a bundle it is hardly ever more than one or two. All of it has what is left over in rows that the integrator reads and writes anyway:
    // what the second is worth in that of displacements, until the next step begins, what the heaviest is in that of inertias, until the next substep. Both
    // are zero before the first warm start. Whose that is stands beside the position, on which arm beside the stiffness, and means nothing where it is zero.
    internal void AddNeighbour(int body, Vector3 arm, float inverseMass, int neighbour, float inverseMassOfNeighbour)
    {
        var row = body * FloatsPerRow;
        var own = localInertias + row;
        var inertia = LinkInertia.Of(Exact.LengthSquared(arm), own[0] + own[2] + own[5], inverseMass, inverseMassOfNeighbour);
        if (inertia == 0)
            return;
        ref var heaviest = ref inertias[row + 7];
        ref var nameOfHeaviest = ref ((int*)motions)[body * FloatsPerMotion + 7];
        ref var armOfHeaviest = ref ((int*)stiffness)[row + 7];
        ref var second = ref displacements[row + 7];
        var name = LinkInertia.NameOf(neighbour);
        var isSame = name == nameOfHeaviest;
        var leastInverse = MathHelper.Min(MathHelper.Min(own[0], own[2]), own[5]);
        if (inertia > heaviest)
        {
            if (!isSame && heaviest != 0)
                second = MathHelper.Max(second, LinkInertia.Against(heaviest, LinkInertia.Unpack(armOfHeaviest), arm, inverseMass, leastInverse));
            heaviest = inertia;
            nameOfHeaviest = name;
            armOfHeaviest = LinkInertia.Pack(arm);
        }
        else if (!isSame)
        {
            second = MathHelper.Max(second, LinkInertia.Against(inertia, arm, LinkInertia.Unpack(armOfHeaviest), inverseMass, leastInverse));
        }
    }

    /// <summary>Writes the velocities of a bundle of bodies that are asked for, except for kinematics and unused lanes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal void ScatterVelocity(in RowOffsets references, BodyAccess access, in SolverBodyWide body)
    {
        if ((access & BodyAccess.Velocity) == BodyAccess.Linear)
        {
            WriteThree(motions + FloatsPerRow, references, body.Linear);
            return;
        }
        if ((access & BodyAccess.Velocity) == BodyAccess.Angular)
        {
            WriteThree(motions + FloatsPerRow + FloatsPerHalf, references, body.Angular);
            return;
        }
        Rows8 row;
        row.R0 = body.Linear.X;
        row.R1 = body.Linear.Y;
        row.R2 = body.Linear.Z;
        row.R3 = Vector<float>.Zero;
        row.R4 = body.Angular.X;
        row.R5 = body.Angular.Y;
        row.R6 = body.Angular.Z;
        row.R7 = Vector<float>.Zero;
        Transpose.Scatter(row, motions + FloatsPerRow, FloatsPerMotion, references);
    }

    // Halves of rows are moved by calls: of all that a loop could read and write, the inliner takes up what is left out as well, and then no more.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ReadFour(float* halves, in RowOffsets references, out QuaternionWide q)
    {
        var row = Transpose.GatherHalf(halves, FloatsPerMotion, references);
        q = new(row.X, row.Y, row.Z, row.W);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void ReadThree(float* halves, in RowOffsets references, out Vector3Wide v)
    {
        var row = Transpose.GatherHalf(halves, FloatsPerMotion, references);
        v = new(row.X, row.Y, row.Z);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    void ReadInverseMass(in RowOffsets references, out Vector<float> inverseMass) =>
        inverseMass = Transpose.GatherHalf(inertias + FloatsPerHalf, FloatsPerRow, references).Z;

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void WriteThree(float* halves, in RowOffsets references, in Vector3Wide v) =>
        Transpose.ScatterHalf(new(v.X, v.Y, v.Z, Vector<float>.Zero), halves, FloatsPerMotion, references);
}

/// <summary>Bodies of the fallback batch, in which a body may occur any number of times.</summary>
/// <remarks>
/// A body that occurs n times is split into n bodies, one per constraint, that share its mass and inertia. All constraints are then
/// independent and are solved in parallel; afterwards the velocity of the body is the mean of its parts by mass, which keeps the momentum
/// whatever the shares are. Tonge, Benevolenski, Voroshilov: Mass splitting for jitter-free parallel rigid body simulation, ACM Transactions
/// on Graphics 31(4), 2012; there with equal shares.
/// </remarks>
unsafe readonly struct SplitBodies(float* shares, BodyVelocity* parts)
{
    /// <summary>Share of its body's mass that every part has, in the order of the parts.</summary>
    internal readonly float* Shares = shares;
    /// <summary>Velocity of every part: lane after lane of a slot, slot after slot of a bundle, bundle after bundle.</summary>
    internal readonly BodyVelocity* Parts = parts;
}
