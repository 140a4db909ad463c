using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Trees;
using Xunit;

namespace DemoTests.CollisionDetection.Children;

/// <summary>Boxes of a container that moves, in the frame of another: they hold all places of the step, and not much more.</summary>
public class NodePlacementTests
{
    const float Dt = 1 / 60f;

    static Vector3 Random(Random random, float size) =>
        new Vector3(random.NextSingle() - 0.5f, random.NextSingle() - 0.5f, random.NextSingle() - 0.5f) * 2 * size;

    static Quaternion RandomTurn(Random random) => Quaternion.Normalize(new Quaternion(Random(random, 1), random.NextSingle() - 0.5f));

    // The container is A, the mover B.
    static ParentPair Pair(
        Vector3 offset, Quaternion container, Quaternion mover, BodyVelocity containerVelocity, BodyVelocity moverVelocity, float limit) => new()
        {
            OffsetB = offset,
            OrientationA = container,
            OrientationB = mover,
            Motion = new(containerVelocity, moverVelocity, limit),
            SpeculativeMargin = 0,
        };

    static NodeChild Place(in ParentPair pair, in NodeChild node)
    {
        var parents = default(ParentMotionWide);
        parents.Write(pair, moverIsA: false, 0);
        var motions = new RelativeMotionWide(parents, Dt);
        return new NodePlacement(ref motions, 0, pair, moverIsA: false, Dt).Place(node);
    }

    readonly record struct Precise(double X, double Y, double Z)
    {
        public Precise(Vector3 v) : this(v.X, v.Y, v.Z) { }

        public double Length => Math.Sqrt(X * X + Y * Y + Z * Z);

        public static Precise operator +(Precise a, Precise b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z);

        public static Precise operator *(Precise a, double s) => new(a.X * s, a.Y * s, a.Z * s);

        public double Dot(Precise b) => X * b.X + Y * b.Y + Z * b.Z;

        public Precise Cross(Precise b) => new(Y * b.Z - Z * b.Y, Z * b.X - X * b.Z, X * b.Y - Y * b.X);

        // Rodrigues' formula.
        public Precise Turned(Precise rotation)
        {
            var angle = rotation.Length;
            if (angle < 1e-12)
                return this + rotation.Cross(this);
            var axis = rotation * (1 / angle);
            return this * Math.Cos(angle) + axis.Cross(this) * Math.Sin(angle) + axis * (axis.Dot(this) * (1 - Math.Cos(angle)));
        }

        public static Precise Rotation(Quaternion q)
        {
            var (x, y, z, w) = ((double)q.X, (double)q.Y, (double)q.Z, (double)q.W);
            var sine = Math.Sqrt(x * x + y * y + z * z);
            return sine < 1e-12 ? default : new Precise(x, y, z) * (2 * Math.Atan2(sine, w) / sine);
        }
    }

    // Where a point of the mover is in the frame of the container, a part of the step later.
    static Precise PlaceOf(in ParentPair pair, Precise point, double time)
    {
        var (a, b) = (pair.Motion.A, pair.Motion.B);
        var world = point.Turned(Precise.Rotation(pair.OrientationB)).Turned(new Precise(b.Angular) * time) + new Precise(pair.OffsetB) +
            (new Precise(b.Linear) + new Precise(a.Linear) * -1) * time;
        return world.Turned(new Precise(a.Angular) * -time).Turned(Precise.Rotation(pair.OrientationA) * -1);
    }

    [Theory]
    [InlineData(1, 1f, 1f)]
    [InlineData(2, 30f, 10f)]
    [InlineData(3, 300f, 1f)]
    [InlineData(4, 300f, 200f)]
    [InlineData(5, 3f, 2000f)]
    public void The_box_holds_all_places_within_the_step(int seed, float distance, float turning)
    {
        var random = new Random(seed);
        for (int i = 0; i < 2000; ++i)
        {
            var pair = Pair(
                Random(random, distance), RandomTurn(random), RandomTurn(random), new(Random(random, 20), Random(random, turning)),
                new(Random(random, 20), i % 2 == 0 ? default : Random(random, turning)), float.MaxValue);
            Vector3 center = Random(random, distance), half = new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle());
            var box = Place(pair, new NodeChild { Min = center - half, Max = center + half });
            var tolerance = 1e-6 * (distance + 1) * 4;
            for (int j = 0; j < 20; ++j)
            {
                var point = new Precise(center + Random(random, 1) * half);
                var place = PlaceOf(pair, point, random.NextDouble() * Dt);
                Assert.InRange(place.X, box.Min.X - tolerance, box.Max.X + tolerance);
                Assert.InRange(place.Y, box.Min.Y - tolerance, box.Max.Y + tolerance);
                Assert.InRange(place.Z, box.Min.Z - tolerance, box.Max.Z + tolerance);
            }
        }
    }

    // All of a level turns around a car that turns, by the way a far point of it goes; what is beside the car goes hardly anywhere.
    [Fact]
    public void What_turns_far_from_the_middle_of_a_level_meets_no_more_of_it_than_in_the_middle()
    {
        var car = new BodyVelocity(new Vector3(20, 0, 0), new Vector3(0, 1, 0));
        var (inTheMiddle, farOff) = (Size(Vector3.Zero), Size(new Vector3(300, 0, 300)));
        // The car goes a third of a metre, and a node of a metre at two metres turns around it by a thirtieth or so.
        Assert.InRange(inTheMiddle.X, 1, 1.5f);
        Assert.InRange(inTheMiddle.Z, 1, 1.2f);
        Assert.True((farOff - inTheMiddle).Length() < 0.01f, $"{farOff} m far off, {inTheMiddle} m in the middle");

        Vector3 Size(Vector3 place)
        {
            // A node of the level at two metres from a car.
            var pair = Pair(-place, Quaternion.Identity, Quaternion.Identity, car, default, float.MaxValue);
            var center = place + new Vector3(1.5f, -0.5f, 1);
            var box = Place(pair, new NodeChild { Min = center - new Vector3(0.5f), Max = center + new Vector3(0.5f) });
            return box.Max - box.Min;
        }
    }

    [Fact]
    public void Speeds_beyond_all_numbers_leave_the_limit()
    {
        var pair = Pair(
            new(3, 0, 0), Quaternion.Identity, Quaternion.Identity, new(new Vector3(3e38f), new Vector3(3e38f)),
            new(new Vector3(-3e38f), new Vector3(3e38f)), 2);
        var box = Place(pair, new NodeChild { Min = new(-1), Max = new(1) });
        // By the limit for the translation, and once more for what is turned.
        Assert.InRange(box.Min.X, 3 - 1 - 4.01f, 3 - 1 - 2);
        Assert.InRange(box.Max.X, 3 + 1 + 2, 3 + 1 + 4.01f);
    }
}
