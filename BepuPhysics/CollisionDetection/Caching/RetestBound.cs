using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>How far the bodies of a pair may move until the outcome of its last test holds no more. <c>default</c> holds never.</summary>
/// <remarks>
/// Shapes that were farther apart than they can have come closer since still have no contacts. Contacts are carried along while no point of the
/// smaller shape has moved, as the larger one sees it, by more than a small part of its size.
/// </remarks>
// What carrying contacts along costs in accuracy: a vertex that rests on a face is followed exactly, as the face turns with its body;
// other features slide by the square of the angle, which the tolerance bounds to 1e-6 of the size. The normal turns with the larger
// shape; where it belongs to the smaller, it lags by up to Tolerance rad until the next test.
// Everything is in the axes of the larger shape, as seen from the centre of the smaller: contacts are short distances then, even on a floor
// of a kilometre.
struct RetestBound
{
    /// <summary>Orientation of the smaller shape in the frame of the larger at the last test.</summary>
    public Quaternion Orientation;
    /// <summary>Position of the smaller shape in the frame of the larger at the last test, m.</summary>
    public Vector3 Offset;
    /// <summary>Of a pair without contacts: by how much less the margin the shapes may come closer until they can have some, m. Of others: the margin
    /// that these were found with, m.</summary>
    public float Clearance;
    /// <summary>Distance from the centre of the smaller shape to its farthest point, m.</summary>
    public float Reach;
    /// <summary>Steps until the next test, come what may; zero where nothing is known.</summary>
    public short Remaining;
    /// <summary>A bit for each of the places of <see cref="CarriedContacts"/> that has a contact.</summary>
    public byte ContactMask;
    public bool AIsLarger;

    /// <summary>Greatest displacement, against each other, of bodies whose contacts are carried along; part of the smaller's reach.</summary>
    public const float Tolerance = 1e-3f;

    /// <summary>
    /// Steps after which a pair is tested even though it has not moved: a bound for the drift of carried contacts, and for how long a
    /// shape that was changed in place keeps the contacts of its old form.
    /// </summary>
    public const int Lifetime = 16;

    /// <summary>Relative rounding of offsets and depths, with a margin: what shapes that are apart must be farther apart by.</summary>
    public const float Rounding = 1e-5f;

    /// <summary>Begins anew, with the shapes where they are now.</summary>
    /// <param name="offsetB">Position of B less that of A.</param>
    /// <param name="currentA">Orientation of A.</param>
    /// <param name="currentB">Orientation of B.</param>
    /// <param name="toLarger">Rotation from the world to the frame of the larger shape.</param>
    public void Place(in Vector3 offsetB, in Quaternion currentA, in Quaternion currentB, out Quaternion toLarger)
    {
        // The same operations in the same order as in Holds: a pair that has not moved has the pose that was recorded.
        toLarger = Exact.Conjugate(AIsLarger ? currentA : currentB);
        Orientation = Exact.Concatenate(AIsLarger ? currentB : currentA, toLarger);
        Offset = Exact.Rotate(AIsLarger ? offsetB : -offsetB, toLarger);
        Remaining = Lifetime;
    }

    /// <summary>Whether the outcome holds for this step, which is then one of those that remain.</summary>
    /// <param name="offsetB">Position of B less that of A.</param>
    /// <param name="currentA">Orientation of A.</param>
    /// <param name="currentB">Orientation of B.</param>
    /// <param name="speculativeMargin">Distance up to which contacts are wanted.</param>
    /// <param name="translation">By how much the smaller shape has moved since, in the frame of the larger.</param>
    /// <param name="relative">Its orientation in that frame.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool Holds(in Vector3 offsetB, in Quaternion currentA, in Quaternion currentB, float speculativeMargin, out Vector3 translation,
        out Quaternion relative)
    {
        Unsafe.SkipInit(out translation);
        Unsafe.SkipInit(out relative);
        if (Remaining == 0)
            return false;
        --Remaining;
        // The same operations in the same order as in PairHistory.Record: a pair that has not moved has the pose that was recorded.
        var toLarger = Exact.Conjugate(AIsLarger ? currentA : currentB);
        relative = Exact.Concatenate(AIsLarger ? currentB : currentA, toLarger);
        translation = Exact.Rotate(AIsLarger ? offsetB : -offsetB, toLarger) - Offset;
        var displacement = Exact.Length(translation) + Reach * Displacement(relative);
        if (ContactMask == 0)
            return displacement + speculativeMargin < Clearance;
        var allowed = Tolerance * Reach;
        return displacement < allowed && (speculativeMargin <= Clearance || speculativeMargin <= allowed);
    }

    /// <summary>Upper bound of how far a point of the smaller shape at a distance of one has moved by rotation, as the larger one sees it.</summary>
    // Unit quaternions q and r that differ by a rotation of t have |q - r| = 2 sin(t / 4); a point at a distance of 1 moves by
    // 2 sin(t / 2) = 4 sin(t / 4) cos(t / 4) <= 2 |q - r|. A dot product near one would lose the angle to rounding.
    readonly float Displacement(in Quaternion current)
    {
        var sign = Exact.Dot(Orientation, current) < 0 ? -1f : 1f;
        var x = current.X - sign * Orientation.X;
        var y = current.Y - sign * Orientation.Y;
        var z = current.Z - sign * Orientation.Z;
        var w = current.W - sign * Orientation.W;
        return 2 * MathF.Sqrt(x * x + y * y + z * z + w * w);
    }
}
