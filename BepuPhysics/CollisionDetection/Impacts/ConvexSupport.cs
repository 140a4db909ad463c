using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>What follows of a convex shape from its farthest points: what a shape of a game's own may answer with that has nothing better.</summary>
/// <typeparam name="TShapeWide">Wide form of the shapes.</typeparam>
/// <typeparam name="TSupport">Farthest points of the shapes.</typeparam>
public static unsafe class ConvexSupport<TShapeWide, TSupport> where TShapeWide : unmanaged where TSupport : unmanaged, ISupport<TShapeWide>
{
    // Of the size: farthest points are rounded to floats, and what is nearer counts as touched.
    const double TouchingPart = 2e-6;

    /// <summary>Box around a shape; as <see cref="IConvexShape.ComputeBounds"/>.</summary>
    /// <param name="shape">The shape, in all lanes.</param>
    /// <param name="orientation">Rotation from the shape's frame to the world; unit length.</param>
    /// <param name="min">Corner with the least coordinates, m.</param>
    /// <param name="max">Corner with the greatest coordinates, m.</param>
    public static void GetBounds(in TShapeWide shape, Quaternion orientation, out Vector3 min, out Vector3 max)
    {
        GetBounds(shape, Lanes.Broadcast<Quaternion, QuaternionWide>(orientation), out _, out _, out var mins, out var maxes);
        min = Lanes.Read<Vector3, Vector3Wide>(ref mins, 0);
        max = Lanes.Read<Vector3, Vector3Wide>(ref maxes, 0);
    }

    /// <summary>Boxes around the shapes; as <see cref="IShapeWide{TShape}.GetBounds"/>.</summary>
    /// <param name="shape">Shapes.</param>
    /// <param name="orientation">Rotations from the shapes' frames to the world; unit length.</param>
    /// <param name="maximumRadius">As in <see cref="IConvexShape.ComputeAngularExpansionData"/>.</param>
    /// <param name="maximumAngularExpansion">As in <see cref="IConvexShape.ComputeAngularExpansionData"/>.</param>
    /// <param name="min">Corners with the least coordinates, m.</param>
    /// <param name="max">Corners with the greatest coordinates, m.</param>
    public static void GetBounds(in TShapeWide shape, in QuaternionWide orientation,
        out Vector<float> maximumRadius, out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max)
    {
        TSupport.GetExtents(shape, out var center, out var inner, out var outer);
        var margin = TSupport.Margin(shape);
        var offset = center.Length();
        maximumRadius = offset + outer + margin;
        maximumAngularExpansion = maximumRadius - Wide.Max(Vector<float>.Zero, inner - offset) - margin;
        // The axes of the world in the frame of the shape.
        var axes = Matrix3x3Wide.FromQuaternion(QuaternionWide.Conjugate(orientation));
        max = new(Reach(shape, axes.X), Reach(shape, axes.Y), Reach(shape, axes.Z));
        min = -new Vector3Wide(Reach(shape, -axes.X), Reach(shape, -axes.Y), Reach(shape, -axes.Z));
        var margins = new Vector3Wide(margin, margin, margin);
        min -= margins;
        max += margins;
    }

    /// <summary>How far a rotation can carry the surface; as <see cref="IConvexShape.ComputeAngularExpansionData"/>.</summary>
    /// <param name="shape">The shape, in all lanes.</param>
    /// <param name="maximumRadius">Distance from the centre that no point is beyond, m.</param>
    /// <param name="maximumAngularExpansion">That less the radius of a ball about the centre that is known to be in the shape, m.</param>
    public static void ComputeAngularExpansionData(in TShapeWide shape, out float maximumRadius, out float maximumAngularExpansion)
    {
        GetBounds(shape, QuaternionWide.Identity, out var radius, out var expansion, out _, out _);
        maximumRadius = radius[0];
        maximumAngularExpansion = expansion[0];
    }

    static Vector<float> Reach(in TShapeWide shape, in Vector3Wide direction) =>
        Vector3Wide.Dot(direction, TSupport.Support(shape, direction, Vector<int>.Zero));

    /// <summary>Finds where a ray enters a shape; as <see cref="IConvexShape.RayTest"/>, to 2e-6 of the shape's size.</summary>
    /// <param name="shape">The shape, in all lanes.</param>
    /// <param name="pose">Its pose.</param>
    /// <param name="origin">Start of the ray in the world, m.</param>
    /// <param name="direction">Direction of the ray, of any length; zero hits nothing.</param>
    /// <param name="t">Place of the hit in units of the direction; zero without a hit.</param>
    /// <param name="normal">Unit normal out of the shape; zero without a hit.</param>
    /// <returns>Whether the ray hits.</returns>
    public static bool RayTest(in TShapeWide shape, in RigidPose pose, Vector3 origin, Vector3 direction, out float t, out Vector3 normal) =>
        RayTest(shape, 0, pose, origin, direction, out t, out normal);

