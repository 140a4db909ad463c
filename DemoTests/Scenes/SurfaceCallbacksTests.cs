using System;
using System.Linq;
using System.Numerics;
using System.Reflection;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>What a game says of its surfaces: three fields for every pair, the rest from those who have it.</summary>
public class SurfaceCallbacksTests
{
    // Games fill in an out parameter field by field: C# demands that each is named, so a fourth field breaks them all.
    [Fact]
    public void A_material_has_exactly_three_fields()
    {
        var fields = typeof(PairMaterialProperties)
            .GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic).Select(field => field.Name);
        Assert.Equal(["FrictionCoefficient", "MaximumRecoveryVelocity", "SpringSettings"], fields.Order(StringComparer.Ordinal));
    }

    [Fact]
    public void Surfaces_bounce_pair_by_pair()
    {
        using var world = new CallbackWorld<BouncyStatics>(new BouncyStatics());
        var hard = world.AddStatic(new Box(4, 2, 4), new Vector3(-5, -1, 0));
        world.Callbacks.Bouncy = world.AddStatic(new Box(4, 2, 4), new Vector3(5, -1, 0));
        var stays = world.AddBall(new Vector3(-5, .51f, 0), -3);
        var bounces = world.AddBall(new Vector3(5, .51f, 0), -3);

        world.Step();

        Assert.NotEqual(hard, world.Callbacks.Bouncy);
        // Of what it fell with and gained over the last centimetre, less what gravity took since, at most all of the step.
        var rebound = .8f * MathF.Sqrt(3 * 3 + 2 * 9.81f * .01f);
        Assert.InRange(world.Velocity(bounces).Y, rebound - 9.81f / 60, rebound + .001f);
        // Less than a tenth of it: what is left of the push that stopped it.
        Assert.InRange(world.Velocity(stays).Y, -.3f, .3f);
    }

    [Fact]
    public void Callbacks_count_in_the_struct_that_the_narrow_phase_holds()
    {
        using var world = new CallbackWorld<BouncyStatics>(new BouncyStatics());
        world.AddStatic(new Box(4, 2, 4), new Vector3(0, -1, 0));
        world.AddBall(new Vector3(0, .49f, 0), 0);
        world.Step();
        Assert.Equal(1, world.Callbacks.Asked);
        world.Callbacks.Asked = 10;
        world.Step();
        Assert.Equal(11, world.Callbacks.Asked);
    }

    [Fact]
    public void A_surface_of_another_struct_is_refused()
    {
        using var world = new CallbackWorld<WrongSelf>(new WrongSelf());
        world.AddStatic(new Box(4, 2, 4), new Vector3(0, -1, 0));
        world.AddBall(new Vector3(0, .49f, 0), 0);
        var refusal = Assert.Throws<InvalidOperationException>(world.Step);
        Assert.Contains(nameof(WrongSelf), refusal.Message, StringComparison.Ordinal);
    }

    // An interface method with a body boxes the struct that does not have it: neither those that say nothing of surfaces nor those that do
    // may make garbage.
    [Fact]
    public void No_callbacks_are_boxed()
    {
        Assert.Equal(0, Garbage(new BouncyStatics()));
        Assert.Equal(0, Garbage(new FieldByField()));
    }

    static long Garbage<TCallbacks>(TCallbacks callbacks) where TCallbacks : struct, INarrowPhaseCallbacks
    {
        using var world = new CallbackWorld<TCallbacks>(callbacks);
        world.AddStatic(new Box(40, 2, 40), new Vector3(0, -1, 0));
        for (int i = 0; i < 20; ++i)
            world.AddBall(new Vector3(i - 10, .5f, 0), 0);
        for (int i = 0; i < 60; ++i)
            world.Step();
        var before = GC.GetAllocatedBytesForCurrentThread();
        for (int i = 0; i < 30; ++i)
            world.Step();
        return GC.GetAllocatedBytesForCurrentThread() - before;
    }

    struct BouncyStatics : ISurfaceCallbacks<BouncyStatics>
    {
        public StaticHandle? Bouncy;
        public int Asked;

        public SurfaceProperties GetSurface<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            ++Asked;
            return new() { Restitution = pair.B.Mobility == CollidableMobility.Static && pair.B.StaticHandle == Bouncy ? .8f : 0 };
        }

        public readonly void Initialize(Simulation simulation) { }

        public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) => true;

        public readonly bool ConfigureContactManifold<TManifold>(
            int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            pairMaterial = new(.5f, 2, SpringSettings.Rigid);
            return true;
        }

        public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

        public readonly bool ConfigureContactManifold(
            int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

        public readonly void Dispose() { }
    }

    // As games write it; and it may keep references to objects.
    struct FieldByField : INarrowPhaseCallbacks
    {
        Simulation simulation;

        public void Initialize(Simulation simulation) => this.simulation = simulation;

        public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) =>
            simulation.Bodies.BodyExists(a.BodyHandle);

        public readonly bool ConfigureContactManifold<TManifold>(
            int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            pairMaterial.FrictionCoefficient = 1;
            pairMaterial.MaximumRecoveryVelocity = 2;
            pairMaterial.SpringSettings = new SpringSettings(30, 1);
            return true;
        }

        public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

        public readonly bool ConfigureContactManifold(
            int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

        public readonly void Dispose() { }
    }

    // A mistake that the compiler does not see.
    struct WrongSelf : ISurfaceCallbacks<BouncyStatics>
    {
        BouncyStatics inner;

        public SurfaceProperties GetSurface<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold)
            where TManifold : unmanaged, IContactManifold<TManifold> => inner.GetSurface(workerIndex, pair, ref manifold);

        public readonly void Initialize(Simulation simulation) { }

        public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) => true;

        public readonly bool ConfigureContactManifold<TManifold>(
            int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
            where TManifold : unmanaged, IContactManifold<TManifold> =>
            inner.ConfigureContactManifold(workerIndex, pair, ref manifold, out pairMaterial);

        public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

        public readonly bool ConfigureContactManifold(
            int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

        public readonly void Dispose() { }
    }
}
