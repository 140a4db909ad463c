using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>Heaps of what hangs together by joints come to rest, as heaps of what does not.</summary>
public class JoinedHeapTests
{
    // Lifted out of their overlaps as fast as what is not joined, four of these six stirred for ever. Some heap may do so by the luck of its contacts.
    [Fact]
    public void Heaps_of_chains_fall_asleep()
    {
        var stirring = 0;
        foreach (var (chains, seed, frequency) in (ReadOnlySpan<(int, int, float)>)[(8, 2, 0), (10, 2, 0), (12, 6, 0), (7, 3, 10), (10, 3, 10), (12, 6, 10)])
            stirring += IsAsleep(chains, seed, frequency) ? 0 : 1;
        Assert.InRange(stirring, 0, 1);
    }

    static bool IsAsleep(int chains, int seed, float frequency)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        var random = new Random(seed);
        for (int i = 0; i < chains; ++i)
        {
            var start = new Vector3((random.NextSingle() - .5f) * 2, 1 + i * .5f, (random.NextSingle() - .5f) * 2);
            AddChain(world.Simulation, start, frequency, random);
        }
        world.Run(20);
        return world.Simulation.Bodies.ActiveSet.Count == 0;
    }

    // Boxes of 1 and 8 kg by turns, with ball joints, and servos where they have a frequency.
    static void AddChain(Simulation simulation, Vector3 start, float frequency, Random random)
    {
        var link = new Box(.4f, .2f, .2f);
        var shape = simulation.Shapes.Add(link);
        BodyHandle last = default;
        for (int i = 0; i < 5; ++i)
        {
            var body = simulation.Bodies.Add(BodyDescription.CreateDynamic(
                start + new Vector3(i * .45f, 0, 0), link.ComputeInertia(i % 2 == 0 ? 1 : 8), shape, .01f));
            if (i > 0)
            {
                simulation.Solver.Add(last, body, new BallSocket
                {
                    LocalOffsetA = new Vector3(.225f, 0, 0),
                    LocalOffsetB = new Vector3(-.225f, 0, 0),
                    SpringSettings = new SpringSettings(30, 1),
                });
                if (frequency > 0)
                {
                    simulation.Solver.Add(last, body, new AngularServo
                    {
                        TargetRelativeRotationLocalA = Quaternion.CreateFromYawPitchRoll(Turn(random), Turn(random), Turn(random)),
                        ServoSettings = new ServoSettings(float.MaxValue, 0, float.MaxValue),
                        SpringSettings = new SpringSettings(frequency, 1),
                    });
                }
            }
            last = body;
        }
    }

    static float Turn(Random random) => random.NextSingle() - .5f;
}
