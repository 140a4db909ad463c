using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;

namespace Benchmarks.Sweeps.Shared;

/// <summary>Contacts of a world that never steps.</summary>
struct NoContacts : INarrowPhaseCallbacks
{
    public readonly void Initialize(Simulation simulation)
    {
    }

    public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) => false;

    public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => false;

    public readonly bool ConfigureContactManifold<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties material)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        material = default;
        return false;
    }

    public readonly bool ConfigureContactManifold(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) =>
        false;

    public readonly void Dispose()
    {
    }
}

/// <summary>Motion of a world that never steps.</summary>
struct NoMotion : IPoseIntegratorCallbacks
{
    public readonly AngularIntegrationMode AngularIntegrationMode => AngularIntegrationMode.Nonconserving;

    public readonly bool AllowSubstepsForUnconstrainedBodies => false;

    public readonly bool IntegrateVelocityForKinematics => false;

    public readonly void Initialize(Simulation simulation)
    {
    }

    public readonly void PrepareForIntegration(float dt)
    {
    }

    public readonly void IntegrateVelocity(Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia,
        Vector<int> integrationMask, int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity)
    {
    }
}

/// <summary>Keeps the nearest hit.</summary>
struct NearestHit : ISweepHitHandler
{
    public bool IsHit;
    public float T;

    public readonly bool AllowTest(CollidableReference collidable) => true;

    public readonly bool AllowTest(CollidableReference collidable, int child) => true;

    public void OnHit(ref float maximumT, float t, Vector3 hitLocation, Vector3 hitNormal, CollidableReference collidable)
    {
        maximumT = t;
        (IsHit, T) = (true, t);
    }

    public void OnHitAtZeroT(ref float maximumT, CollidableReference collidable)
    {
        maximumT = 0;
        (IsHit, T) = (true, 0);
    }
}
