using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// A game that calls the stages of a step by itself wrote an inertia that is none through a reference, and solved. The body was made kinematic when the
/// solver had ended, which takes its contacts with statics away, and the events of these were written from where they had been: the process died.
/// </summary>
public class EventsOfTheStoppedTests
{
    [Fact]
    public void ContactsOfABodyThatIsStoppedAreTold()
    {
        using var pool = new BufferPool();
        using var simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -1, 0), simulation.Shapes.Add(new Box(100, 2, 100))));
        var cube = new Box(1, 1, 1);
        var shape = simulation.Shapes.Add(cube);
        var body = simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(3, .5f, 0), cube.ComputeInertia(1), shape, -1));
        // Its contacts take the place of those that go.
        var plate = new Box(4, .2f, 4);
        simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(-3, .1f, 0), plate.ComputeInertia(1), simulation.Shapes.Add(plate), -1));
        simulation.Events.Listen(body, EventMask.All);
        for (int i = 0; i < 30; ++i)
            simulation.Timestep(1 / 60f);
        Assert.Single(simulation.Events.Persisting.ToArray());

        simulation.Bodies[body].LocalInertia.InverseInertiaTensor = new Symmetric3x3 { XX = 6, YY = 6, ZZ = float.NegativeInfinity };
        simulation.Solve(1 / 60f);

        Assert.True(simulation.Bodies[body].Kinematic);
        // What pushed it was no number, so the contact ends.
        var told = Assert.Single(simulation.Events.Ended.ToArray());
        Assert.Equal(4, told.ContactCount);
        foreach (var contact in simulation.Events.Contacts(told))
        {
            Assert.InRange(System.MathF.Abs(contact.Normal.Y), .999f, 1.001f);
            Assert.InRange(contact.Position.X, 2.4f, 3.6f);
            Assert.InRange(contact.Position.Y, -.01f, .01f);
        }
        simulation.Timestep(1 / 60f);
        simulation.Validate();
    }
}
