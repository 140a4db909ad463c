using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Finds the contacts of bundles of pairs of two shape types.</summary>
/// <remarks>
/// The normal is the direction of least penetration, or of the closest features of shapes that are apart. A contact exists where its depth
/// is no less than the negated speculative margin; the deepest contact of a pair is as deep as the pair. What a lane returns depends on that
/// lane's inputs alone; lanes without a pair may hold anything, and their results mean nothing.
/// </remarks>
/// <typeparam name="TShapeWideA">Wide form of A's shape.</typeparam>
/// <typeparam name="TShapeWideB">Wide form of B's shape.</typeparam>
/// <typeparam name="TContacts">As many contacts as a pair can have.</typeparam>
public interface IPairTester<TShapeWideA, TShapeWideB, TContacts>
    where TShapeWideA : unmanaged where TShapeWideB : unmanaged where TContacts : unmanaged, IFew<ContactWide>
{
    /// <summary>Whether <see cref="Test"/> reads the orientation of A. It is not written otherwise.</summary>
    static virtual bool NeedsOrientationA => true;

    /// <summary>Whether <see cref="Test"/> reads the orientation of B. It is not written otherwise.</summary>
    static virtual bool NeedsOrientationB => true;

    /// <summary>Tests a bundle of pairs.</summary>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="pose">Poses of the pairs.</param>
    /// <param name="speculativeMargin">Greatest distance at which a contact exists, m; zero or more.</param>
    /// <param name="manifold">The contacts.</param>
    static abstract void Test(in TShapeWideA a, in TShapeWideB b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<TContacts> manifold);
}
