using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Contacts of a pair in the frames of its shapes, from which they follow wherever these move by a little.</summary>
// In the axes of the larger shape, as seen from the centre of the smaller, like the pose of RetestBound.
struct CarriedContacts
{
    // From B to A.
    Vector3 normal;
    FourVectors positions;
    FourFloats depths;
    FeatureIds features;

    /// <summary>Finds the contacts where the shapes are now.</summary>
    /// <param name="bound">Where the shapes were.</param>
    /// <param name="contactMask">A bit for each place that has a contact.</param>
    /// <param name="offsetB">Position of B less that of A.</param>
    /// <param name="translation">By how much the smaller shape has moved since, in the frame of the larger.</param>
    /// <param name="relative">Its orientation in that frame.</param>
    /// <param name="larger">Orientation of the larger shape.</param>
    /// <param name="rolls">Whether the contacts stay below the smaller shape, wherever that goes on the larger one.</param>
    /// <param name="result">The contacts.</param>
    // Each contact is a point of the larger shape's surface and one of the smaller's, half its depth to either side.
    public readonly void Carry(in RetestBound bound, int contactMask, in Vector3 offsetB, in Vector3 translation, in Quaternion relative,
        in Quaternion larger, bool rolls, ref ConvexContactManifold result)
    {
        Matrix3x3.CreateFromQuaternion(Exact.Concatenate(Exact.Conjugate(bound.Orientation), relative), out var rotation);
        Matrix3x3.CreateFromQuaternion(larger, out var toWorld);
        result.OffsetB = offsetB;
        Matrix3x3.Transform(normal, toWorld, out result.Normal);
        // From the larger shape's surface to the smaller one's where they touch.
        var across = bound.AIsLarger ? normal : -normal;
        // By what the contacts stay behind; one that is behind what rolls would push it on.
        var offset = rolls ? across * Exact.Dot(translation, across) : translation;
        var center = bound.AIsLarger ? offsetB : default;
        var count = 0;
        for (int i = 0; contactMask >> i != 0; ++i)
        {
            if ((contactMask >> i & 1) == 0)
                continue;
            ref var carried = ref ConvexContactManifold.GetConvexContactReference(ref result, count++);
            var halfway = across * (depths[i] * 0.5f);
            var onLarger = positions[i] - halfway - offset;
            Matrix3x3.Transform(positions[i] + halfway, rotation, out var onSmaller);
            Matrix3x3.Transform((onLarger + onSmaller) * 0.5f, toWorld, out var position);
            carried.Offset = position + center;
            carried.Depth = Exact.Dot(onSmaller - onLarger, across);
            carried.FeatureId = features[i];
        }
        result.Count = count;
    }

    /// <summary>Keeps contacts that were found where the shapes are now; they are in the first places.</summary>
    /// <param name="manifold">The contacts.</param>
    /// <param name="center">Centre of the smaller shape less that of A.</param>
    /// <param name="toLarger">Rotation from the world to the frame of the larger shape.</param>
    public void Record(in ConvexContactManifold manifold, in Vector3 center, in Quaternion toLarger)
    {
        normal = Exact.Rotate(manifold.Normal, toLarger);
        for (int i = 0; i < manifold.Count; ++i)
        {
            ref var contact = ref ConvexContactManifold.GetConvexContactReference(ref Unsafe.AsRef(in manifold), i);
            positions[i] = Exact.Rotate(contact.Offset - center, toLarger);
            depths[i] = contact.Depth;
            features[i] = contact.FeatureId;
        }
    }
}

/// <summary>A bundle of <see cref="CarriedContacts"/>, in whole rows of eight.</summary>
struct CarriedContactsWide
{
    public Vector3Wide Normal;
    public Few4<Vector3Wide> Positions;
    public Few4<Vector<float>> Depths;
    public Few4<Vector<int>> Features;
    // Fills the last row up.
    public Vector<float> Padding;
}
