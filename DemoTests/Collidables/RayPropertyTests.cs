using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using Demos.References;
using FsCheck;
using FsCheck.Fluent;
using Xunit;

namespace DemoTests.Collidables;

/// <summary>Rays against signed distances in double precision: what is no matter of rounding must be told right.</summary>
public class RayPropertyTests
{
    [Fact]
    public void SphereRaysAgreeWithTheDistanceField() => RaysAgree(ShapeGenerators.Spheres);

    [Fact]
    public void CapsuleRaysAgreeWithTheDistanceField() => RaysAgree(ShapeGenerators.Capsules);

    [Fact]
    public void BoxRaysAgreeWithTheDistanceField() => RaysAgree(ShapeGenerators.Boxes);

    [Fact]
    public void CylinderRaysAgreeWithTheDistanceField() => RaysAgree(ShapeGenerators.Cylinders);

    [Fact]
    public void SphereLanesAreIndependent() => LanesAreIndependent<Sphere, SphereWide>(ShapeGenerators.Spheres);

    [Fact]
    public void CapsuleLanesAreIndependent() => LanesAreIndependent<Capsule, CapsuleWide>(ShapeGenerators.Capsules);

    [Fact]
    public void BoxLanesAreIndependent() => LanesAreIndependent<Box, BoxWide>(ShapeGenerators.Boxes);

    [Fact]
    public void CylinderLanesAreIndependent() => LanesAreIndependent<Cylinder, CylinderWide>(ShapeGenerators.Cylinders);

    sealed record Case<TShape>(TShape Shape, RigidPose Pose, Vector3 Origin, Vector3 Direction);

    /// <summary>
    /// Rays that start from inside to a thousand sizes away, aim at points in and around the shape, and have any length. A quarter of them
    /// are parallel to a coordinate axis.
    /// </summary>
    static Gen<Case<TShape>> Cases<TShape>(Gen<TShape> shapes) where TShape : unmanaged, IConvexShape =>
        from shape in shapes
        let size = (float)ShapeOracle.Size(shape).Largest
        from orientation in ShapeGenerators.Orientations
        from position in ShapeGenerators.Directions
        from positionDistance in ShapeGenerators.Uniform(0, 10)
        from target in ShapeGenerators.Directions
        from targetDistance in ShapeGenerators.Uniform(0, 1.3f)
        from start in ShapeGenerators.Directions
        from startExponent in ShapeGenerators.Uniform(-2, 3)
        from axis in Gen.Choose(0, 11)
        from length in ShapeGenerators.Uniform(-12, 12)
        let aim = target * (targetDistance * size)
        let distance = (float)Math.Pow(10, startExponent) * size
        let backwards = axis < 3 ? new Vector3(axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0) : start
        let pose = new RigidPose(position * (positionDistance * size), orientation)
        select new Case<TShape>(shape, pose, pose.Position + aim + backwards * distance, backwards * -(float)Math.Pow(10, length));

    static void RaysAgree<TShape>(Gen<TShape> shapes) where TShape : unmanaged, IConvexShape =>
        Prop.ForAll(Cases(shapes).ToArbitrary(), c =>
        {
            var reason = Disagreement(c.Shape, c.Pose, c.Origin, c.Direction);
            return (reason == null).Label(reason ?? "");
        }).Check(ShapeGenerators.Reproducible(3000));

