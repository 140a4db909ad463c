using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using DemoTests.Support;
using Xunit;
using static DemoTests.Quality.DocSamples;

namespace DemoTests.Quality;

/// <summary>Docs/Guides/OwnShapes.md does what it says.</summary>
public class OwnShapesGuideTests
{
    [Fact]
    public void A_rock_and_a_cone_come_to_rest_on_the_land_and_fall_into_what_is_dug()
    {
        var pool = new BufferPool();
        using (var simulation = EmptySimulation.Create(pool))
        {
            var land = AddLand(simulation, pool);
            // The land is 10 m high there, of 16: the surface is at y = -6.
            var rock = simulation.Bodies[AddRock(simulation, pool, new Vector3(-29, -5, -29))];
            var cone = simulation.Bodies[AddCone(simulation, new Vector3(-27.5f, -5.5f, -25.5f))];
            for (int i = 0; i < 120; ++i)
                simulation.Timestep(1 / 60f);
            // One cube of the eleven of the rock is not there: it lies flat all the same.
            Assert.InRange(rock.Pose.Position.Y, -5.6f, -5.4f);
            Assert.Equal(-5.75f, cone.Pose.Position.Y, 2e-3f);
            Assert.InRange(rock.Velocity.Linear.Length() + cone.Velocity.Linear.Length(), 0, .01f);
            simulation.Awakener.AwakenBody(cone.Handle);
            // Under the cone, and around it.
            for (int x = 3; x < 6; ++x)
            {
                for (int z = 5; z < 8; ++z)
                    Dig(simulation, pool, land, x, 9, z);
            }
            for (int i = 0; i < 120; ++i)
                simulation.Timestep(1 / 60f);
            Assert.InRange(cone.Pose.Position.Y, -6.8f, -6.5f);
            simulation.Bodies.Clear();
            var shape = simulation.Statics[land].Shape;
            simulation.Statics.Clear();
            simulation.Shapes.RemoveAndDispose(shape, pool);
            simulation.Shapes.RemoveAndDispose(new TypedIndex(Voxels.TypeId, 1), pool);
        }
        pool.AssertEmpty();
        pool.Clear();
    }
}
