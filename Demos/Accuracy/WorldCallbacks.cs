using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;

namespace Demos.Accuracy;

/// <summary>One material for all pairs, contacts between everything that can move, or none.</summary>
partial struct WorldContacts(PairMaterialProperties material, ContactScope scope, float restitution = 0) : INarrowPhaseCallbacks
{
    public readonly void Initialize(Simulation simulation)
    {
    }

    public readonly bool AllowContactGeneration(
        int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) =>
        scope == ContactScope.All && (a.Mobility == CollidableMobility.Dynamic || b.Mobility == CollidableMobility.Dynamic);

    public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

    public readonly bool ConfigureContactManifold<TManifold>(
        int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        pairMaterial = material;
        return true;
    }

    public readonly bool ConfigureContactManifold(
        int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

    public readonly void Dispose()
    {
    }
}

/// <summary>Constant gravity, no damping.</summary>
struct WorldGravity(AccuracySettings settings) : IPoseIntegratorCallbacks
{
    readonly Vector3 gravity = settings.Gravity;
    Vector3Wide gravityDt;

    public readonly AngularIntegrationMode AngularIntegrationMode { get; } = settings.AngularMode;

    public readonly bool AllowSubstepsForUnconstrainedBodies { get; } = settings.SubstepsForFreeBodies;

    public readonly bool IntegrateVelocityForKinematics => false;

    public readonly void Initialize(Simulation simulation)
    {
    }

    public void PrepareForIntegration(float dt) => Vector3Wide.Broadcast(gravity * dt, out gravityDt);

    public readonly void IntegrateVelocity(
        Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia,
        Vector<int> integrationMask, int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity) =>
        velocity.Linear = velocity.Linear + gravityDt;
}
