using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Says which feature of a shape faces a direction: the polygon, segment or point that contacts are found on.</summary>
/// <remarks>What a lane returns depends on that lane's inputs alone; lanes without a shape may hold anything and must not trap.</remarks>
/// <typeparam name="TShapeWide">Wide form of the shape.</typeparam>
public interface IContactFeature<TShapeWide> where TShapeWide : unmanaged
{
    /// <summary>Greatest number of vertices of a feature, 1 to 64.</summary>
    static abstract int MaximumVertexCount { get; }

    /// <summary>Whether the shape can roll: its surface then turns away under a contact that stays where it is.</summary>
    static virtual bool IsRound => false;

    /// <summary>
    /// Whether features are points of a surface that is curved everywhere: the shape touches there, and not where the search for the normal has ended,
    /// whose last points lie around.
    /// </summary>
    static virtual bool IsCurved => false;

    /// <summary>
    /// Whether polygons are discs across the shape's Y axis, which have 16 corners around them, as many as <see cref="MaximumVertexCount"/> says.
    /// Only their centre is asked for.
    /// </summary>
    static virtual bool IsDisc => false;

    /// <summary>
    /// Whether the shape is a plane without a border, which holds all of the other's feature. Of such a B no feature is asked for.
    /// </summary>
    static virtual bool IsPlane => false;

    /// <summary>Radius of the shapes' discs, m.</summary>
    /// <param name="shape">Shapes.</param>
    static virtual Vector<float> DiscRadius(in TShapeWide shape) => Vector<float>.Zero;

    /// <summary>Finds the feature that faces a direction.</summary>
    /// <param name="shape">Shapes.</param>
    /// <param name="direction">Unit directions out of the shapes, in their frames.</param>
    /// <param name="done">All bits set in lanes whose feature is not wanted.</param>
    /// <param name="vertices">
    /// First of <see cref="MaximumVertexCount"/> places for vertices in the shape's frame, counter-clockwise seen from outside; those from
    /// the count of a lane on repeat its first, up to the greatest count of the bundle. Of a disc, its centre alone.
    /// </param>
    /// <param name="feature">What else there is to say of the feature.</param>
    static abstract void Find(in TShapeWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices,
        out ContactFeatureWide feature);

    /// <summary>Lanes whose shape is never touched from the side that a direction out of the shape looks to.</summary>
    /// <param name="shape">Shapes.</param>
    /// <param name="direction">Unit directions out of the shapes, in their frames.</param>
    static virtual Vector<int> RejectsNormal(in TShapeWide shape, in Vector3Wide direction) => Vector<int>.Zero;
}
