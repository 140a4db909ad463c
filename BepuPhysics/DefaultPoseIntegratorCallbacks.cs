using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Ready-made integrator callbacks: one gravity, no damping, free rotation as a rigid body rotates.</summary>
public struct DefaultPoseIntegratorCallbacks : IPoseIntegratorCallbacks
{
    Vector3Wide velocityChange;

    /// <summary>Acceleration of all dynamic bodies, m/s2.</summary>
    public Vector3 Gravity;

    /// <summary>Gravity of 9.81 m/s2 against y.</summary>
    public DefaultPoseIntegratorCallbacks() : this(new Vector3(0, -9.81f, 0)) { }

    /// <summary>One gravity.</summary>
    public DefaultPoseIntegratorCallbacks(Vector3 gravity) => Gravity = gravity;

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