    /// <summary>Tests each ray against the shape in its lane; as <see cref="IShapeWide{TShape}.RayTest"/>, one lane after the other.</summary>
    /// <param name="shape">Shapes.</param>
    /// <param name="pose">Their poses.</param>
    /// <param name="ray">One ray per lane.</param>
    /// <param name="hitMask">All bits set where the ray hits.</param>
    /// <param name="t">Place of the hit in units of the ray's direction; zero without a hit.</param>
    /// <param name="normal">Unit normal out of the shape; zero without a hit.</param>
    public static void RayTest(
        in TShapeWide shape, in RigidPoseWide pose, in RayWide ray, out Vector<int> hitMask, out Vector<float> t, out Vector3Wide normal)
    {
        hitMask = Vector<int>.Zero;
        t = Vector<float>.Zero;
        normal = Vector3Wide.Zero;
        var (poses, rays) = (pose, ray);
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            var place = new RigidPose(
                Lanes.Read<Vector3, Vector3Wide>(ref poses.Position, lane), Lanes.Read<Quaternion, QuaternionWide>(ref poses.Orientation, lane));
            var hits = RayTest(shape, lane, place, Lanes.Read<Vector3, Vector3Wide>(ref rays.Origin, lane),
                Lanes.Read<Vector3, Vector3Wide>(ref rays.Direction, lane), out var laneT, out var laneNormal);
            GatherScatter.Get(ref hitMask, lane) = hits ? -1 : 0;
            GatherScatter.Get(ref t, lane) = laneT;
            Lanes.Write(laneNormal, ref normal, lane);
        }
    }

    // The ray is a point that moves, the shape is at rest at the origin of its own frame.
    static bool RayTest(in TShapeWide shape, int lane, in RigidPose pose, in Vector3 origin, in Vector3 direction, out float t, out Vector3 normal)
    {
        t = 0;
        normal = default;
        if (direction == Vector3.Zero)
            return false;
        RigidPose.TransformByInverse(origin, pose, out var start);
        var way = Exact.RotateByInverse(direction, pose.Orientation);
        var axes = new DoubleMatrix3x3 { X = new(1, 0, 0), Y = new(0, 1, 0), Z = new(0, 0, 1) };
        var query = new LaneQuery { Shape = shape, Lane = lane };
        var core = CoreOf(shape, lane, &query, &Farthest);
        var point = new ImpactBody(ImpactCore.Point, axes, default);
        var body = new ImpactBody(core, axes, default);
        var accuracy = new ImpactAccuracy(0, 0, ImpactAccuracy.Default.MaximumRoundCount) { TouchingDistance = TouchingPart * core.Size };
        if (!ImpactPair.Find(ref point, ref body, -new DoubleVector3(start), new(way), double.MaxValue, accuracy, out var impact))
            return false;
        t = (float)impact.T;
        normal = Exact.Rotate(impact.Overlaps ? WayOut(shape, lane, start, way) : impact.Normal.ToSingle(), pose.Orientation);
        return true;
    }

    // The normal of the nearest part of the surface, for rays that start inside; against the ray where there is none.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static Vector3 WayOut(in TShapeWide shape, int lane, in Vector3 start, in Vector3 way)
    {
        var point = default(SphereWide);
        var axes = Lanes.Broadcast<Matrix3x3, Matrix3x3Wide>(Matrix3x3.Identity);
        var state = default(DepthSearchStateWide);
        DepthSearch<SphereWide, SphereSupport, TShapeWide, TSupport>.Find(
            point, shape, Lanes.Broadcast<Vector3, Vector3Wide>(-start), axes, Vector<float>.Zero, ref state, out var found);
        return GatherScatter.Get(ref found.Near, lane) != 0 ? Lanes.Read<Vector3, Vector3Wide>(ref found.Normal, lane) : -Exact.Normalize(way);
    }

    struct LaneQuery
    {
        public TShapeWide Shape;
        public int Lane;
    }

    static DoubleVector3 Farthest(void* query, DoubleVector3 direction)
    {
        ref var lane = ref *(LaneQuery*)query;
        return Farthest(lane.Shape, lane.Lane, direction);
    }

    /// <summary>A farthest point of the core in a lane.</summary>
    internal static DoubleVector3 Farthest(in TShapeWide shape, int lane, in DoubleVector3 direction)
    {
        var point = TSupport.Support(shape, Lanes.Broadcast<Vector3, Vector3Wide>(direction.ToSingle()), Vector<int>.Zero);
        return new(Lanes.Read<Vector3, Vector3Wide>(ref point, lane));
    }

    /// <summary>The core of the shape in a lane.</summary>
    /// <param name="shape">Shapes.</param>
    /// <param name="lane">The lane.</param>
    /// <param name="source">What its farthest points are asked of; stays where it is.</param>
    /// <param name="farthest">Finds a farthest point along a unit direction.</param>
    internal static ImpactCore CoreOf(in TShapeWide shape, int lane, void* source, delegate*<void*, DoubleVector3, DoubleVector3> farthest)
    {
        TSupport.GetExtents(shape, out var center, out var inner, out var outer);
        var offset = Exact.Length(Lanes.Read<Vector3, Vector3Wide>(ref center, lane));
        return ImpactCore.Own(source, farthest, TSupport.Margin(shape)[lane], offset + outer[lane], inner[lane] - offset);
    }
}
