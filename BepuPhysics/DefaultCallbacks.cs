using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Ready-made narrow phase callbacks: everything collides, with one material. The default material is rigid, with a friction of 0.5.</summary>
public struct NarrowPhaseCallbacks : INarrowPhaseCallbacks
{
    /// <summary>Material of all pairs.</summary>
    public PairMaterialProperties Material;

    /// <summary>Everything collides; rigid contacts, a friction of 0.5.</summary>
    public NarrowPhaseCallbacks() : this(new PairMaterialProperties(0.5f, 2, SpringSettings.Rigid)) { }

    /// <summary>Everything collides, with one material.</summary>
    public NarrowPhaseCallbacks(PairMaterialProperties material) => Material = material;

    /// <inheritdoc/>
    public readonly void Initialize(Simulation simulation) { }

    /// <inheritdoc/>
    public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) => true;

    /// <inheritdoc/>
    public readonly bool ConfigureContactManifold<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold,
        out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        pairMaterial = Material;
        return true;
    }

    /// <inheritdoc/>
    public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

    /// <inheritdoc/>
    public readonly bool ConfigureContactManifold(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB,
        ref ConvexContactManifold manifold) => true;

    /// <inheritdoc/>
    public readonly void Dispose() { }
}

/// <summary>Ready-made integrator callbacks: one gravity, no damping, free rotation as a rigid body rotates.</summary>
public struct PoseIntegratorCallbacks : IPoseIntegratorCallbacks
{
    Vector3Wide velocityChange;

    /// <summary>Acceleration of all dynamic bodies, m/s2.</summary>
    public Vector3 Gravity;

    /// <summary>Gravity of 9.81 m/s2 against y.</summary>
    public PoseIntegratorCallbacks() : this(new Vector3(0, -9.81f, 0)) { }

    /// <summary>One gravity.</summary>
    public PoseIntegratorCallbacks(Vector3 gravity) => Gravity = gravity;

    /// <inheritdoc/>
    public readonly AngularIntegrationMode AngularIntegrationMode => AngularIntegrationMode.ConserveMomentumWithGyroscopicTorque;
    /// <inheritdoc/>
    public readonly bool AllowSubstepsForUnconstrainedBodies => true;
    /// <inheritdoc/>
    public readonly bool IntegrateVelocityForKinematics => false;

    /// <inheritdoc/>
    public readonly void Initialize(Simulation simulation) { }

    /// <inheritdoc/>
    public void PrepareForIntegration(float dt) => velocityChange = Lanes.Broadcast<Vector3, Vector3Wide>(Gravity * dt);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void IntegrateVelocity(
        Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia,
        Vector<int> integrationMask, int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity) => velocity.Linear += velocityChange;
}
