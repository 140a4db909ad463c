using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Compatibility;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Events;

/// <summary>Handlers that were written for the contact events demo of bepuphysics2: they compile, and hear what they expect in its order.</summary>
public sealed class ContactEventHandlerTests
{
    // Signatures as a game has them, which implements what it needs and no more.
    sealed class Particles : IContactEventHandler
    {
        public List<Vector3> Places { get; } = [];

        public void OnContactAdded<T>(
            CollidableReference heard, CollidablePair both, ref T contacts, Vector3 place, Vector3 normal, float depth, int feature, int index, int worker)
            where T : unmanaged, IContactManifold<T>
        {
            Assert.Equal(feature, contacts.GetFeatureId(index));
            Assert.Equal(place, contacts.GetOffset(index));
            Places.Add(place);
        }
    }

    sealed class Journal : IContactEventHandler
    {
        public List<string> Lines { get; } = [];

        public void OnContactAdded<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, Vector3 contactOffset,
            Vector3 contactNormal, float depth, int featureId, int contactIndex, int workerIndex) where TManifold : unmanaged, IContactManifold<TManifold> =>
            Lines.Add("added");

        public void OnContactRemoved<TManifold>(
            CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int removedFeatureId, int workerIndex)
            where TManifold : unmanaged, IContactManifold<TManifold> => Lines.Add("removed");

        public void OnStartedTouching<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
            where TManifold : unmanaged, IContactManifold<TManifold> => Lines.Add("started");

        public void OnTouching<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
            where TManifold : unmanaged, IContactManifold<TManifold> => Lines.Add("touching");

        public void OnStoppedTouching<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
            where TManifold : unmanaged, IContactManifold<TManifold> => Lines.Add("stopped");

        public void OnPairCreated<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
            where TManifold : unmanaged, IContactManifold<TManifold> => Lines.Add("created");

        public void OnPairUpdated<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
            where TManifold : unmanaged, IContactManifold<TManifold> => Lines.Add($"updated {contactManifold.Count}");

        public void OnPairEnded(CollidableReference eventSource, CollidablePair pair) => Lines.Add("ended");

        public List<string> Take()
        {
            List<string> taken = [.. Lines];
            Lines.Clear();
            return taken;
        }
    }

    [Fact]
    public void AHandlerHearsOfAPairFromItsBeginningToItsEnd()
    {
        using var world = new TestWorld();
        using var events = new ContactEvents();
        events.Initialize(world.Simulation);
        var floor = world.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -1, 0)));
        var ball = world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(3, .495f, 0)));
        var journal = new Journal();
        var particles = new Particles();
        events.Register(ball, journal);
        events.Register(floor, particles);
        Assert.True(events.IsListener(world.Bodies[ball].CollidableReference));

        Step();
        Assert.Equal(["created", "added", "started", "touching", "updated 1"], journal.Take());
        Assert.InRange((particles.Places[0] - new Vector3(0, -.4975f, 0)).Length(), 0, 1e-5f);
        Step();
        Assert.Equal(["touching", "updated 1"], journal.Take());
        // Leaves the floor at once, and is foreseen no more.
        world.Bodies[ball].Pose.Position = new Vector3(3, 9, 0);
        Step();
        Assert.Equal(["removed", "stopped", "ended"], journal.Take());
        Step();
        Assert.Empty(journal.Take());

        events.Unregister(ball);
        world.Bodies[ball].Pose.Position = new Vector3(3, .49f, 0);
        Step();
        Assert.Empty(journal.Take());
        Assert.Equal(2, particles.Places.Count);

        void Step()
        {
            world.Step();
            events.Flush();
        }
    }

    sealed class Offsets : IContactEventHandler
    {
        public List<Vector3> OfB { get; } = [];

        public void OnPairUpdated<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
            where TManifold : unmanaged, IContactManifold<TManifold> => OfB.Add(Assert.IsType<ConvexContactManifold>(contactManifold).OffsetB);
    }

    [Theory]
    [InlineData(CollidableMobility.Static)]
    [InlineData(CollidableMobility.Kinematic)]
    [InlineData(CollidableMobility.Dynamic)]
    public void AManifoldLeadsToTheOtherOfItsPair(CollidableMobility mobility)
    {
        using var world = new TestWorld();
        using var events = new ContactEvents();
        events.Initialize(world.Simulation);
        var below = new RigidPose(new Vector3(1, -1, 2));
        // What comes first in a pair is A.
        var ball = world.AddDynamic(new Sphere(.5f), 1, new RigidPose(new Vector3(3, .495f, 1)));
        if (mobility == CollidableMobility.Static)
            world.AddStatic(new Box(20, 2, 20), below);
        else if (mobility == CollidableMobility.Kinematic)
            world.AddKinematic(new Box(20, 2, 20), below);
        else
            world.AddDynamic(new Box(20, 2, 20), 1000, below);
        var offsets = new Offsets();
        events.Register(ball, offsets);
        world.Step();
        events.Flush();
        Assert.InRange((Assert.Single(offsets.OfB) - new Vector3(-2, -1.495f, 1)).Length(), 0, 1e-6f);
    }

    [Fact]
    public void AHandlerMayRemoveWhatItHearsOf()
    {
        using var world = new TestWorld();
        using var events = new ContactEvents(world.Dispatcher, world.Pool);
        events.Initialize(world.Simulation);
        world.AddStatic(new Box(20, 2, 20), new RigidPose(new Vector3(0, -1, 0)));
        var remover = new Remover(world.Simulation);
        for (int i = 0; i < 8; ++i)
            events.Register(world.AddDynamic(new Box(1, 1, 1), 1, new RigidPose(new Vector3(2 * i - 8, .6f, 0))), remover);
        for (int step = 0; step < 60; ++step)
        {
            world.Step();
            events.Flush();
        }
        Assert.Equal(0, world.Bodies.CountBodies());
        Assert.Equal((8, 8), (remover.Started, remover.Ended));
        world.Simulation.Validate();
    }

    sealed class Remover(Simulation simulation) : IContactEventHandler
    {
        public int Started { get; private set; }

        public int Ended { get; private set; }

        public void OnStartedTouching<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            ++Started;
            simulation.Bodies.Remove(eventSource.BodyHandle);
        }

        public void OnPairEnded(CollidableReference eventSource, CollidablePair pair) => ++Ended;
    }
}
