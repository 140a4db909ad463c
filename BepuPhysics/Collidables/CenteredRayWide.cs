using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>
/// Rays as the shapes intersect them: lines in metres, measured from the point closest to the centre of the shape.
/// </summary>
/// <remarks>
/// A quadratic in coordinates of the ray's own origin loses the shape when the origin is far away: the squared distance swallows the
/// squared radius. Measured from the closest point all numbers are of the size of the shape, for any ray that can hit, and what is
/// left is the error that the direction itself carries: half a rounding per metre of distance. The closest point is refined once, as
/// in Haines and others, "Precision Improvements for Ray/Sphere Intersection" (Ray Tracing Gems, 2019).
/// Then each shape states the interval in which the line is inside, and <see cref="Resolve"/> says the rest.
/// Not finite and zero directions become NaN here and fail every comparison that follows, so they hit nothing.
/// </remarks>
struct CenteredRayWide
{
    /// <summary>
    /// Component of the unit direction across a face or an axis below which the line is parallel: it stays at its distance, to rounding, over any
    /// chord of any shape, and no distance is divided by less.
    /// </summary>
    public const float ParallelSpeed = 1e-15f;

    /// <summary>Point of the line closest to the centre of the shape, relative to that centre, m.</summary>
    public Vector3Wide Closest;
    /// <summary>Unit direction; NaN where the ray has none.</summary>
    public Vector3Wide Direction;
    /// <summary>Where the ray starts: signed distance from the closest point along the direction, m.</summary>
    public Vector<float> Start;

    // The length of the given direction, in two factors because their product may overflow.
    Vector<float> lengthScale;
    Vector<float> scaledLength;

    /// <summary>Measures rays from the centres of shapes, in world axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public CenteredRayWide(in RayWide ray, in Vector3Wide center)
    {
        // Brought to the largest component first: squares of lengths below 1e-19 or above 1e19 leave the range of a float.
        var magnitude = Vector3Wide.Abs(ray.Direction);
        lengthScale = Wide.Max(Wide.Max(magnitude.X, magnitude.Y), magnitude.Z);
        var scaled = new Vector3Wide(ray.Direction.X / lengthScale, ray.Direction.Y / lengthScale, ray.Direction.Z / lengthScale);
        scaledLength = scaled.Length();
        Direction = scaled / scaledLength;
        var offset = ray.Origin - center;
        var along = Vector3Wide.Dot(offset, Direction);
        var closest = offset - Direction * along;
        var correction = Vector3Wide.Dot(closest, Direction);
        Closest = closest - Direction * correction;
        Start = along + correction;
    }

    /// <summary>Turns the line into the frame whose axes are the rows of a matrix.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void ToLocal(in Matrix3x3Wide axes)
    {
        Closest = axes * Closest;
        Direction = axes * Direction;
    }

    /// <summary>Point of the line at a signed distance from the closest point.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector3Wide At(Vector<float> distance) => Closest + Direction * distance;

    /// <summary>Signed distance from the closest point, of a place in units of the given direction.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<float> Place(Vector<float> t) => Start + t * lengthScale * scaledLength;

    /// <summary>
    /// From the interval of the line that is inside the shape to the hit of the ray: where it enters, or at its start if that is inside.
    /// </summary>
    /// <param name="entry">Start of the interval; greater than its end where the line misses.</param>
    /// <param name="exit">End of the interval.</param>
    /// <param name="hitMask">Where the ray hits.</param>
    /// <param name="distance">Place of the hit, for <see cref="At"/>.</param>
    /// <param name="t">Place of the hit in units of the given direction; zero where nothing is hit.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void Resolve(
        Vector<float> entry, Vector<float> exit, out Vector<int> hitMask, out Vector<float> distance, out Vector<float> t)
    {
        distance = Wide.Max(entry, Start);
        t = (distance - Start) / scaledLength / lengthScale;
        hitMask = Vector.LessThanOrEqual(distance, exit) & Vector.LessThanOrEqual(t, new Vector<float>(float.MaxValue));
        t = Wide.Mask(hitMask, t);
    }

    /// <summary>Unit vector away from the core of a rounded shape; against the ray where the core itself is hit.</summary>
    /// <param name="fromCore">From the nearest point of the core (a point or a segment) to the hit.</param>
    /// <param name="radius">Radius around the core.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector3Wide NormalFromCore(in Vector3Wide fromCore, Vector<float> radius)
    {
        // Only a ray that starts inside comes near the core. Below 1e-7 radii the offset is rounding, not direction.
        var scaled = fromCore / radius;
        var hasDirection = Vector.GreaterThan(scaled.LengthSquared(), new Vector<float>(1e-14f));
        return Vector3Wide.Select(hasDirection, Vector3Wide.Normalize(scaled), -Direction);
    }
}
