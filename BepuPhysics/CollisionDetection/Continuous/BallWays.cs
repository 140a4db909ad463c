using System;
using System.Numerics;
using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>A pair of two balls, or of a ball and a half-space that does not move: their impacts need no rounds.</summary>
unsafe struct BallWays
{
    // Radii; B has none if it is a half-space, and its normal then, in world axes.
    double radiusA, radiusB;
    DoubleVector3 normal;
    bool isPlane;

    /// <summary>Whether the pair is one of these.</summary>
    public bool Exists;

    /// <summary>Says what the pair consists of.</summary>
    /// <param name="a">Type of A.</param>
    /// <param name="shapeA">Shape of A.</param>
    /// <param name="b">Type of B.</param>
    /// <param name="shapeB">Shape of B.</param>
    /// <param name="still">Orientation of a B that does not move.</param>
    /// <param name="moves">Whether B moves.</param>
    /// <returns>Whether it is one of these.</returns>
    public bool TrySet(int a, void* shapeA, int b, void* shapeB, in Quaternion still, bool moves)
    {
        isPlane = b == HalfSpace.Id && !moves;
        Exists = a == Sphere.Id && (isPlane || b == Sphere.Id);
        if (!Exists)
            return false;
        radiusA = ((Sphere*)shapeA)->Radius;
        if (isPlane)
        {
            normal = DoubleMatrix3x3.FromQuaternion(still).Turn(new(((HalfSpace*)shapeB)->Normal));
            normal *= 1 / normal.Length;
            radiusB = 0;
        }
        else
        {
            radiusB = ((Sphere*)shapeB)->Radius;
        }
        return true;
    }

    /// <summary>Time up to which they stay apart by a distance to spare, s: zero if they begin nearer, infinite if they never come so near.</summary>
    /// <param name="offsetB">Position of B less that of A at the time zero, m.</param>
    /// <param name="linearA">Velocity of A, m/s.</param>
    /// <param name="linearB">Velocity of B, m/s.</param>
    /// <param name="spare">The distance, m.</param>
    public readonly double ApartUntil(in DoubleVector3 offsetB, in DoubleVector3 linearA, in DoubleVector3 linearB, double spare) =>
        TryFind(radiusA + radiusB + spare, offsetB, linearA - linearB, 0, out var time) ? time : 0;

    /// <summary>Whether they are farther apart than a margin, beyond the rounding of any test; nothing is known of what is no pair of balls.</summary>
    /// <param name="offsetB">Position of B less that of A, m.</param>
    /// <param name="margin">The margin, m.</param>
    public readonly bool AreFartherApartThan(in DoubleVector3 offsetB, float margin)
    {
        if (!Exists)
            return false;
        var length = offsetB.Length;
        return (isPlane ? -DoubleVector3.Dot(normal, offsetB) : length) - length * RoundingPart > (radiusA + radiusB + margin) * (1 + RoundingPart);
    }

    // Far more than floats leave of a distance.
    const double RoundingPart = 1e-4;

    /// <summary>Whether two balls may touch in a time: by how far apart they are, and by how fast.</summary>
    /// <param name="offsetB">Position of B less that of A at the time zero, m.</param>
    /// <param name="linear">Velocity of A less that of B, m/s.</param>
    /// <param name="dt">The time, s.</param>
    /// <param name="touching">Distance that counts as touching, m.</param>
    // At the nearest point of their ways, or at the end of the time, whichever comes first; with more to spare than rounding takes.
    public readonly bool MayMeet(in DoubleVector3 offsetB, in DoubleVector3 linear, double dt, double touching)
    {
        var reach = (radiusA + radiusB) * (1 + RoundingPart) + 2 * touching;
        double along = DoubleVector3.Dot(offsetB, linear), speed = DoubleVector3.Dot(linear, linear);
        var distance = DoubleVector3.Dot(offsetB, offsetB);
        if (along > 0)
            distance -= along >= speed * dt ? (2 * along - speed * dt) * dt : along * along / speed;
        return distance <= reach * reach + RoundingPart * RoundingPart * DoubleVector3.Dot(offsetB, offsetB);
    }

    /// <summary>Finds when they touch.</summary>
    /// <param name="part">Part by which the cores are thinner.</param>
    /// <param name="offsetB">Position of B less that of A at the time zero, m.</param>
    /// <param name="linearA">Velocity of A, m/s.</param>
    /// <param name="linearB">Velocity of B, m/s.</param>
    /// <param name="touching">Distance that counts as touching, m.</param>
    /// <param name="time">When, s; infinite if never.</param>
    /// <returns>Whether the cores are apart at the beginning.</returns>
    public readonly bool TryFind(
        double part, in DoubleVector3 offsetB, in DoubleVector3 linearA, in DoubleVector3 linearB, double touching, out double time) =>
        TryFind(Thin(radiusA, part) + Thin(radiusB, part), offsetB, linearA - linearB, touching, out time);

    readonly bool TryFind(double radii, in DoubleVector3 offsetB, in DoubleVector3 linear, double touching, out double time) => isPlane
        ? BallImpact.TryLand(-DoubleVector3.Dot(normal, offsetB), -DoubleVector3.Dot(normal, linear), radii, touching, out time)
        : BallImpact.TryMeet(offsetB, linear, radii, touching, out time);

    // As thick things lose no more than small ones do. A half-space has nothing to lose.
    readonly double Thin(double radius, double part) => radius - part * (isPlane ? radius : Math.Min(radiusA, radiusB));

    /// <summary>Where they touch.</summary>
    /// <param name="part">Part by which the cores are thinner.</param>
    /// <param name="between">Position of B less that of A at the time, m.</param>
    /// <param name="normal">Unit normal from B to A.</param>
    /// <param name="armA">Place from the centre of A, m.</param>
    /// <param name="armB">Place from the position of B, m.</param>
    public readonly void Touch(
        double part, in DoubleVector3 between, out DoubleVector3 normal, out DoubleVector3 armA, out DoubleVector3 armB)
    {
        if (isPlane)
        {
            normal = this.normal;
            armA = normal * DoubleVector3.Dot(normal, between);
            armB = armA - between;
            return;
        }
        normal = between * (-1 / between.Length);
        armB = normal * Thin(radiusB, part);
        armA = between + armB;
    }
}
