using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>What the depth search asks of a shape: its core, in the shape's frame, and by how much the core is rounded.</summary>
/// <remarks>
/// The core of a sphere is its centre, that of a capsule its segment; other shapes are their own. What a lane returns depends on that lane
/// alone; lanes without a shape may hold anything, and must not fail.
/// </remarks>
/// <typeparam name="TShapeWide">Wide form of the shape.</typeparam>
public interface ISupport<TShapeWide> where TShapeWide : unmanaged
{
    /// <summary>Whether cores have surfaces or edges that are not straight, so that many of their points may be farthest in turn.</summary>
    static virtual bool IsRound => false;

    /// <summary>Number of corners of a core's flat faces, at most 4; zero where there are none, or more.</summary>
    static virtual int FaceVertexCount => 0;

    /// <summary>Normal of the flat face that is nearest to a direction.</summary>
    /// <param name="shape">Shapes.</param>
    /// <param name="direction">Unit direction out of the shape.</param>
    static virtual Vector3Wide FaceNormal(in TShapeWide shape, in Vector3Wide direction) => default;

    /// <summary>A flat face.</summary>
    /// <param name="shape">Shapes.</param>
    /// <param name="normal">Its normal, as it was given.</param>
    /// <param name="face">The face.</param>
    static virtual void GetFace(in TShapeWide shape, in Vector3Wide normal, out SearchFace face) => face = default;

    /// <summary>Whether cores are cylinders about their Y axis.</summary>
    static virtual bool IsCylinder => false;

    /// <summary>Measures of a cylinder.</summary>
    /// <param name="shape">Shapes.</param>
    /// <param name="radius">Radius, m.</param>
    /// <param name="halfLength">Distance of either end from the centre, m.</param>
    static virtual void GetCylinder(in TShapeWide shape, out Vector<float> radius, out Vector<float> halfLength) =>
        radius = halfLength = Vector<float>.Zero;

    /// <summary>Distance of the surface from the core, m.</summary>
    /// <param name="shape">Shapes.</param>
    static abstract Vector<float> Margin(in TShapeWide shape);

    /// <summary>Two balls about one point of the core.</summary>
    /// <param name="shape">Shapes.</param>
    /// <param name="center">Centre of both balls; a point of the core.</param>
    /// <param name="inner">Radius of a ball that lies in the core, m; zero where the core is flat.</param>
    /// <param name="outer">Radius of a ball that holds the core, m.</param>
    static abstract void GetExtents(in TShapeWide shape, out Vector3Wide center, out Vector<float> inner, out Vector<float> outer);

    /// <summary>
    /// Makes a round core smaller. With a ball around each of its points it lies in the one that it was, and the least depth of something small
    /// that is inside of both is the same.
    /// </summary>
    /// <param name="shape">Shapes; the smaller ones.</param>
    /// <param name="reach">Radius of a ball about the shape's centre that holds the other shape, m.</param>
    /// <returns>Radius of the balls, m; zero where the shape stays as it is.</returns>
    static virtual Vector<float> Shrink(ref TShapeWide shape, Vector<float> reach) => Vector<float>.Zero;

    /// <summary>From the centre of the circle that a farthest point lies on to the point; zero for a core that is not round.</summary>
    /// <param name="point">A farthest point.</param>
    static virtual Vector3Wide Radial(in Vector3Wide point) => Vector3Wide.Zero;

    /// <summary>The direction in which a farthest point runs around its circle, as long as the radius.</summary>
    /// <param name="radial">From the circle's centre to the point.</param>
    static virtual Vector3Wide Tangent(in Vector3Wide radial) => Vector3Wide.Zero;

    /// <summary>Takes a point around its circle to where a farthest point is on its own.</summary>
    /// <param name="point">A point that was farthest in another direction.</param>
    /// <param name="radial">From the circle's centre to the farthest point.</param>
    static virtual Vector3Wide Follow(in Vector3Wide point, in Vector3Wide radial) => point;

    /// <summary>A point of the core that is farthest along a direction. Of several, always the same.</summary>
    /// <param name="shape">Shapes.</param>
    /// <param name="direction">Direction; of length one to rounding.</param>
    /// <param name="doneMask">Lanes whose result is not needed: they may return anything.</param>
    static abstract Vector3Wide Support(in TShapeWide shape, in Vector3Wide direction, Vector<int> doneMask);
}
