using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A shape of few vertices over a plane: each vertex of the feature that faces it is a contact.</summary>
/// <remarks>For shapes whose facing feature has the point that is lowest over the plane; there is nothing to search and nothing to choose.</remarks>
/// <typeparam name="TShapeWide">Wide form of the shape.</typeparam>
/// <typeparam name="TFeature">Features of the shape.</typeparam>
/// <typeparam name="TContacts">As many contacts as a feature has vertices.</typeparam>
public readonly struct HalfSpaceTester<TShapeWide, TFeature, TContacts> : IPairTester<TShapeWide, HalfSpaceWide, TContacts>
    where TShapeWide : unmanaged where TFeature : unmanaged, IContactFeature<TShapeWide> where TContacts : unmanaged, IFew<ContactWide>
{
    /// <inheritdoc/>
    public static bool NeedsOrientationA => TFeature.MaximumVertexCount > 1;

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Test(in TShapeWide a, in HalfSpaceWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<TContacts> manifold)
    {
        Unsafe.SkipInit(out manifold);
        var normal = pose.OrientationB * b.Normal;
        // Of the plane over A's centre.
        var height = Vector3Wide.Dot(normal, pose.OffsetB);
        // A sphere has no axes, and none are written.
        Matrix3x3Wide axes = default;
        var down = -normal;
        if (TFeature.MaximumVertexCount > 1)
        {
            axes = Matrix3x3Wide.FromQuaternion(pose.OrientationA);
            down = axes * down;
        }
        Few4<Vector3Wide> vertices = default;
        TFeature.Find(a, down, Vector<int>.Zero, ref vertices[0], out var feature);
        var rejected = TFeature.RejectsNormal(a, down);
        manifold.Normal = normal;
        for (int i = 0; i < TFeature.MaximumVertexCount; ++i)
        {
            var vertex = TFeature.MaximumVertexCount > 1 ? Matrix3x3Wide.TransposeTimes(axes, vertices[i]) : Vector3Wide.Zero;
            var depth = height - Vector3Wide.Dot(normal, vertex) + feature.Margin;
            ref var contact = ref manifold.Contacts[i];
            // Halfway between the plane and the surface, which is the margin below the vertex.
            contact.OffsetA = vertex + normal * (depth * new Vector<float>(0.5f) - feature.Margin);
            contact.Depth = depth;
            contact.FeatureId = feature.Id << VertexBits | new Vector<int>(i);
            contact.Exists = Vector.GreaterThanOrEqual(depth, -speculativeMargin) & ~rejected;
        }
        if (TFeature.MaximumVertexCount == 2)
            JoinEnds(feature.Size, ref manifold);
    }

    const int VertexBits = 2;

    // A capsule that stands upright, or is a sphere, touches with one end.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void JoinEnds(Vector<float> size, ref ConvexManifoldWide<TContacts> manifold)
    {
        ref var first = ref manifold.Contacts[0];
        ref var second = ref manifold.Contacts[1];
        var between = second.OffsetA - first.OffsetA;
        between -= manifold.Normal * Vector3Wide.Dot(between, manifold.Normal);
        var least = size * new Vector<float>(PairTolerances.SameContactOnFace);
        var isOne = Vector.LessThanOrEqual(between.LengthSquared(), least * least);
        var firstIsDeeper = Vector.GreaterThanOrEqual(first.Depth, second.Depth);
        first.Exists = Vector.AndNot(first.Exists, isOne & ~firstIsDeeper);
        second.Exists = Vector.AndNot(second.Exists, isOne & firstIsDeeper);
    }
}
