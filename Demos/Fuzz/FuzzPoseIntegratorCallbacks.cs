using System.Numerics;
using BepuPhysics;
using BepuUtilities;

namespace Demos.Fuzz;

/// <summary>Gravity, and what the plan says.</summary>
readonly struct FuzzPoseIntegratorCallbacks(FuzzPlan plan, AngularIntegrationMode mode) : IPoseIntegratorCallbacks
{
    public AngularIntegrationMode AngularIntegrationMode => mode;

    public bool AllowSubstepsForUnconstrainedBodies => mode != AngularIntegrationMode.ConserveMomentumWithGyroscopicTorque;

    public bool IntegrateVelocityForKinematics => false;

    public void Initialize(Simulation simulation)
    {
    }

    public void PrepareForIntegration(float dt) => plan.OnCall();

    public void IntegrateVelocity(
        Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia,
        Vector<int> integrationMask, int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity)
    {
        plan.OnCall();
        velocity.Linear.Y -= dt * new Vector<float>(10);
        // One body's alone.
        if (plan.Velocity != 0)
            velocity.Linear.X = Vector.ConditionalSelect(Vector.Equals(bodyIndices, Vector<int>.Zero), new Vector<float>(plan.Velocity), velocity.Linear.X);
    }
}
