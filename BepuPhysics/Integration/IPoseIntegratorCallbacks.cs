using System.Numerics;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>How orientations and angular velocities are advanced.</summary>
public enum AngularIntegrationMode
{
    /// <summary>Angular velocity stays as it is while the body turns. Cheapest; wrong for everything but spheres and cubes that spin.</summary>
    Nonconserving = 0,
    /// <summary>Angular momentum is kept while the body turns; energy is not.</summary>
    ConserveMomentum = 1,
    /// <summary>Angular momentum and energy are kept: the motion of a free rigid body, tumbling included.</summary>
    ConserveMomentumWithGyroscopicTorque = 2,
}

/// <summary>What moves bodies besides constraints: gravity, damping, winds.</summary>
/// <remarks>Implement this with a struct: the integrator is compiled for it, so calls are direct and usually inlined.</remarks>
public interface IPoseIntegratorCallbacks
{
    /// <summary>Changes the velocities of a bundle of bodies. Called from worker threads.</summary>
    /// <remarks>
    /// A body whose velocity comes back as NaN, infinite or beyond 3e12 is stopped and listed in <see cref="Simulation.Quarantine"/>.
    /// </remarks>
    /// <param name="bodyIndices">Indices of the bodies in the active set; -1 for unused lanes.</param>
    /// <param name="position">Positions of the bodies.</param>
    /// <param name="orientation">Orientations of the bodies.</param>
    /// <param name="localInertia">Inverse inertias in the frames of the bodies.</param>
    /// <param name="integrationMask">-1 in lanes whose result is used, 0 elsewhere.</param>
    /// <param name="workerIndex">Index of the calling worker.</param>
    /// <param name="dt">Time to integrate over, s.</param>
    /// <param name="velocity">Velocities, to be changed in place.</param>
    void IntegrateVelocity(
        Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia,
        Vector<int> integrationMask, int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity);

    /// <summary>
    /// Called before bodies are integrated over a time, on the thread that steps the simulation: the place to work out what all bodies share.
    /// </summary>
    /// <param name="dt">Time that the following calls integrate over, s.</param>
    void PrepareForIntegration(float dt);

    /// <summary>Called once, when the simulation has been created.</summary>
    void Initialize(Simulation simulation);

    /// <summary>Whether <see cref="IntegrateVelocity"/> is called for kinematic bodies too.</summary>
    bool IntegrateVelocityForKinematics { get; }

    /// <summary>
    /// Whether bodies without constraints take the substeps of the others. If not, they are integrated once, over the whole step, after its substeps:
    /// <see cref="PrepareForIntegration"/> and <see cref="IntegrateVelocity"/> are called for that with the time of the step. It takes a fourth of
    /// the time with four substeps. They move by the mean of the velocities before and after, so gravity alone makes an exact parabola, and positions are
    /// those of the middle of the step, so what goes round a centre keeps its energy; forces that change within a step are resolved less well, and events
    /// between substeps find them where the step began.
    /// </summary>
    bool AllowSubstepsForUnconstrainedBodies { get; }

    /// <summary>How orientations and angular velocities are advanced. A value that is none ends the step before it begins.</summary>
    AngularIntegrationMode AngularIntegrationMode { get; }
}
