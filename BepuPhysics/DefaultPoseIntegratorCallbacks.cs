using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Ready-made integrator callbacks: one gravity, no damping, free rotation as a rigid body rotates.</summary>
public struct DefaultPoseIntegratorCallbacks : IPoseIntegratorCallbacks
{
    // Set by every constructor: the default of a struct has no gravity, which is asked for by saying so.
    readonly bool isConstructed;
    Vector3Wide velocityChange;

    /// <summary>Acceleration of all dynamic bodies, m/s2.</summary>
    public Vector3 Gravity;

    /// <summary>Gravity of 9.81 m/s2 against y.</summary>
    public DefaultPoseIntegratorCallbacks() : this(new Vector3(0, -9.81f, 0)) { }

    /// <summary>One gravity.</summary>
    public DefaultPoseIntegratorCallbacks(Vector3 gravity)
    {
        Gravity = gravity;
        isConstructed = true;
    }

    /// <inheritdoc/>
    public readonly AngularIntegrationMode AngularIntegrationMode => AngularIntegrationMode.ConserveMomentumWithGyroscopicTorque;
    /// <inheritdoc/>
    public readonly bool AllowSubstepsForUnconstrainedBodies => true;
    /// <inheritdoc/>
    public readonly bool IntegrateVelocityForKinematics => false;

    /// <inheritdoc/>
    /// <exception cref="InvalidOperationException">These are the default of the struct, with nothing set.</exception>
    public readonly void Initialize(Simulation simulation)
    {
        if (!isConstructed && Gravity == Vector3.Zero)
        {
            throw new InvalidOperationException(
                $"The pose integrator callbacks are default({nameof(DefaultPoseIntegratorCallbacks)}), without gravity: make them with " +
                $"new {nameof(DefaultPoseIntegratorCallbacks)}(), or with new {nameof(DefaultPoseIntegratorCallbacks)}(Vector3.Zero).");
        }
    }

    /// <inheritdoc/>
    public void PrepareForIntegration(float dt) => velocityChange = Lanes.Broadcast<Vector3, Vector3Wide>(Gravity * dt);

    /// <inheritdoc/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void IntegrateVelocity(
        Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia,
        Vector<int> integrationMask, int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity) => velocity.Linear += velocityChange;
}
