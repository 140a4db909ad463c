using System;
using System.Numerics;
using BepuPhysics.Collidables;

namespace DemoTests.CollisionDetection;

/// <summary>Ways in which a capsule can lie to a triangle.</summary>
enum CapsuleAttitude
{
    Any,
    Flat,
    NearlyFlat,
    AlongAnEdge,
    NearlyAlongAnEdge,
    Standing,
    NearlyStanding,
}

/// <summary>Poses of round shapes at each feature of triangles.</summary>
static class TrianglePairCases
{
    public static Sphere CreateSphere(ref PairRandom random) => new(random.NextLogarithmic(0.01, 1));

    public static Capsule CreateCapsule(ref PairRandom random) =>
        new(random.NextLogarithmic(0.01, 1), random.Next(8) == 0 ? 0 : random.NextLogarithmic(0.01, 2));

    /// <summary>Triangles up to a hundred times as long as thick, half of them away from their origin, half of them two-sided.</summary>
    public static Triangle CreateTriangle(ref PairRandom random)
    {
        var length = random.NextLogarithmic(0.02, 2);
        var height = length * random.NextLogarithmic(0.01, 1);
        var apex = random.Next(-0.3, 1.3) * length;
        var turn = random.NextOrientation();
        Vector3 a = Vector3.Transform(new(0, 0, 0), turn), b = Vector3.Transform(new(length, 0, 0), turn);
        var c = Vector3.Transform(new(apex, height, 0), turn);
        var shift = (a + b + c) / -3;
        if (random.Next(2) == 0)
            shift += random.NextDirection() * (length * random.Next(0, 3));
        return new(a + shift, b + shift, c + shift) { TwoSided = random.Next(2) == 0 };
    }

    public static PairCase<Sphere, Triangle>[] CreateSpheres(int count, ulong seed)
    {
        var random = new PairRandom(seed);
        var cases = new PairCase<Sphere, Triangle>[count];
        for (int i = 0; i < count; ++i)
        {
            var sphere = CreateSphere(ref random);
            var triangle = CreateTriangle(ref random);
            var (offset, orientationA, orientationB) = Place(ref random, (PairKind)(i % 5), default, sphere.Radius, 0, triangle);
            cases[i] = new(sphere, triangle, offset, orientationA, orientationB);
        }
        return cases;
    }

    public static PairCase<Capsule, Triangle>[] CreateCapsules(int count, ulong seed)
    {
        var random = new PairRandom(seed);
        var cases = new PairCase<Capsule, Triangle>[count];
        for (int i = 0; i < count; ++i)
        {
            var capsule = CreateCapsule(ref random);
            var triangle = CreateTriangle(ref random);
            var attitude = (CapsuleAttitude)(i / 5 % 7);
            var (offset, orientationA, orientationB) =
                Place(ref random, (PairKind)(i % 5), attitude, capsule.Radius, capsule.HalfLength, triangle);
            cases[i] = new(capsule, triangle, offset, orientationA, orientationB);
        }
        return cases;
    }

    static (Vector3 Offset, Quaternion A, Quaternion B) Place(
        ref PairRandom random, PairKind kind, CapsuleAttitude attitude, float radius, float halfLength, in Triangle triangle)
    {
        var orientationB = random.NextOrientation();
        var a = Vector3.Transform(triangle.A, orientationB);
        var b = Vector3.Transform(triangle.B, orientationB);
        var c = Vector3.Transform(triangle.C, orientationB);
        var front = Vector3.Normalize(Vector3.Cross(c - a, b - a));
        var edge = Vector3.Normalize(b - a);
        var angle = random.NextLogarithmic(1e-7, 1e-1);
        var axis = attitude switch
        {
            CapsuleAttitude.Flat => Across(front, random.NextDirection()),
            CapsuleAttitude.NearlyFlat => Vector3.Normalize(Across(front, random.NextDirection()) + front * angle),
            CapsuleAttitude.AlongAnEdge => edge,
            CapsuleAttitude.NearlyAlongAnEdge => Vector3.Normalize(edge + random.NextDirection() * angle),
            CapsuleAttitude.Standing => front,
            CapsuleAttitude.NearlyStanding => Vector3.Normalize(front + random.NextDirection() * angle),
            _ => random.NextDirection(),
        };
        // Any rotation that takes Y to the axis.
        var orientationA = axis.Y < -0.999f
            ? new Quaternion(1, 0, 0, 0)
            : Quaternion.Normalize(new(axis.Z, 0, -axis.X, 1 + axis.Y));
        axis = Vector3.Transform(Vector3.UnitY, orientationA);

        // A point of the triangle meets one of the segment, in a direction in which they could.
        float p = random.Next(0, 1), q = random.Next(0, 1);
        if (p + q > 1)
            (p, q) = (1 - p, 1 - q);
        var feature = random.Next(5);
        if (feature >= 3)
            q = 0;
        if (feature == 4)
            p = 0;
        var normal = feature switch
        {
            0 or 1 => front,
            2 => -front,
            3 when halfLength > 0 && random.Next(2) == 0 => Across(axis, Across(edge, random.NextDirection())),
            _ => random.NextDirection(),
        };
        var place = random.Next(3) switch
        {
            0 => Vector3.Dot(axis, normal) > 0 ? -halfLength : halfLength,
            1 => random.Next(2) == 0 ? -halfLength : halfLength,
            _ => random.Next(-halfLength, halfLength),
        };
        var size = Math.Min(radius + halfLength, Vector3.Distance(a, b));
        var gap = kind switch
        {
            PairKind.Apart => size * random.Next(0, 0.3),
            PairKind.Touching => size * random.Next(-1e-5, 1e-5),
            PairKind.Shallow => -size * random.Next(0, 0.05),
            PairKind.Deep => -radius - (radius + halfLength) * random.Next(-1, 1),
            _ => random.Next(3) == 0 ? -radius : -radius + size * random.NextLogarithmic(1e-8, 1e-3),
        };
        if (kind == PairKind.Concentric)
            (p, q, place) = (1 / 3f, 1 / 3f, 0);
        var point = a + (b - a) * p + (c - a) * q;
        return (axis * place - normal * (radius + gap) - point, orientationA, orientationB);
    }

    static Vector3 Across(Vector3 axis, Vector3 v) => Vector3.Normalize(v - axis * Vector3.Dot(axis, v) + Vector3.Cross(axis, v) * 1e-3f);
}
