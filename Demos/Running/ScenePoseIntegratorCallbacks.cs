using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuUtilities;
using Demos.Engine;

namespace Demos.Running;

/// <summary>Gravity along y and exponential damping of both velocities.</summary>
struct ScenePoseIntegratorCallbacks(float gravity, float damping) : IPoseIntegratorCallbacks
{
    readonly float gravity = gravity;
    Vector<float> gravityTimesDt;
    Vector<float> velocityScale;

    public readonly AngularIntegrationMode AngularIntegrationMode => EngineDefaults.RotationMode;

    public readonly bool AllowSubstepsForUnconstrainedBodies => false;

    public readonly bool IntegrateVelocityForKinematics => false;

    public readonly void Initialize(Simulation simulation)
    {
    }

    public void PrepareForIntegration(float dt)
    {
        gravityTimesDt = new Vector<float>(gravity * dt);
        velocityScale = new Vector<float>((float)Decay((double)damping * dt));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void IntegrateVelocity(Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation,
        BodyInertiaWide localInertia, Vector<int> integrationMask, int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity)
    {
        velocity.Linear.X *= velocityScale;
        velocity.Linear.Y = (velocity.Linear.Y + gravityTimesDt) * velocityScale;
        velocity.Linear.Z *= velocityScale;
        velocity.Angular.X *= velocityScale;
        velocity.Angular.Y *= velocityScale;
        velocity.Angular.Z *= velocityScale;
    }

    /// <summary>
    /// exp(-x) for x of zero and above, made of operations that every machine rounds alike: the C runtime's exponential is not. The
    /// argument is halved until eight terms of the series are exact to double precision, and the result squared as often.
    /// </summary>
    static double Decay(double x)
    {
        int halvings = 0;
        // exp(-700) is below what single precision can hold.
        if (x > 700)
            return 0;
        for (; x > 1 / 64.0; x *= 0.5)
            ++halvings;
        double sum = 1;
        for (int term = 8; term > 0; --term)
            sum = 1 - x / term * sum;
        for (; halvings > 0; --halvings)
            sum *= sum;
        return sum;
    }
}
