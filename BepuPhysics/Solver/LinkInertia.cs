using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>The least inertia of a body that heavier ones hang in at the ends of long arms.</summary>
// A link of mass m on an arm r between two heavy bodies is held by joints whose K is 1/m along the arm and 1/m + r^2/I across it. Where r is many radii of
// gyration that is many times as much, and both that the sweeps have to do with it goes wrong: the gap that a load across the arm makes is held many times as
// hard once the link has turned into it, which nobody has paid for, and a sweep over one of its joints leaves next to nothing of what the other has done.
//
// But such a link hardly turns by itself: as its anchors go where its neighbours are, turning it moves one of them against the other. Beside their
// inertia about its centre, M r^2, its own is nothing, whatever it is. So it is taken to be a small part of the second greatest of these: what is more
// than that has to be moved anyway, and the greatest of them may be that of something that never moves. Neither mass nor weight change.
//
// Turning the link about the one anchor moves the other by the distance of the two. Where both are on the same side of the centre, as in the short end of
// a lever, that is less than the arm, and counts in its place: a weight near the pivot of a long beam is not what the beam has to move at its end.
//
// Joints between the same two bodies count once: a door that hangs in two of them turns. All that is kinematic counts as one. They
// are found in each step anew, when geometric stiffness is.
static class LinkInertia
{
    // Of the second neighbour's inertia. Trees of joints gain energy with less.
    const float Part = 0.1f;
    // What a neighbour weighs is counted beyond so many times the body's own mass: bodies of like masses move as they should, on any arms.
    const float OwnMasses = 2;
    // Part of its own mass at the end of its arm that a body has in any case, if that is more than its greatest moment. Of a beam of length L that is
    // m L^2 / 12, as much as a third of its mass at either end.
    const float OwnShare = 0.33f;
    // More would leave nothing of the inverse.
    const float GreatestFactor = 1e6f;

    /// <summary>What kinematic bodies are known by.</summary>
    internal const int World = 1;

    /// <summary>What dynamic ones are known by: their index and this.</summary>
    internal const int FirstBody = 2;

    /// <summary>What a body is known by to its neighbours.</summary>
    internal static int NameOf(int reference) => (reference & EncodedBody.KinematicFlag) == 0 ? reference + FirstBody : World;

    /// <summary>Lanes in which a body is so light beside its neighbour that <see cref="Of"/> need not be zero, whatever its arm is.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector<int> IsLight(Vector<float> inverseMass, Vector<float> inverseMassOfNeighbour) =>
        Vector.GreaterThan(inverseMass, new Vector<float>(OwnMasses) * inverseMassOfNeighbour);

    /// <summary>
    /// Inertia about the centre of a body, at the end of its arm, of what a neighbour weighs beyond a multiple of the body's own mass, kg m2; zero where
    /// a part of that is less than what the body has.
    /// </summary>
    /// <param name="armSquared">Square of the body's arm.</param>
    /// <param name="trace">Trace of the body's inverse inertia.</param>
    /// <param name="inverseMass">Inverse mass of the body.</param>
    /// <param name="inverseMassOfNeighbour">Inverse mass of the neighbour.</param>
    // The mean of the inverse moments stands for the inverse inertia, which is near that of the axis of the least moment.
    internal static float Of(float armSquared, float trace, float inverseMass, float inverseMassOfNeighbour)
    {
        // What the neighbour weighs beyond, times both inverse masses.
        var beyond = inverseMass - OwnMasses * inverseMassOfNeighbour;
        var product = inverseMass * inverseMassOfNeighbour;
        return armSquared * trace * (Part / 3) * beyond > product ? MathHelper.Min(armSquared * beyond / product, float.MaxValue) : 0;
    }

