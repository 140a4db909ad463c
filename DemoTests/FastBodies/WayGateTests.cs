using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.FastBodies;

/// <summary>What a gate refuses is never met by a sweep; and it refuses most of what is not met.</summary>
public unsafe class WayGateTests
{
    const int Count = 4000;
    const double Touching = .001;

    struct All : ISweepFilter
    {
        public readonly bool AllowTest(int childA, int childB) => true;
    }

    public enum Other
    {
        MovingBall,
        MovingBox,
        StaticBox,
        HalfSpace,
    }

    [Theory]
    [InlineData(Other.MovingBall, .9)]
    [InlineData(Other.MovingBox, .6)]
    [InlineData(Other.StaticBox, .5)]
    [InlineData(Other.HalfSpace, .9)]
    public void NothingThatIsMetIsRefused(Other other, double leastPart)
    {
        var random = new Random(4);
        var (misses, refused, hits) = (0, 0, 0);
        for (int i = 0; i < Count; ++i)
        {
            // Every other way leads close past what it might meet: by the width of rounding, of what counts as touching, and more.
            var (met, mayMeet) = Try(other, random, i % 2 == 0 ? Math.Pow(10, -8 + 8 * random.NextDouble()) : double.NaN);
            Assert.False(met && !mayMeet, $"case {i} meets");
            hits += met ? 1 : 0;
            misses += met ? 0 : 1;
            refused += mayMeet ? 0 : 1;
        }
        Assert.True(hits > Count / 100, $"{hits} hits");
        Assert.True(refused > leastPart * misses, $"{refused} of {misses} are refused");
    }

    static (bool Met, bool MayMeet) Try(Other other, Random random, double nearly)
    {
        const float dt = .004f;
        var ball = new Sphere(.05f + random.NextSingle() * .1f);
        var box = new Box(.1f + random.NextSingle(), .1f + random.NextSingle(), .1f + random.NextSingle());
        var half = new HalfSpace(Vector3.Transform(Vector3.UnitY, TestWorld.Turn(random)));
        var otherBall = new Sphere(.05f + random.NextSingle() * .1f);
        var isStatic = other is Other.StaticBox or Other.HalfSpace;
        var (typeB, shapeB, radiusB) = other switch
        {
            Other.HalfSpace => (HalfSpace.Id, (nint)(&half), 1e9),
            Other.MovingBall => (Sphere.Id, (nint)(&otherBall), otherBall.Radius),
            _ => (Box.Id, (nint)(&box), new Vector3(box.HalfWidth, box.HalfHeight, box.HalfLength).Length()),
        };
        var positionA = TestWorld.Scatter(random, 3);
        var positionB = TestWorld.Scatter(random, other == Other.HalfSpace ? .2f : 1);
        var orientation = TestWorld.Turn(random);
        Vector3 linearA = TestWorld.Scatter(random, 300), linearB = isStatic ? default : TestWorld.Scatter(random, 300);
        if (!double.IsNaN(nearly) && other != Other.HalfSpace)
        {
            // Past a ball of the radii of both, nearest in the middle of the way.
            var relative = Vector3.Normalize(linearA - linearB);
            var aside = Vector3.Normalize(Vector3.Cross(relative, TestWorld.Scatter(random, 1)));
            positionA = positionB + aside * (float)((ball.Radius + radiusB) * (1 + nearly)) - (linearA - linearB) * (dt / 2);
        }
        var motion = new SweepMotion
        {
            OrientationA = DoubleMatrix3x3.FromQuaternion(Quaternion.Identity),
            OrientationB = DoubleMatrix3x3.FromQuaternion(orientation),
            LinearA = new(linearA),
            LinearB = new(linearB),
            AngularB = isStatic ? default : new(TestWorld.Scatter(random, 50)),
            OffsetB = new DoubleVector3(positionB) - new DoubleVector3(positionA),
            MaximumT = dt,
            Accuracy = ImpactAccuracy.Default with { TouchingDistance = Touching },
        };
        var gate = default(WayGate);
        gate.Set(ball.Radius, radiusB, Touching);
        if (other == Other.HalfSpace)
        {
            gate.SetPlane(half, orientation);
        }
        else if (isStatic)
        {
            box.ComputeBounds(orientation, out var min, out var max);
            gate.SetStatic(new(positionB + min), new(positionB + max));
        }
        var filter = new All();
        var pool = new BufferPool();
        SweepPairs.Test(motion, Sphere.Id, &ball, typeB, (void*)shapeB, ref filter, null!, pool, out var hit);
        if (hit.Exists)
            Assert.InRange(gate.ApartUntil(new(positionA), new(positionB), motion.LinearA, motion.LinearB, dt, 0), 0, hit.T);
        return (hit.Exists, gate.MayMeet(new(positionA), new(positionB), motion.LinearA, motion.LinearB, dt));
    }
}
