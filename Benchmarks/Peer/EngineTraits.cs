using System;
using BepuPhysics;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using Demos.Scenes;

namespace Demos.Accuracy;

/// <summary>What the accuracy suite and the trade know about bepuphysics2.</summary>
static class EngineTraits
{
    public const int DefaultSubstepCount = 4;
    public const int DefaultVelocityIterationCount = 1;
    public const int AccurateRelaxationCount = 0;
    public const bool HasRelaxation = false;
    public const bool HasLoadPath = false;
    public const bool HasDirectJoints = false;

    /// <summary>As in the callbacks of its demos.</summary>
    public const AngularIntegrationMode DefaultAngularMode = AngularIntegrationMode.Nonconserving;

    /// <summary>As in the callbacks of its demos.</summary>
    public const bool DefaultSubstepsForFreeBodies = false;
    public const AngularIntegrationMode AccurateAngularMode = AngularIntegrationMode.ConserveMomentum;

    /// <summary>That of its demos, Hz.</summary>
    const float DefaultFrequency = 30;

    public static SpringSettings DefaultSpring(float substepDuration) => new(DefaultFrequency, 1);

    /// <summary>
    /// An eighth of a period per substep, since what is stiffer gains energy at unequal masses; and as much for each further sweep where that is asked for.
    /// </summary>
    public static SpringSettings RigidSpring(AccuracySettings settings)
    {
        float cycles = settings.SpringFollowsSweeps ? Math.Min(0.125f * settings.VelocityIterationCount, 0.5f) : 0.125f;
        return new SpringSettings(Math.Max(DefaultFrequency, cycles / settings.SubstepDuration), 1);
    }

    /// <summary>
    /// Stiffness is the game's to choose there, so all are tried: what its demos have, what a substep of one sweep holds, and what follows the sweeps as
    /// this library's rigid contacts and joints do.
    /// </summary>
    public static string[] TradedSprings => ["default", "rigid", "swept"];

    /// <summary>Its default is its cheapest.</summary>
    public static string[] TradedModes => ["default"];

    public static SolveDescription Solve(AccuracySettings settings) =>
        settings is { RelaxationCount: 0, LoadPath: Running.LoadPathChoice.Off, DirectJoints: Running.DirectJointsChoice.Off }
            ? new(settings.VelocityIterationCount, settings.SubstepCount)
            : throw new SceneException("this engine has neither relaxation sweeps nor a load path nor direct joints");

    /// <summary>It has no coefficient of restitution; its way to bounce is a spring without damping.</summary>
    public static WorldContacts Contacts(AccuracySettings settings)
    {
        SpringSettings spring = settings.Spring;
        if (settings.Restitution > 0)
            spring.DampingRatio = 1 - settings.Restitution;
        var material = new PairMaterialProperties(settings.Friction, settings.MaximumRecoveryVelocity, spring);
        return new WorldContacts(material, settings.Contacts, settings.Restitution);
    }
}

/// <summary>What the callbacks of the suite are told and this engine cannot use.</summary>
partial struct WorldContacts
{
    /// <summary>Coefficient that the spring stands in for.</summary>
    public readonly float Restitution => restitution;
}
