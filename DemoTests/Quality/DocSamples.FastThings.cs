using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;

namespace DemoTests.Quality;

// Docs/Guides/FastThings.md.
static partial class DocSamples
{
    public static BodyHandle Shoot(Simulation simulation, Vector3 muzzle, Vector3 direction)
    {
        var bullet = new Sphere(.005f);
        var collidable = new CollidableDescription(simulation.Shapes.Add(bullet), ContinuousDetection.Continuous());
        var handle = simulation.Bodies.Add(BodyDescription.CreateDynamic(
            muzzle, new BodyVelocity(direction * 500), bullet.ComputeInertia(.008f), collidable, .01f));
        return handle;
    }
}
