using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;

namespace DemoTests.Scenes;

/// <summary>Where a game's code may throw within a step.</summary>
public enum FailingPlace
{
    AllowContacts,
    ConfigureManifold,
    GetSurface,
    PrepareForIntegration,
    IntegrateVelocity,
    SubstepStarted,
    SubstepEnded,
    BeforeCollisionDetection,
    CollisionsDetected,
    ConstraintsSolved,
    IterationScheduler,
}

/// <summary>Throws once it is armed, at one place.</summary>
sealed class Bomb(FailingPlace place)
{
    public bool Armed { get; set; }

    public void Pass(FailingPlace here)
    {
        if (Armed && here == place)
            throw new InvalidTimeZoneException(here.ToString());
    }
}

struct ThrowingContacts(Bomb bomb) : ISurfaceCallbacks<ThrowingContacts>
{
    public readonly void Initialize(Simulation simulation)
    {
    }

    public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin)
    {
        bomb.Pass(FailingPlace.AllowContacts);
        return true;
    }

    public readonly bool ConfigureContactManifold<TManifold>(
        int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        bomb.Pass(FailingPlace.ConfigureManifold);
        pairMaterial = new PairMaterialProperties(.5f, 2, default);
        return true;
    }

    public readonly SurfaceProperties GetSurface<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        bomb.Pass(FailingPlace.GetSurface);
        return new() { Restitution = .5f };
    }

    public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

    public readonly bool ConfigureContactManifold(
        int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

    public readonly void Dispose()
    {
    }
}

struct ThrowingGravity(Bomb bomb) : IPoseIntegratorCallbacks
{
    Vector<float> change;

    public readonly AngularIntegrationMode AngularIntegrationMode => AngularIntegrationMode.Nonconserving;

    public readonly bool AllowSubstepsForUnconstrainedBodies => true;

    public readonly bool IntegrateVelocityForKinematics => false;

    public readonly void Initialize(Simulation simulation)
    {
    }

    public void PrepareForIntegration(float dt)
    {
        bomb.Pass(FailingPlace.PrepareForIntegration);
        change = new Vector<float>(-10 * dt);
    }

    public readonly void IntegrateVelocity(
        Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia,
        Vector<int> integrationMask, int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity)
    {
        bomb.Pass(FailingPlace.IntegrateVelocity);
        velocity.Linear.Y += change;
    }
}
