using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>What is remembered of the last test of a pair of which one shape at least is made of children: its patches, and where the shapes were.</summary>
/// <remarks>
/// While the bodies have hardly moved the patches are carried along by the rule of <see cref="PairHistory"/>, and no child is looked for. Contacts of
/// a round shape stay below it, however it has rolled; where round children may roll nothing is carried: see <see cref="ChildPairs.MayCarry"/>.
/// </remarks>
// Seven cache lines, of which a pair of one patch needs three.
[StructLayout(LayoutKind.Sequential, Size = 7 * CacheLine)]
struct ParentHistory
{
    RetestBound bound;
    ShapeIdentity shapeA;
    ShapeIdentity shapeB;
    Rolling rolling;
    PatchCodes codes;
    PatchContacts patches;

    const int CacheLine = 64;
    const int NumberBits = 2;

    // What the smaller shape may roll about: what is round goes on touching where it is lowest, however it turns about that.
    enum Rolling : byte
    {
        Never,
        AboutY,
        AboutAny,
    }

    // Number of contacts of a patch, zero behind the last; and the number that it keeps.
    [InlineArray(PatchSet.Capacity)]
    struct PatchCodes
    {
        byte first;
    }

    [InlineArray(PatchSet.Capacity)]
    struct PatchContacts
    {
        CarriedContacts first;
    }

    /// <summary>The patches of a pair, as results of its test.</summary>
    [InlineArray(PatchSet.Capacity)]
    public struct Results
    {
        ChildResult first;
    }

    /// <summary>Distance from the centre of the smaller shape to its farthest point, m; zero where it was not measured.</summary>
    public readonly float Reach => bound.Reach;

    /// <summary>Whether A is the larger shape, in whose frame the other is seen.</summary>
    public readonly bool AIsLarger => bound.AIsLarger;

    /// <summary>Forgets everything unless the pair has the shapes that the history is about.</summary>
    public void Identify(in ShapeIdentity a, in ShapeIdentity b)
    {
        if (shapeA == a && shapeB == b)
            return;
        this = default;
        shapeA = a;
        shapeB = b;
    }

    /// <summary>Takes down what the shapes are like.</summary>
    /// <param name="radiusA">Distance from the centre of A to its farthest point, m.</param>
    /// <param name="radiusB">The same of B.</param>
    public void Measure(float radiusA, float radiusB)
    {
        bound.AIsLarger = radiusA > radiusB;
        bound.Reach = bound.AIsLarger ? radiusB : radiusA;
        var smaller = (bound.AIsLarger ? shapeB : shapeA).Shape.Type;
        if (PlacedChildren.IsRound(smaller))
            rolling = smaller == Sphere.Id ? Rolling.AboutAny : Rolling.AboutY;
    }

    /// <summary>Whether contacts may be carried along in the frame of the larger shape: not where that is the one which rolls.</summary>
    public readonly bool MayCarry => !PlacedChildren.IsRound((bound.AIsLarger ? shapeA : shapeB).Shape.Type);

    /// <summary>Bytes of a history of some patches.</summary>
    public static unsafe int ByteCountOf(int patchCount) => CacheLine + patchCount * sizeof(CarriedContacts);

    /// <summary>Finds the patches without a test, if the bodies have hardly moved since the last one.</summary>
    /// <param name="offsetB">Position of B less that of A.</param>
    /// <param name="currentA">Orientation of A.</param>
    /// <param name="currentB">Orientation of B.</param>
    /// <param name="speculativeMargin">Distance up to which contacts are wanted.</param>
    /// <param name="results">Room for as many patches as a pair may have; written only on success.</param>
    /// <returns>Number of patches; zero where that was not possible.</returns>
    public int TryCarry(in Vector3 offsetB, in Quaternion currentA, in Quaternion currentB, float speculativeMargin, Span<ChildResult> results)
    {
        if (!bound.Holds(offsetB, currentA, currentB, speculativeMargin, out var translation, out var rotation))
            return 0;
        rotation = WithoutRolling(rotation);
        var count = 0;
        for (; count < PatchSet.Capacity && codes[count] != 0; ++count)
        {
            ref var result = ref results[count];
            result.Children = ChildIds.Patch(codes[count] & (1 << NumberBits) - 1);
            result.KeepsHistory = false;
            result.IsLeftToNeighbours = false;
            result.Lever = FaceLever.OfOneFace;
            result.OffsetA = default;
            patches[count].Carry(bound, (1 << (codes[count] >> NumberBits)) - 1, offsetB, translation, rotation, bound.AIsLarger ? currentA : currentB,
                rolls: rolling != Rolling.Never, ref result.Manifold);
        }
        return count;
    }

    // The orientation that the smaller shape would have without what it has turned about its axis.
    readonly Quaternion WithoutRolling(in Quaternion current)
    {
        if (rolling == Rolling.Never)
            return current;
        if (rolling == Rolling.AboutAny)
            return bound.Orientation;
        var from = Exact.Rotate(Vector3.UnitY, bound.Orientation);
        var to = Exact.Rotate(Vector3.UnitY, current);
        // Half of the turn from one to the other, which is a small one.
        var axis = Exact.Cross(from, to);
        return Exact.Concatenate(bound.Orientation, Exact.Normalize(new Quaternion(axis.X, axis.Y, axis.Z, 1 + Exact.Dot(from, to))));
    }

    /// <summary>Keeps the patches that a test has found, before a callback changes them.</summary>
    /// <param name="offsetB">Position of B less that of A.</param>
    /// <param name="currentA">Orientation of A.</param>
    /// <param name="currentB">Orientation of B.</param>
    /// <param name="speculativeMargin">Distance up to which contacts were wanted.</param>
    /// <param name="results">The results of the test; patches come first, and there is at least one.</param>
    /// <returns>Number of patches.</returns>
    public int Record(in Vector3 offsetB, in Quaternion currentA, in Quaternion currentB, float speculativeMargin, ReadOnlySpan<ChildResult> results)
    {
        bound.Place(offsetB, currentA, currentB, out var toLarger);
        bound.Clearance = speculativeMargin;
        // Not zero, which is for shapes that are apart.
        bound.ContactMask = 1;
        codes = default;
        var count = 0;
        for (; count < results.Length && results[count].Children.IsPatch; ++count)
        {
            ref readonly var result = ref results[count];
            codes[count] = (byte)(result.Manifold.Count << NumberBits | result.Children.B);
            patches[count].Record(result.Manifold, bound.AIsLarger ? offsetB : default, toLarger);
        }
        return count;
    }
}
