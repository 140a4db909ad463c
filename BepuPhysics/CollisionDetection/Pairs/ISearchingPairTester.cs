using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>As <see cref="IPairTester{TShapeWideA, TShapeWideB, TContacts}"/>, with a state that lives as long as the pair.</summary>
/// <typeparam name="TShapeWideA">Wide form of A's shape.</typeparam>
/// <typeparam name="TShapeWideB">Wide form of B's shape.</typeparam>
/// <typeparam name="TContacts">As many contacts as a pair can have.</typeparam>
interface ISearchingPairTester<TShapeWideA, TShapeWideB, TContacts>
    where TShapeWideA : unmanaged where TShapeWideB : unmanaged where TContacts : unmanaged, IFew<ContactWide>
{
    /// <summary>Number of contacts from which on they may be carried along with the surfaces while the bodies hardly move.</summary>
    static abstract int LeastCarriedContactCount { get; }

    /// <summary>Tests a bundle of pairs.</summary>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="pose">Poses of the pairs.</param>
    /// <param name="speculativeMargin">Greatest distance at which a contact exists, m; zero or more.</param>
    /// <param name="state">Where the search of the last test ended, and then where this one did; zero where there was none.</param>
    /// <param name="measures">Bounds that hold beyond this test, but for the reaches.</param>
    /// <param name="manifold">The contacts.</param>
    static abstract void Test(in TShapeWideA a, in TShapeWideB b, in PairPoseWide pose, Vector<float> speculativeMargin,
        ref DepthSearchStateWide state, ref PairMeasuresWide measures, out ConvexManifoldWide<TContacts> manifold);

    /// <summary>Measures how far shapes reach from their centres, which only those need that remember a test.</summary>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="measures">Where the reaches go.</param>
    static abstract void MeasureReaches(in TShapeWideA a, in TShapeWideB b, ref PairMeasuresWide measures);
}
