using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>Heaps of free bodies come to rest, as they do without the load path.</summary>
public class HeapTests
{
    // Pushed out of their overlaps as fast as what stands by itself, five of these twelve stirred for ever. Some heap may do so by the luck of its contacts.
    [Fact]
    public void Heaps_of_boxes_fall_asleep()
    {
        const int heaps = 12;
        var stirring = 0;
        for (int seed = 0; seed < heaps; ++seed)
            stirring += IsAsleep(seed) ? 0 : 1;
        Assert.InRange(stirring, 0, 1);
    }

    static bool IsAsleep(int seed)
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, friction: .3f);
        Drop(world.Simulation, new Random(seed));
        world.Run(20);
        return world.Simulation.Bodies.ActiveSet.Count == 0;
    }

    // Boxes of .4 to 1.4 m that lie in any direction, in layers over each other.
    static void Drop(Simulation simulation, Random random)
    {
        const int count = 300, side = 6;
        float Next(float least, float most) => least + (most - least) * random.NextSingle();
        for (int i = 0; i < count; ++i)
        {
            var box = new Box(Next(.4f, 1.4f), Next(.4f, 1.4f), Next(.4f, 1.4f));
            var turn = Quaternion.CreateFromYawPitchRoll(Next(0, 3), Next(0, 3), Next(0, 3));
            var place = new Vector3(i % side * 1.8f + Next(0, .1f), 1.5f + i / (side * side) * 1.9f, i / side % side * 1.8f + Next(0, .1f));
            simulation.Bodies.Add(BodyDescription.CreateDynamic(
                new RigidPose(place, turn), box.ComputeInertia(box.Width * box.Height * box.Length), simulation.Shapes.Add(box), .01f));
        }
    }
}
