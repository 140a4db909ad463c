using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>A bundle of shapes of one type, and the one source of its geometry: the scalar queries run one lane of it.</summary>
/// <remarks>
/// What a lane returns depends on nothing but that lane's inputs. Lanes without a shape may hold anything; their results mean nothing.
/// </remarks>
/// <typeparam name="TShape">Scalar form of the shape.</typeparam>
public interface IShapeWide<TShape> : IWide<TShape> where TShape : unmanaged, IConvexShape
{
    /// <summary>Boxes around the shapes, relative to their centres, and how far rotation can carry them beyond these.</summary>
    /// <param name="orientation">Rotations from the shapes' frames to the world; unit length.</param>
    /// <param name="maximumRadius">As in <see cref="IConvexShape.ComputeAngularExpansionData"/>.</param>
    /// <param name="maximumAngularExpansion">As in <see cref="IConvexShape.ComputeAngularExpansionData"/>.</param>
    /// <param name="min">Corners with the least coordinates, m.</param>
    /// <param name="max">Corners with the greatest coordinates, m.</param>
    void GetBounds(in QuaternionWide orientation,
        out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max);

    /// <summary>Tests each ray against the shape in its lane, as <see cref="IConvexShape.RayTest"/> does.</summary>
    /// <param name="pose">Poses of the shapes.</param>
    /// <param name="ray">One ray per lane.</param>
    /// <param name="hitMask">All bits set where the ray hits.</param>
    /// <param name="t">Place of the hit in units of the ray's direction; zero without a hit.</param>
    /// <param name="normal">Unit normal out of the shape; zero without a hit.</param>
    void RayTest(in RigidPoseWide pose, in RayWide ray, out Vector<int> hitMask, out Vector<float> t, out Vector3Wide normal);
}
