using System;
using System.Collections.Generic;
using System.Linq;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.FastBodies;

/// <summary>The earliest of times that change is that which a search through all of them finds.</summary>
public class EarliestTimeTests
{
    [Fact]
    public void TheFirstIsThatOfAllTimes()
    {
        var random = new Random(3);
        var pool = new BufferPool();
        var earliest = new EarliestTime(pool);
        for (int round = 0; round < 20; ++round)
        {
            List<double> times = [.. Enumerable.Repeat(double.PositiveInfinity, random.Next(40))];
            earliest.Clear(times.Count, pool);
            for (int i = 0; i < 400; ++i)
            {
                // Few times, so that many are equal; and many that never come.
                var time = random.Next(3) == 0 ? double.PositiveInfinity : random.Next(8);
                if (times.Count == 0 || random.Next(20) == 0)
                {
                    earliest.Add(times.Count, time, pool);
                    times.Add(time);
                }
                else
                {
                    var number = random.Next(times.Count);
                    times[number] = time;
                    earliest.Change(number, time, pool);
                }
                var least = times.Min();
                Assert.Equal(double.IsFinite(least) ? times.IndexOf(least) : -1, earliest.First);
            }
        }
        earliest.Dispose(pool);
        pool.Clear();
    }
}
