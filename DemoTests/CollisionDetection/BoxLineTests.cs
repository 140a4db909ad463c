using System;
using System.Numerics;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>The nearest place on a line to a box, against a search in double precision.</summary>
public sealed class BoxLineTests
{
    const int CaseCount = 40_000;
    const float Reach = 1.5f;

    [Fact]
    public void NoPlaceIsNearer()
    {
        var random = new PairRandom(7);
        for (int i = 0; i < CaseCount; ++i)
        {
            var start = NextVector(ref random) * Reach;
            // Along faces and edges, nearly along them, and any way.
            var direction = NextVector(ref random) * NextMask(ref random);
            var extents = Vector3.Abs(NextVector(ref random));
            float first = random.Next(-1f, 0), last = random.Next(0, 1f);
            var place = Find(start, direction, extents, first, last);
            Assert.InRange(place, first - 1e-6f, last + 1e-6f);

            double low = first, high = last;
            for (int step = 0; step < 80; ++step)
            {
                double a = low + (high - low) / 3, b = high - (high - low) / 3;
                if (GetDistance(start, direction, extents, a) < GetDistance(start, direction, extents, b))
                    high = b;
                else
                    low = a;
            }
            var least = GetDistance(start, direction, extents, 0.5 * (low + high));
            var found = GetDistance(start, direction, extents, place);
            Assert.True(found < least + 1e-6, $"{found} for {least}: {start}, {direction}, {extents}, {first} to {last}: {place}");
        }
    }

    [Fact]
    public void AnEndThatIsNearestIsReturnedToTheBit()
    {
        var random = new PairRandom(8);
        for (int i = 0; i < CaseCount; ++i)
        {
            var direction = Vector3.Abs(NextVector(ref random)) + new Vector3(0.01f);
            float first = random.Next(-1f, 0), last = random.Next(0, 1f);
            // Towards the box, which the line does not reach, and away from it.
            Assert.Equal(last, Find(new(-10), direction, new(1), first, last));
            Assert.Equal(first, Find(new(10), direction, new(1), first, last));
        }
    }

    [Fact]
    public void OfEquallyNearPlacesTheMiddleIsReturned()
    {
        // Along a face, over the whole of it; then inside, and through.
        Assert.Equal(0, Find(new(0, 2, 0), Vector3.UnitX, new(1), -5, 5));
        Assert.Equal(1.75f, Find(new(-2, 2, 0.5f), Vector3.UnitX, new(1), 0, 2.5f), 1e-6f);
        Assert.Equal(0.25f, Find(default, Vector3.UnitZ, new(1), -0.25f, 0.75f), 1e-6f);
        Assert.Equal(0.5f, Find(new(0, -0.5f, 0), Vector3.UnitY, new(1), -5, 5), 1e-6f);
    }

    static Vector3 NextVector(ref PairRandom random) => new(random.Next(-1f, 1), random.Next(-1f, 1), random.Next(-1f, 1));

    static Vector3 NextMask(ref PairRandom random) => new(NextScale(ref random), NextScale(ref random), 1);

    static float NextScale(ref PairRandom random) => random.Next(4) switch
    {
        0 => 0,
        1 => 1e-8f,
        _ => 1,
    };

    static float Find(Vector3 start, Vector3 direction, Vector3 extents, float first, float last)
    {
        BoxLine.FindNearest(Lanes.Broadcast<Vector3, Vector3Wide>(start), Lanes.Broadcast<Vector3, Vector3Wide>(direction),
            Lanes.Broadcast<Vector3, Vector3Wide>(extents), new(first), new(last), out var place);
        return place[0];
    }

    static double GetDistance(Vector3 start, Vector3 direction, Vector3 extents, double place)
    {
        double sum = 0;
        for (int i = 0; i < 3; ++i)
        {
            var beyond = Math.Max(0, Math.Abs(start[i] + direction[i] * place) - extents[i]);
            sum += beyond * beyond;
        }
        return Math.Sqrt(sum);
    }
}
