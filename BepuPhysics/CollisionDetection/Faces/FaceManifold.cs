using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Up to four contacts of convex pairs whose normal, depth and witness are known.</summary>
/// <typeparam name="TShapeWideA">Wide form of A's shape.</typeparam>
/// <typeparam name="TFeatureA">Features of A.</typeparam>
/// <typeparam name="TShapeWideB">Wide form of B's shape.</typeparam>
/// <typeparam name="TFeatureB">Features of B.</typeparam>
public static class FaceManifold<TShapeWideA, TFeatureA, TShapeWideB, TFeatureB>
    where TShapeWideA : unmanaged where TFeatureA : unmanaged, IContactFeature<TShapeWideA>
    where TShapeWideB : unmanaged where TFeatureB : unmanaged, IContactFeature<TShapeWideB>
{
    /// <summary>Finds the contacts of a bundle of pairs.</summary>
    /// <param name="a">First shapes.</param>
    /// <param name="b">Second shapes.</param>
    /// <param name="localOffsetB">Positions of B in A's frame.</param>
    /// <param name="localOrientationB">Axes of B in A's frame, in the rows.</param>
    /// <param name="normal">Unit normals in A's frame, from B to A: the directions of least depth.</param>
    /// <param name="depth">Depths along the normals, m, the margins of rounded shapes included.</param>
    /// <param name="pointOnA">A point of each A's surface that is as deep in B, in A's frame.</param>
    /// <param name="near">All bits set where there may be contacts; the other lanes may hold anything.</param>
    /// <param name="speculativeMargin">Greatest distance at which a contact exists, m; zero or more.</param>
    /// <param name="orientationA">Axes of A in the world, in the rows.</param>
    /// <param name="manifold">The contacts.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Build(in TShapeWideA a, in TShapeWideB b, in Vector3Wide localOffsetB, in Matrix3x3Wide localOrientationB,
        in Vector3Wide normal, Vector<float> depth, in Vector3Wide pointOnA, Vector<int> near, Vector<float> speculativeMargin,
        in Matrix3x3Wide orientationA, out ConvexManifoldWide<Few4<ContactWide>> manifold)
    {
        Unsafe.SkipInit(out manifold);
        manifold.Normal = Matrix3x3Wide.TransposeTimes(orientationA, normal);
        manifold.Contacts[0].OffsetA = Matrix3x3Wide.TransposeTimes(orientationA, pointOnA + normal * (depth * new Vector<float>(0.5f)));
        manifold.Contacts[0].Depth = depth;
        manifold.Contacts[0].FeatureId = Vector<int>.Zero;
        manifold.Contacts[0].Exists = near & Vector.GreaterThanOrEqual(depth, -speculativeMargin);
        manifold.Contacts[1].Exists = Vector<int>.Zero;
        manifold.Contacts[2].Exists = Vector<int>.Zero;
        manifold.Contacts[3].Exists = Vector<int>.Zero;
    }
}
