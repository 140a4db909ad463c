using System.Numerics;
using Demos.References;

namespace DemoTests.Support;

/// <summary>How a pair lies.</summary>
public enum ConvexRegime
{
    /// <summary>Apart by less than the margin.</summary>
    Separated,

    /// <summary>A ten-thousandth of the smaller size apart or inside.</summary>
    Touching,

    /// <summary>Up to 1 to 4 hundredths of the smaller size inside; thin corners less.</summary>
    Shallow,

    /// <summary>Middles closer than 0.4 of the sum of the outer radii.</summary>
    Deep,

    /// <summary>Middles within a thousandth of the smaller size, or in one point.</summary>
    Concentric,

    /// <summary>Turned by multiples of an eighth of a turn against each other: parallel faces and edges, shallow to concentric.</summary>
    Aligned,
}

/// <summary>Where two shapes are.</summary>
public readonly record struct ConvexPose(Vector3 OffsetB, Quaternion OrientationA, Quaternion OrientationB)
{
    /// <summary>Offset of B in A's frame.</summary>
    public Double3 LocalOffsetB => ConvexRotation.From(OrientationA).RotateBack(OffsetB);
}

/// <summary>A pose with what the reference says of it.</summary>
public readonly record struct ConvexCase(ConvexReference Reference, ConvexPose Pose, Double3 LocalOffsetB, ConvexDepth Depth);

/// <summary>Random poses of two shapes by regime.</summary>
public static class ConvexPoses
{
    /// <summary>Seed of the poses that the code may be tuned with.</summary>
    public const ulong DevelopmentSeed = 20261121;

    /// <summary>Seed of the poses that are only for the final check: never debug with them.</summary>
    public const ulong VerificationSeed = 7_340_981_562;

    /// <summary>Speculative margin of all pairs, relative to the smaller size.</summary>
    public const double Margin = 0.15;

    /// <summary>
    /// Sizes of a pair: mostly alike and about a metre; a quarter of the pairs differs by up to 100, and in a quarter the smaller one is of
    /// any size from 1 mm to 1 km.
    /// </summary>
    public static (double SizeA, double SizeB) NextSizes(ConvexRandom random)
    {
        var scale = random.Next(4) == 0 ? random.NextLogarithmic(1e-3, 1e3) : 1;
        var ratio = random.Next(4) == 0 ? random.NextLogarithmic(0.01, 1) : random.NextLogarithmic(0.5, 1);
        return random.Next(2) == 0 ? (scale / ratio, scale) : (scale, scale / ratio);
    }

    /// <summary>Creates a pose; the reference tells its depth after everything is rounded to floats.</summary>
    public static ConvexCase Create(ConvexShape a, ConvexShape b, ConvexRegime regime, ConvexRandom random)
    {
        var orientationA = regime == ConvexRegime.Aligned && random.Next(2) == 0 ? Quaternion.Identity : random.NextOrientation();
        var orientationB = regime == ConvexRegime.Aligned ? Multiply(orientationA, random.NextAligned()) : random.NextOrientation();
        var reference = new ConvexReference(a, b, ConvexRotation.Between(orientationA, orientationB));
        var offset = regime switch
        {
            ConvexRegime.Aligned => NextAlignedOffset(reference, random),
            ConvexRegime.Deep => NextDeepOffset(reference, random.NextDirection(), random),
            ConvexRegime.Concentric => NextConcentricOffset(reference, random),
            _ => NextOffset(reference, NextDepth(regime, random) * reference.Size, random.NextDirection(), random),
        };
        var world = ConvexRotation.From(orientationA).Rotate(offset);
        var pose = new ConvexPose(ConvexGenerator.ToVector(world), orientationA, orientationB);
        var local = pose.LocalOffsetB;
        return new(reference, pose, local, reference.Find(local));
    }

    /// <summary>Measures a pose that is given.</summary>
    public static ConvexCase Measure(ConvexShape a, ConvexShape b, ConvexPose pose)
    {
        var reference = new ConvexReference(a, b, ConvexRotation.Between(pose.OrientationA, pose.OrientationB));
        var local = pose.LocalOffsetB;
        return new(reference, pose, local, reference.Find(local));
    }

    /// <summary>Relative to the smaller size.</summary>
    static double NextDepth(ConvexRegime regime, ConvexRandom random) => regime switch
    {
        ConvexRegime.Separated => -Margin * random.Next(0.02, 0.95),
        ConvexRegime.Touching => random.Next(-1e-4, 1e-4),
        _ => random.Next(0.01, 0.04),
    };

    static Double3 NextDeepOffset(ConvexReference reference, Double3 direction, ConvexRandom random) =>
        reference.ConcentricOffset + direction * (random.Next(0, 0.4) * (reference.A.OuterRadius + reference.B.OuterRadius));

    static Double3 NextConcentricOffset(ConvexReference reference, ConvexRandom random) => reference.ConcentricOffset
        + (random.Next(3) == 0 ? Double3.Zero : random.NextDirection() * (reference.Size * random.NextLogarithmic(1e-8, 1e-3)));

    static Double3 NextAlignedOffset(ConvexReference reference, ConvexRandom random)
    {
        // Along an axis, a diagonal of two or three of them, or anywhere; beside each other or inside.
        var direction = new Double3(random.Next(3) - 1, random.Next(3) - 1, random.Next(3) - 1);
        direction = random.Next(4) == 0 || direction.Length == 0 ? random.NextDirection() : direction * (1 / direction.Length);
        return random.Next(4) switch
        {
            0 => NextOffset(reference, NextDepth(ConvexRegime.Shallow, random) * reference.Size, direction, random),
            1 => NextOffset(reference, random.Next(2) * NextDepth(ConvexRegime.Touching, random) * reference.Size, direction, random),
            2 => NextDeepOffset(reference, direction, random),
            _ => NextConcentricOffset(reference, random),
        };
    }

    /// <summary>
    /// Moves B along the best normal until the depth is right: from outside corners meet, from inside mostly faces. When moved outwards the
    /// depth is met exactly; inwards, a corner may find a shorter way out, and the pair is shallower.
    /// </summary>
    static Double3 NextOffset(ConvexReference reference, double depth, Double3 direction, ConvexRandom random)
    {
        var offset = random.Next(2) == 0
            ? NextDeepOffset(reference, direction, random)
            : reference.ConcentricOffset + direction * ((reference.A.OuterRadius + reference.B.OuterRadius) * random.Next(1, 1.1));
        var found = reference.Find(offset, 0);
        return offset + found.Normal * (depth - found.Depth);
    }

    static Quaternion Multiply(Quaternion a, Quaternion b)
    {
        var q = DoubleQuaternion.Normalize((DoubleQuaternion)a * b);
        return new((float)q.X, (float)q.Y, (float)q.Z, (float)q.W);
    }
}
