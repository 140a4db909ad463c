using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>
/// A capsule's segment against a cylinder, in a frame in which few numbers are left: Y along the cylinder's axis, Z along the part of the
/// segment's direction that is across it, X across both. By mirroring, the segment's line passes the axis at positive X, rises, and is
/// above the cylinder's centre where it passes it, seen along itself.
/// </summary>
struct CapsuleCylinderFrame
{
    // A step cubes the error. Where the segment touches the rim along itself it only halves the distance from the root, but the depth depends
    // on the fourth power of that.
    const int StepCount = 4;

    /// <summary>Axes of the frame in the world.</summary>
    public Vector3Wide AxisX, AxisY, AxisZ;
    /// <summary>Position of the capsule; X is the distance of the segment's line from the axis.</summary>
    public Vector3Wide Center;
    /// <summary>Direction of the segment along Y and Z, neither of them negative.</summary>
    public Vector<float> Rise, Run;
    /// <summary>All bits set where the capsule's own direction is the other.</summary>
    public Vector<int> Reversed;
    /// <summary>Position of the capsule across the segment, in the plane of Y and Z; not negative.</summary>
    public Vector<float> Above;
    /// <summary>Place on the segment's line that is nearest to the axis.</summary>
    public Vector<float> Passing;
    /// <summary>All bits set where that place means something: the segment is not parallel to the axis.</summary>
    public Vector<int> HasPassing;
    /// <summary>Distance along Z, from the passing place down the segment, to where its line is nearest to the upper rim.</summary>
    public Vector<float> ToRim;
    /// <summary>That place on the segment's line.</summary>
    public Vector<float> RimPlace;

