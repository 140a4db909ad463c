using System;
using System.Numerics;

namespace DemoTests.Constraints;

/// <summary>A vector in double precision.</summary>
readonly record struct DoubleVector(double X, double Y, double Z)
{
    public DoubleVector(Vector3 v) : this(v.X, v.Y, v.Z) { }

    /// <summary>Three numbers of a longer list.</summary>
    public static DoubleVector At(double[] values, int start) => new(values[start], values[start + 1], values[start + 2]);

    public static DoubleVector operator +(DoubleVector a, DoubleVector b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z);
    public static DoubleVector operator -(DoubleVector a, DoubleVector b) => new(a.X - b.X, a.Y - b.Y, a.Z - b.Z);
    public static DoubleVector operator *(DoubleVector a, double s) => new(a.X * s, a.Y * s, a.Z * s);
    public static double Dot(DoubleVector a, DoubleVector b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z;
    public static DoubleVector Cross(DoubleVector a, DoubleVector b) => new(a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);
    /// <summary>Angle between two vectors of any length.</summary>
    public static double Angle(DoubleVector a, DoubleVector b) => Math.Atan2(Cross(a, b).Length, Dot(a, b));
    public double Length => Math.Sqrt(Dot(this, this));
    public double[] ToArray() => [X, Y, Z];
}

/// <summary>A rotation in double precision, by its matrix: a column is where an axis goes.</summary>
readonly record struct DoubleRotation(DoubleVector X, DoubleVector Y, DoubleVector Z)
{
    public static DoubleRotation From(Quaternion q)
    {
        double x = q.X, y = q.Y, z = q.Z, w = q.W;
        var n = 2 / (x * x + y * y + z * z + w * w);
        return new(
            new(1 - n * (y * y + z * z), n * (x * y + w * z), n * (x * z - w * y)),
            new(n * (x * y - w * z), 1 - n * (x * x + z * z), n * (y * z + w * x)),
            new(n * (x * z + w * y), n * (y * z - w * x), 1 - n * (x * x + y * y)));
    }

    /// <summary>Rotation by a vector: axis times angle.</summary>
    public static DoubleRotation From(DoubleVector rotation)
    {
        var angle = rotation.Length;
        if (angle == 0)
            return new(new(1, 0, 0), new(0, 1, 0), new(0, 0, 1));
        var u = rotation * (1 / angle);
        DoubleVector Turn(DoubleVector v) =>
            v * Math.Cos(angle) + DoubleVector.Cross(u, v) * Math.Sin(angle) + u * (DoubleVector.Dot(u, v) * (1 - Math.Cos(angle)));
        return new(Turn(new(1, 0, 0)), Turn(new(0, 1, 0)), Turn(new(0, 0, 1)));
    }

    public static DoubleVector operator *(DoubleRotation r, DoubleVector v) => r.X * v.X + r.Y * v.Y + r.Z * v.Z;

    /// <summary>First b, then a.</summary>
    public static DoubleRotation operator *(DoubleRotation a, DoubleRotation b) => new(a * b.X, a * b.Y, a * b.Z);

    public DoubleRotation Inverse => new(new(X.X, Y.X, Z.X), new(X.Y, Y.Y, Z.Y), new(X.Z, Y.Z, Z.Z));

    /// <summary>Axis times angle, for angles that are not near half a turn.</summary>
    public DoubleVector Vector
    {
        get
        {
            var twiceSine = new DoubleVector(Y.Z - Z.Y, Z.X - X.Z, X.Y - Y.X);
            var angle = Math.Atan2(twiceSine.Length, X.X + Y.Y + Z.Z - 1);
            return twiceSine.Length == 0 ? twiceSine : twiceSine * (angle / twiceSine.Length);
        }
    }
}

/// <summary>Pose of a body in double precision.</summary>
readonly record struct DoublePose(DoubleVector Position, DoubleRotation Orientation)
{
    public DoubleVector ToWorld(Vector3 local) => Orientation * new DoubleVector(local);

    /// <summary>How far a point of the second body is from one of the first, along an axis of the first.</summary>
    public static double Along(DoublePose[] poses, Vector3 localOffsetA, Vector3 localOffsetB, Vector3 localAxisA) => DoubleVector.Dot(
        poses[0].ToWorld(localAxisA), poses[1].Position + poses[1].ToWorld(localOffsetB) - poses[0].Position - poses[0].ToWorld(localOffsetA));

    /// <summary>The velocity that A has where a point of B is, less that of the point; six numbers per body.</summary>
    public static DoubleVector OfAAtPointOfB(DoublePose[] poses, Vector3 localOffsetB, double[] v)
    {
        var arm = poses[1].ToWorld(localOffsetB);
        var fromA = poses[1].Position + arm - poses[0].Position;
        return DoubleVector.At(v, 0) + DoubleVector.Cross(DoubleVector.At(v, 3), fromA) -
            (DoubleVector.At(v, 6) + DoubleVector.Cross(DoubleVector.At(v, 9), arm));
    }

    /// <summary>The pose after a small motion: three coordinates of translation, three of rotation.</summary>
    public DoublePose Moved(int coordinate, double by)
    {
        Span<double> motion = stackalloc double[6];
        motion[coordinate] = by;
        return new(Position + new DoubleVector(motion[0], motion[1], motion[2]),
            DoubleRotation.From(new DoubleVector(motion[3], motion[4], motion[5])) * Orientation);
    }
}
