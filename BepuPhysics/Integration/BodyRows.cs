using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>The rows of a bundle of bodies as the integrator reads and writes them.</summary>
static unsafe class BodyRows
{
    internal const int FloatsPerRow = Rows8.Count;
    internal const int FloatsPerMotion = 2 * Rows8.Count;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void ReadBodies<TRows>(
        float* motions, float* localInertias, in TRows rows, out RigidPoseWide pose, out BodyVelocityWide velocity,
        out BodyInertiaWide localInertia)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        var row = Transpose.Gather(motions, FloatsPerMotion, rows);
        pose.Orientation = new(row.R0, row.R1, row.R2, row.R3);
        pose.Position = new(row.R4, row.R5, row.R6);
        row = Transpose.Gather(motions + FloatsPerRow, FloatsPerMotion, rows);
        velocity.Linear = new(row.R0, row.R1, row.R2);
        velocity.Angular = new(row.R4, row.R5, row.R6);
        row = Transpose.Gather(localInertias, FloatsPerRow, rows);
        localInertia.InverseInertiaTensor = new(row.R0, row.R1, row.R2, row.R3, row.R4, row.R5);
        localInertia.InverseMass = row.R6;
    }

    // A position that is not what the last step made of its origin and displacement was written since: nothing is left over from then. So it is
    // with a velocity that is not the one that the last step ended with. What is returned of the last step is what a second neighbour is worth.
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static Vector<float> Begin<TRows>(float* origins, float* displacements, in TRows rows, in Vector3Wide position, in Vector3Wide velocity)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        var origin = Transpose.Gather(origins, FloatsPerRow, rows);
        var row = Transpose.Gather(displacements, FloatsPerRow, rows);
        var kept = Vector.Equals(origin.R0 + row.R0, position.X) & Vector.Equals(origin.R1 + row.R1, position.Y) &
            Vector.Equals(origin.R2 + row.R2, position.Z);
        var keptVelocity = kept & Vector.Equals(origin.R3, velocity.X) & Vector.Equals(origin.R7, velocity.Y) & Vector.Equals(row.R3, velocity.Z);
        Rows8 start = default;
        start.R0 = Wide.Mask(kept, LeftOver(origin.R0, row.R0, position.X));
        start.R1 = Wide.Mask(kept, LeftOver(origin.R1, row.R1, position.Y));
        start.R2 = Wide.Mask(kept, LeftOver(origin.R2, row.R2, position.Z));
        Transpose.Scatter(start, displacements, FloatsPerRow, rows);
        origin.R0 = position.X;
        origin.R1 = position.Y;
        origin.R2 = position.Z;
        origin.R4 = Wide.Mask(keptVelocity, origin.R4);
        origin.R5 = Wide.Mask(keptVelocity, origin.R5);
        origin.R6 = Wide.Mask(keptVelocity, origin.R6);
        Transpose.Scatter(origin, origins, FloatsPerRow, rows);
        return row.R7;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static Vector<float> ReadSecondNeighbour<TRows>(float* displacements, in TRows rows)
        where TRows : unmanaged, IRowPlaces<TRows> =>
        Transpose.GatherHalf(displacements + Transpose.FloatsPerHalf, FloatsPerRow, rows).W;

    // The inertia that a body has in all of the step but for its bounds.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void AddLinkInertia(Vector<float> second, ref Symmetric3x3Wide inverseInertia)
    {
        if (!Vector.EqualsAll(second, Vector<float>.Zero))
            LinkInertia.Apply(second, ref inverseInertia);
    }

    // Exact by Dekker's two-sum, whichever of the two is larger: what a + b lost by rounding to sum.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<float> LeftOver(Vector<float> a, Vector<float> b, Vector<float> sum)
    {
        var second = sum - a;
        return (a - (sum - second)) + (b - second);
    }

    // Most bodies hang in nothing, or bear little: then there is nothing to transpose, and nothing to clear.
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static void Stiffen<TRows>(
        float* stiffness, in TRows rows, Vector<float> dt, bool clears, Vector<float> inverseMass, ref Symmetric3x3Wide worldInertia,
        ref Vector3Wide angular)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        if (Transpose.AreZero(stiffness, rows))
            return;
        var row = Transpose.Gather(stiffness, FloatsPerRow, rows);
        GeometricStiffness.Apply(
            new(row.R0, row.R1, row.R2, row.R3, row.R4, row.R5), Wide.DivideOrZero(row.R6, inverseMass), dt, ref worldInertia, ref angular);
        if (clears)
            Transpose.Scatter(default, stiffness, FloatsPerRow, rows);
    }

    // By this velocity the next step sees whether it was written in between. Its third component went along with the displacement.
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static void RememberVelocity<TRows>(float* origins, in TRows rows, in Vector3Wide velocity)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        var origin = Transpose.Gather(origins, FloatsPerRow, rows);
        var zero = Vector<float>.Zero;
        var lostNothing = Vector.Equals(origin.R4, zero) & Vector.Equals(origin.R5, zero) & Vector.Equals(origin.R6, zero);
        origin.R3 = Vector.ConditionalSelect(lostNothing, origin.R3, velocity.X);
        origin.R7 = Vector.ConditionalSelect(lostNothing, origin.R7, velocity.Y);
        Transpose.Scatter(origin, origins, FloatsPerRow, rows);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void WriteVelocity<TRows>(float* motions, in TRows rows, in BodyVelocityWide velocity)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        Rows8 row;
        row.R0 = velocity.Linear.X;
        row.R1 = velocity.Linear.Y;
        row.R2 = velocity.Linear.Z;
        row.R3 = Vector<float>.Zero;
        row.R4 = velocity.Angular.X;
        row.R5 = velocity.Angular.Y;
        row.R6 = velocity.Angular.Z;
        row.R7 = Vector<float>.Zero;
        Transpose.Scatter(row, motions + FloatsPerRow, FloatsPerMotion, rows);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static void WriteWorldInertia<TRows>(float* worldInertias, in TRows rows, in Symmetric3x3Wide world, Vector<float> inverseMass)
        where TRows : unmanaged, IRowPlaces<TRows>
    {
        Rows8 row;
        row.R0 = world.XX;
        row.R1 = world.YX;
        row.R2 = world.YY;
        row.R3 = world.ZX;
        row.R4 = world.ZY;
        row.R5 = world.ZZ;
        row.R6 = inverseMass;
        row.R7 = Vector<float>.Zero;
        Transpose.Scatter(row, worldInertias, FloatsPerRow, rows);
    }
}