    /// <summary>What is wrong with the answer to a ray, if anything.</summary>
    internal static string? Disagreement<TShape>(TShape shape, in RigidPose pose, Vector3 origin, Vector3 direction)
        where TShape : unmanaged, IConvexShape
    {
        var hit = shape.RayTest(pose, origin, direction, out var t, out var normal);
        var rotation = DoubleQuaternion.Normalize(pose.Orientation);
        var localOrigin = rotation.RotateBack((Double3)origin - pose.Position);
        var length = ((Double3)direction).Length;
        var localDirection = rotation.RotateBack((Double3)direction * (1 / length));
        var (clearance, entry) = ShapeOracle.CastRay(shape, localOrigin, localDirection);
        var (largest, smallest) = ShapeOracle.Size(shape);
        // Roundings of the direction shift the line by their size times the distance, those of the shape's points by theirs.
        var tolerance = 1e-6 * (largest + localOrigin.Length);
        if (!hit && (t != 0 || normal != default))
            return "a miss with a result";
        if (!hit)
            return clearance < -tolerance ? $"missed by a ray that passes {-clearance} deep" : null;
        if (clearance > tolerance)
            return $"hit by a ray that passes {clearance} away";
        if (!(t >= 0) || !float.IsFinite(t))
            return $"t is {t}";
        if (Math.Abs(((Double3)normal).Length - 1) > 1e-6)
            return $"normal of length {((Double3)normal).Length}";
        var localNormal = rotation.RotateBack(normal);
        var startDistance = ShapeOracle.Distance(shape, localOrigin);
        if (startDistance < -tolerance)
        {
            // Where the nearest surface is a matter of rounding (on the axis of a capsule) any direction may be given.
            var reached = ShapeOracle.Distance(shape, localOrigin - localNormal * startDistance);
            var isOnCore = startDistance < -smallest + tolerance;
            if (t != 0)
                return $"starts inside, but t is {t}";
            return !isOnCore && Math.Abs(reached) > 3 * tolerance ? $"the normal leads to {reached} from the surface" : null;
        }
        var point = localOrigin + localDirection * (t * length);
        var distance = ShapeOracle.Distance(shape, point);
        if (Math.Abs(distance) > 3 * tolerance)
            return $"the hit is {distance} from the surface";
        // Out along the normal the distance grows by as much as one moves, and in no other direction. Roundings of the point turn the
        // normal of a round shape by their size over the radius.
        var step = 0.5 * smallest;
        var gained = ShapeOracle.Distance(shape, point + localNormal * step) - distance;
        if (gained < step * (1 - 1e-5) - 4 * tolerance)
            return $"{step} along the normal leads only {gained} away";
        // Where the ray meets the surface at an angle, the error of the place along the ray grows by its cosine.
        var slope = -Double3.Dot(localNormal, localDirection);
        if (clearance < -tolerance && slope > 0.05 && startDistance > tolerance && Math.Abs(t * length - entry) > 4 * tolerance / slope)
            return $"the hit is {t * length} away, not {entry}";
        return null;
    }

    static void LanesAreIndependent<TShape, TShapeWide>(Gen<TShape> shapes)
        where TShape : unmanaged, IConvexShape where TShapeWide : unmanaged, IShapeWide<TShape> =>
        Prop.ForAll(Gen.ArrayOf(Cases(shapes), Vector<float>.Count).ToArbitrary(), lanes =>
        {
            var equal = true;
            for (int shift = 0; shift < lanes.Length; ++shift)
            {
                TShapeWide bundle = default;
                RigidPoseWide poses = default;
                RayWide rays = default;
                for (int i = 0; i < lanes.Length; ++i)
                {
                    var lane = (i + shift) % lanes.Length;
                    Lanes.Write(lanes[i].Shape, ref bundle, lane);
                    Lanes.Write(lanes[i].Pose.Position, ref poses.Position, lane);
                    Lanes.Write(lanes[i].Pose.Orientation, ref poses.Orientation, lane);
                    Lanes.Write(lanes[i].Origin, ref rays.Origin, lane);
                    Lanes.Write(lanes[i].Direction, ref rays.Direction, lane);
                }
                bundle.RayTest(poses, rays, out var hitMask, out var t, out var normal);
                for (int i = 0; i < lanes.Length; ++i)
                {
                    var lane = (i + shift) % lanes.Length;
                    var c = lanes[i];
                    var hit = c.Shape.RayTest(c.Pose, c.Origin, c.Direction, out var expectedT, out var expectedNormal);
                    equal &= hitMask[lane] == (hit ? -1 : 0) && t[lane] == expectedT &&
                        Lanes.Read<Vector3, Vector3Wide>(ref normal, lane) == expectedNormal;
                }
            }
            return equal;
        }).Check(ShapeGenerators.Reproducible(100));
}
