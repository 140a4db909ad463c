using System.Numerics;

namespace BepuPhysics;

/// <summary>Parts of a step in which bodies are integrated.</summary>
enum IntegrationStage
{
    /// <summary>The step begins: velocities only. Nothing has moved since collision detection.</summary>
    First,
    /// <summary>A substep ends and the next begins: poses, then velocities.</summary>
    Between,
    /// <summary>A substep has been solved and will be relaxed: poses, and the inertias that go with them.</summary>
    Poses,
    /// <summary>The substep before has been relaxed, and the next begins: velocities only.</summary>
    Velocities,
    /// <summary>The step ends without relaxation: poses only.</summary>
    Last,
}

/// <summary>Moves bodies by their velocities, and velocities by what the game's callbacks say.</summary>
public interface IPoseIntegrator
{
    internal void Initialize(Simulation simulation);

    /// <summary>Compiles what is compiled for the callbacks, without calling them.</summary>
    internal void Compile();

    /// <summary>Saves or restores what the integrator keeps from step to step beside the bodies.</summary>
    internal void CopyState(StateCopy copy);

    /// <summary>Tells the callbacks about a time over which velocities will be integrated. Called on the thread that steps.</summary>
    internal void Prepare(float dt);

    /// <summary>Whether bodies without constraints take the substeps of the others, too.</summary>
    internal bool SubstepsFreeBodies { get; }

    /// <summary>Integrates some bundles of the active bodies. Called on worker threads.</summary>
    internal void Integrate(IntegrationStage stage, float dt, in FreeBodies freeBodies, int startBundle, int endBundle, int workerIndex);

    /// <summary>Integrates the free bodies of some bundles, which <see cref="Integrate"/> leaves out, over a whole step. Called on worker threads.</summary>
    internal void IntegrateFree(float dt, in FreeBodies freeBodies, int startBundle, int endBundle, int workerIndex);

    /// <summary>Velocities that a bundle of bodies will have after a time, for the prediction of bounds.</summary>
    /// <param name="bundle">The bundle.</param>
    /// <param name="dt">The time, s.</param>
    /// <param name="workerIndex">Index of the calling worker.</param>
    /// <param name="pose">Poses of the bodies.</param>
    /// <param name="velocity">Velocities that they will have.</param>
    /// <param name="speedSquared">Squared speeds that they have now, linear plus angular; infinite for kinematic bodies that move at all.</param>
    /// <param name="gain">How much their linear velocities will have changed, m/s.</param>
    internal void PredictVelocities(
        int bundle, float dt, int workerIndex, out RigidPoseWide pose, out BodyVelocityWide velocity, out Vector<float> speedSquared, out Vector<float> gain);
}