    /// <summary>Brings a pair into its frame.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Create(in CylinderWide cylinder, in Vector3Wide axisY, in Vector3Wide u, in Vector3Wide offsetB,
        in Vector3Wide worldX, in Vector3Wide worldZ, out CapsuleCylinderFrame frame)
    {
        var zero = Vector<float>.Zero;
        var one = Vector<float>.One;
        var x = -Vector3Wide.Dot(worldX, offsetB);
        var y = -Vector3Wide.Dot(axisY, offsetB);
        var z = -Vector3Wide.Dot(worldZ, offsetB);
        var directionX = Vector3Wide.Dot(worldX, u);
        var rise = Vector3Wide.Dot(axisY, u);
        var directionZ = Vector3Wide.Dot(worldZ, u);

        var runSquared = directionX * directionX + directionZ * directionZ;
        frame.HasPassing = Vector.GreaterThan(runSquared, new Vector<float>(PairTolerances.ParallelToAxis));
        var run = Wide.Mask(frame.HasPassing, Vector.SquareRoot(runSquared));
        var inverseRun = Wide.Mask(frame.HasPassing, one / run);
        // Where the segment is parallel to the axis, any directions across do.
        directionX = Wide.Select(frame.HasPassing, directionX * inverseRun, one);
        directionZ *= inverseRun;
        var across = x * directionZ - z * directionX;
        var along = x * directionX + z * directionZ;
        // The line of a parallel segment passes the axis nowhere, and has no place across it to be nearest to the rim.
        var above = Wide.Mask(frame.HasPassing, run * y - rise * along);
        var upsideDown = Vector.LessThan(Wide.Select(frame.HasPassing, above, y), zero);
        frame.AxisY = Vector3Wide.Select(upsideDown, -axisY, axisY);
        y = Wide.Select(upsideDown, -y, y);
        rise = Wide.Select(upsideDown, -rise, rise);
        frame.Above = Vector.Abs(above);
        frame.Reversed = Vector.LessThan(rise, zero);
        frame.Rise = Vector.Abs(rise);
        frame.Run = run;
        directionX = Wide.Select(frame.Reversed, -directionX, directionX);
        directionZ = Wide.Select(frame.Reversed, -directionZ, directionZ);
        along = Wide.Select(frame.Reversed, -along, along);
        frame.AxisZ = worldX * directionX + worldZ * directionZ;
        // Turning Z around turns X around as well: the sign of the distance is that of both.
        var sideSign = Wide.CopySign(one, across);
        sideSign = Wide.Select(frame.Reversed, -sideSign, sideSign);
        frame.AxisX = (worldX * directionZ - worldZ * directionX) * sideSign;
        frame.Center = new(Vector.Abs(across), y, along);

        frame.Passing = -along * inverseRun;
        frame.ToRim = FindRim(frame.Rise * (frame.Above - run * cylinder.HalfLength), cylinder.Radius * runSquared, frame.Center.X * frame.Center.X);
        frame.RimPlace = frame.Passing - frame.ToRim * inverseRun;
    }

    /// <summary>Finds where the segment's line has its least distance from the upper rim, below the place where it passes the axis.</summary>
    // With the distance z along Z from the passing place and the distance w of the line from the axis, the derivative of half the squared
    // distance is, scaled, z - offset - scale * z / sqrt(w^2 + z^2). It is convex, with the least distance at its greatest root, and not
    // negative at offset + scale. From there, steps of third order come down.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> FindRim(Vector<float> offset, Vector<float> scale, Vector<float> squaredDistance)
    {
        var zero = Vector<float>.Zero;
        var one = Vector<float>.One;
        var scaledSquare = scale * squaredDistance;
        var three = new Vector<float>(3f);
        var two = new Vector<float>(2f);
        var least = new Vector<float>(1e-3f);
        // In place of zero: on the axis itself there is no direction.
        var smallest = new Vector<float>(1e-30f);
        var z = Wide.Max(offset + scale, zero);
        for (int i = 0; i < StepCount; ++i)
        {
            var inverseSquared = one / (squaredDistance + z * z + smallest);
            var inverse = Vector.SquareRoot(inverseSquared);
            var value = z - offset - scale * z * inverse;
            var curved = scaledSquare * inverseSquared * inverse;
            var slope = one - curved;
            var bend = three * curved * z * inverseSquared;
            var divisor = two * slope * slope - value * bend;
            // Without a root, or beyond it, there is nothing to be gained, and any place is as good.
            var step = two * value * slope / Wide.Max(divisor, least);
            z = Wide.Max(z - step, zero);
        }
        return z;
    }

    /// <summary>Finds the place on the segment that is nearest to the cylinder; anywhere on the segment's part that is inside of it.</summary>
    // Half the squared distance is convex along the segment. Its part above and below the ends is least between the crossings with their
    // planes, its part beyond the side where the segment passes the axis. The least of both lies between these places, beyond both an end
    // and the side: nearest to the rim, whose squared distance is convex there as well.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<float> FindNearest(Vector<float> halfLength, in CylinderWide cylinder)
    {
        var zero = Vector<float>.Zero;
        var one = Vector<float>.One;
        var inverseRise = one / Wide.Max(Rise, new Vector<float>(PairTolerances.LeastSpeed));
        var low = Wide.Max(-halfLength, (-cylinder.HalfLength - Center.Y) * inverseRise);
        var high = Wide.Min(halfLength, (cylinder.HalfLength - Center.Y) * inverseRise);
        var start = Wide.Clamp(Wide.Min(Wide.Max(Passing, low), high), -halfLength, halfLength);
        var end = Wide.Clamp(Passing, -halfLength, halfLength);
        var s = Wide.Clamp(RimPlace, start, end);
        // The rim's place was found along Z, which is little of a steep segment: once more along the segment.
        var z = Center.Z + Run * s;
        var fromAxis = Vector.SquareRoot(Center.X * Center.X + z * z);
        var inverse = Wide.Mask(Vector.GreaterThan(fromAxis, zero), one / fromAxis);
        var radius = cylinder.Radius * inverse;
        var slope = Run * z * (one - radius) + Rise * (Center.Y + Rise * s - cylinder.HalfLength);
        var across = Run * Center.X * inverse;
        var curvature = Wide.Max(one - radius * across * across, new Vector<float>(0.05f));
        s = Wide.Clamp(s - slope / curvature, start, end);
        // From over an end there is nothing to be gained towards the axis.
        z = Center.Z + Run * start;
        var isOver = Vector.LessThanOrEqual(Center.X * Center.X + z * z, cylinder.Radius * cylinder.Radius);
        return Wide.Select(isOver, start, s);
    }
}
