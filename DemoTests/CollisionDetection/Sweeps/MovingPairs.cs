using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Demos.References;
using DemoTests.Support;

namespace DemoTests.CollisionDetection.Sweeps;

/// <summary>How shapes move.</summary>
enum SweepMotionKind
{
    /// <summary>Along a line.</summary>
    Straight,
    /// <summary>By up to a turn.</summary>
    Turning,
    /// <summary>By up to thirty turns.</summary>
    Spinning,
    /// <summary>Past each other, as near as can be by chance.</summary>
    Passing,
    /// <summary>Without going anywhere.</summary>
    OnTheSpot,
    /// <summary>Both by up to a turn.</summary>
    BothTurning,
}

/// <summary>What the library says of a pair.</summary>
readonly record struct PairSweep(bool IsHit, float T, Vector3 Place, Vector3 Normal);

/// <summary>Accepts all children.</summary>
struct AllowAll : ISweepFilter
{
    public readonly bool AllowTest(int childA, int childB) => true;
}

/// <summary>Random pairs of convex shapes that move for a second.</summary>
static class MovingPairs
{
    static readonly SweepTaskRegistry registry = new();

    public static MovingPair Create(ConvexPairShape a, ConvexPairShape b, SweepMotionKind kind, ConvexRandom random)
    {
        var reach = a.Shape.OuterRadius + a.Shape.Middle.Length + b.Shape.OuterRadius + b.Shape.Middle.Length;
        var direction = random.NextDirection();
        var distance = reach * (kind == SweepMotionKind.OnTheSpot ? random.Next(0.1, 0.9) : random.NextLogarithmic(0.3, 10));
        var offset = direction * distance;
        // At a point of the other shape, or beside it.
        var target = offset + random.NextDirection() * (reach * random.Next(0, kind == SweepMotionKind.Passing ? 1.2 : 0.6));
        var linear = kind == SweepMotionKind.OnTheSpot ? Double3.Zero : target * random.Next(0.5, 3);
        var spin = kind switch
        {
            SweepMotionKind.Straight or SweepMotionKind.Passing => 0,
            SweepMotionKind.Spinning => random.NextLogarithmic(6, 200),
            _ => random.NextLogarithmic(0.1, 6),
        };
        var angularB = kind == SweepMotionKind.BothTurning ? random.NextDirection() * random.Next(0, 6) : Double3.Zero;
        var linearB = kind == SweepMotionKind.BothTurning ? random.NextDirection() * random.Next(0, reach) : Double3.Zero;
        return new(a, b, ConvexGenerator.ToVector(offset), random.NextOrientation(), random.NextOrientation(),
            new(ConvexGenerator.ToVector(linear + linearB), ConvexGenerator.ToVector(random.NextDirection() * spin)),
            new(ConvexGenerator.ToVector(linearB), ConvexGenerator.ToVector(angularB)));
    }

    public static unsafe PairSweep Sweep(MovingPair pair, Shapes shapes, BufferPool pool, int maximumRounds = 16_384)
    {
        var task = registry.GetTask((int)pair.A.Shape.Kind, (int)pair.B.Shape.Kind)!;
        var filter = new AllowAll();
        fixed (byte* a = pair.A.Bytes, b = pair.B.Bytes)
        {
            var hit = task.Sweep(a, (int)pair.A.Shape.Kind, pair.OrientationA, pair.VelocityA, b, (int)pair.B.Shape.Kind, pair.OffsetB, pair.OrientationB,
                pair.VelocityB, 1, 0, 0, maximumRounds, ref filter, shapes, registry, pool, out _, out var t, out var place, out var normal);
            return new(hit, t, place, normal);
        }
    }
}