    /// <summary>The inertia of a neighbour about the anchor of another one, where that is less than about the centre, kg m2.</summary>
    /// <param name="inertia">That about the centre, kg m2.</param>
    /// <param name="arm">Arm of the neighbour, m.</param>
    /// <param name="other">Arm of the other one, m.</param>
    /// <param name="inverseMass">Inverse mass of the body.</param>
    /// <param name="leastInverse">Inverse of the greatest moment of the body.</param>
    // A body that is small beside its arm has to make up for that, however near the two anchors are. A beam that has them within its length does not.
    internal static float Against(float inertia, Vector3 arm, Vector3 other, float inverseMass, float leastInverse)
    {
        var armSquared = Exact.LengthSquared(arm);
        var own = OwnShare * armSquared / inverseMass;
        var least = own * leastInverse > 1 ? own / Part : 0;
        return MathHelper.Min(inertia, MathHelper.Max(inertia * (Exact.LengthSquared(arm - other) / armSquared), least));
    }

    /// <summary>An arm in as many bits as are left over, to a hundredth of its length.</summary>
    // The exponent of the longest component, and a byte for each.
    internal static int Pack(Vector3 arm)
    {
        var longest = MathHelper.Max(MathHelper.Max(MathF.Abs(arm.X), MathF.Abs(arm.Y)), MathF.Abs(arm.Z));
        var exponent = Math.Clamp(BitConverter.SingleToInt32Bits(longest) >> MantissaBits, LeastExponent, GreatestExponent);
        var scaled = arm / UnitOf(exponent);
        return exponent << 24 | Round(scaled.X) << 16 | Round(scaled.Y) << 8 | Round(scaled.Z);
    }

    /// <summary>What <see cref="Pack"/> has made of an arm.</summary>
    internal static Vector3 Unpack(int arm) =>
        new Vector3((arm >> 16 & 0xff) - Middle, (arm >> 8 & 0xff) - Middle, (arm & 0xff) - Middle) * UnitOf((int)((uint)arm >> 24));

    const int MantissaBits = 23;
    // What the last bit of a byte is worth is not to be less or more than a float can hold.
    const int LeastExponent = 8, GreatestExponent = 253;
    const int Middle = 128;

    // The longest component is 64 to 127 of these.
    static float UnitOf(int exponent) => BitConverter.Int32BitsToSingle(exponent << MantissaBits) * (1 / 64f);

    static int Round(float value) => Math.Clamp((int)(value + (Middle + 0.5f)), 1, 255);

    /// <summary>Adds to the inertia of bodies what they lack.</summary>
    /// <param name="second">The second greatest inertia of a neighbour, kg m2; zero of others.</param>
    /// <param name="inverseInertia">Inverse inertia of the bodies.</param>
    // (I + d)^-1 = V (1 + d V)^-1 with V = I^-1, which has an answer for axes that are locked, too. The same about all axes, so that it
    // does not turn with the body.
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal static void Apply(Vector<float> second, ref Symmetric3x3Wide inverseInertia)
    {
        var trace = inverseInertia.XX + inverseInertia.YY + inverseInertia.ZZ;
        var factor = Wide.Min(second * trace * new Vector<float>(Part / 3), new Vector<float>(GreatestFactor));
        var isLink = Vector.GreaterThan(factor, Vector<float>.One);
        if (Vector.EqualsAll(isLink, Vector<int>.Zero))
            return;
        var added = Wide.DivideOrZero((factor - Vector<float>.One) * new Vector<float>(3), trace);
        var a = inverseInertia;
        var b = Symmetric3x3Wide.Invert(Symmetric3x3Wide.AddDiagonal(a * added, Vector<float>.One));
        // Functions of one matrix: their product is symmetric.
        Symmetric3x3Wide product = new(
            a.XX * b.XX + a.YX * b.YX + a.ZX * b.ZX,
            a.YX * b.XX + a.YY * b.YX + a.ZY * b.ZX, a.YX * b.YX + a.YY * b.YY + a.ZY * b.ZY,
            a.ZX * b.XX + a.ZY * b.YX + a.ZZ * b.ZX, a.ZX * b.YX + a.ZY * b.YY + a.ZZ * b.ZY, a.ZX * b.ZX + a.ZY * b.ZY + a.ZZ * b.ZZ);
        inverseInertia = Symmetric3x3Wide.Select(isLink, product, inverseInertia);
    }
}
