using BepuPhysics;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Demos.Engine;
using Demos.Scenes;

namespace Demos.Running;

/// <summary>A scene in a simulation at the usual settings, not yet stepped, for commands that look into its steps.</summary>
static class WatchedScene
{
    /// <summary>Makes the simulation; whoever does warms it up.</summary>
    /// <param name="scene">What is in it.</param>
    /// <param name="pool">Its memory.</param>
    /// <param name="threads">Threads that its steps may use.</param>
    public static Simulation Build(SceneDescription scene, BufferPool pool, int threads)
    {
        var recorder = new ContactRecorder(threads);
        var simulation = Simulation.Create(
            pool,
            new SceneNarrowPhaseCallbacks(recorder, new PairMaterialProperties(scene.Friction, EngineDefaults.MaximumRecoveryVelocity, default)),
            new ScenePoseIntegratorCallbacks(SceneDescription.Gravity, scene.Damping), new SolveDescription(1, 4));
        SceneBuilder.Build(scene, simulation, default, recorder);
        return simulation;
    }
}
