using BepuPhysics;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;

namespace Demos.Accuracy;

/// <summary>
/// All that the suite knows about this engine beyond the shared surface. With another file of this name it measures another engine.
/// </summary>
static class EngineTraits
{
    public const int DefaultSubstepCount = 4;
    public const int DefaultVelocityIterationCount = 1;

    /// <summary>Relaxation sweeps per substep, for those who pay for accuracy.</summary>
    public const int AccurateRelaxationCount = 1;

    /// <summary>Whether there are relaxation sweeps at all.</summary>
    public const bool HasRelaxation = true;

    /// <summary>Whether loads can be handed down to the ground in one go.</summary>
    public const bool HasLoadPath = true;

    /// <summary>Whether all joints of a structure can be solved at once.</summary>
    public const bool HasDirectJoints = true;

    /// <summary>As in the ready-made callbacks.</summary>
    public const AngularIntegrationMode DefaultAngularMode = AngularIntegrationMode.ConserveMomentumWithGyroscopicTorque;

    /// <summary>Substeps for bodies that touch nothing; as in the ready-made callbacks.</summary>
    public const bool DefaultSubstepsForFreeBodies = true;
    public const AngularIntegrationMode AccurateAngularMode = AngularIntegrationMode.ConserveMomentumWithGyroscopicTorque;

    /// <summary>What a game gets that asks for nothing. Here that is a rigid contact or joint.</summary>
    public static SpringSettings DefaultSpring(float substepDuration) => default;

    /// <summary>As stiff as the substep and its sweeps allow: the engine chooses.</summary>
    public static SpringSettings RigidSpring(AccuracySettings settings) => default;

    /// <summary>Springs that a sweep of the dials tries: the default is rigid and follows the substeps by itself.</summary>
    public static string[] TradedSprings => ["default"];

    /// <summary>Ways to integrate rotation that a sweep tries in scenes where nothing spins fast: the default, and the cheapest.</summary>
    public static string[] TradedModes => ["default", "plain"];

    public static SolveDescription Solve(AccuracySettings settings) =>
        new(settings.VelocityIterationCount, settings.SubstepCount)
        {
            RelaxationIterationCount = settings.RelaxationCount,
            LoadPath = (LoadPathMode)settings.LoadPath,
            DirectJoints = (DirectJointsMode)settings.DirectJoints,
        };

    /// <summary>What pairs collide, and how: here bounces are no part of the spring.</summary>
    public static WorldContacts Contacts(AccuracySettings settings) => new(
        new PairMaterialProperties(settings.Friction, settings.MaximumRecoveryVelocity, settings.Spring), settings.Contacts, settings.Restitution);
}

/// <summary>The part of the callbacks that only this engine asks for.</summary>
partial struct WorldContacts : ISurfaceCallbacks<WorldContacts>
{
    public readonly SurfaceProperties GetSurface<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold)
        where TManifold : unmanaged, IContactManifold<TManifold> => new() { Restitution = restitution };
}
