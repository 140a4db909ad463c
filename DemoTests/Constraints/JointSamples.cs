using System;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace DemoTests.Constraints;

/// <summary>One body of a test in the solver's own terms.</summary>
struct SampleBody
{
    public Vector3 Position;
    public Quaternion Orientation;
    public Vector3 Linear;
    public Vector3 Angular;
    public float InverseMass;
    public Symmetric3x3 InverseInertia;

    public readonly DoublePose Pose => new(new(Position), DoubleRotation.From(Orientation));
}

/// <summary>Random numbers for joint tests, the same in every run.</summary>
sealed class JointSamples(int seed)
{
    readonly Random random = new(seed);

    public float Uniform(float minimum, float maximum) => minimum + (maximum - minimum) * random.NextSingle();

    public Vector3 Vector(float size) => new(Uniform(-size, size), Uniform(-size, size), Uniform(-size, size));

    public Vector3 Direction()
    {
        while (true)
        {
            var v = Vector(1);
            if (v.Length() is > 0.1f and < 1)
                return Exact.Normalize(v);
        }
    }

    public Quaternion Rotation()
    {
        var axis = Direction();
        var half = Uniform(-MathF.PI, MathF.PI) / 2;
        return Exact.Normalize(new Quaternion(axis * MathF.Sin(half), MathF.Cos(half)));
    }

    /// <summary>A rotation by at most an angle.</summary>
    public Quaternion Rotation(float maximumAngle)
    {
        var half = Uniform(-maximumAngle, maximumAngle) / 2;
        return Exact.Normalize(new Quaternion(Direction() * MathF.Sin(half), MathF.Cos(half)));
    }

    /// <summary>A body at a random place, moving, with the inertia of some box of 0.2 to 2 m.</summary>
    public SampleBody Body()
    {
        var mass = Uniform(0.5f, 4);
        var size = new Vector3(Uniform(0.2f, 2), Uniform(0.2f, 2), Uniform(0.2f, 2));
        var squares = size * size;
        var orientation = Rotation();
        var local = new Vector3(
            12 / (mass * (squares.Y + squares.Z)), 12 / (mass * (squares.X + squares.Z)), 12 / (mass * (squares.X + squares.Y)));
        return new()
        {
            Position = Vector(2),
            Orientation = orientation,
            Linear = Vector(3),
            Angular = Vector(3),
            InverseMass = 1 / mass,
            InverseInertia = InWorld(local, orientation),
        };
    }

    /// <summary>An inverse inertia given by its principal values, in world axes.</summary>
    public static Symmetric3x3 InWorld(Vector3 local, Quaternion orientation)
    {
        var r = DoubleRotation.From(orientation);
        double Entry(Func<DoubleVector, double> row, Func<DoubleVector, double> column) =>
            local.X * row(r.X) * column(r.X) + local.Y * row(r.Y) * column(r.Y) + local.Z * row(r.Z) * column(r.Z);
        return new()
        {
            XX = (float)Entry(v => v.X, v => v.X),
            YX = (float)Entry(v => v.Y, v => v.X),
            YY = (float)Entry(v => v.Y, v => v.Y),
            ZX = (float)Entry(v => v.Z, v => v.X),
            ZY = (float)Entry(v => v.Z, v => v.Y),
            ZZ = (float)Entry(v => v.Z, v => v.Z),
        };
    }

    public SpringSettings Spring() => random.Next(3) == 0 ? default : new SpringSettings(Uniform(1, 60), Uniform(0.1f, 2));

    public bool Coin() => random.Next(2) == 0;
}
