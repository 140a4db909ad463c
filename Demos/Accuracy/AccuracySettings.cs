using System.Globalization;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Constraints;
using Demos.Engine;
using Demos.Running;

namespace Demos.Accuracy;

/// <summary>Who may touch whom in a world of the suite.</summary>
enum ContactScope
{
    All,
    None,
}

/// <summary>How a world of the suite is simulated.</summary>
sealed record AccuracySettings
{
    public float Dt { get; init; } = 1 / 60f;
    public int SubstepCount { get; init; } = EngineTraits.DefaultSubstepCount;
    public int VelocityIterationCount { get; init; } = EngineTraits.DefaultVelocityIterationCount;
    public int RelaxationCount { get; init; }

    /// <summary>Whether loads are handed down to the ground in one go.</summary>
    public LoadPathChoice LoadPath { get; init; } = EngineDefaults.LoadPath;

    /// <summary>Whether all joints of a structure are solved at once.</summary>
    public DirectJointsChoice DirectJoints { get; init; } = EngineDefaults.DirectJoints;
    public Vector3 Gravity { get; init; } = new(0, -9.81f, 0);
    public float Friction { get; init; } = .5f;
    public float Restitution { get; init; }

    /// <summary>Fastest way out of an overlap, in metres per second.</summary>
    public float MaximumRecoveryVelocity { get; init; } = 2;
    public AngularIntegrationMode AngularMode { get; init; } = EngineTraits.DefaultAngularMode;

    /// <summary>Substeps for bodies that touch nothing, too.</summary>
    public bool SubstepsForFreeBodies { get; init; } = EngineTraits.DefaultSubstepsForFreeBodies;
    public bool Stiff { get; init; }

    /// <summary>Whether what is stiff is stiffer where a substep has more sweeps, in an engine that leaves that to the game.</summary>
    public bool SpringFollowsSweeps { get; init; }

    /// <summary>Frequency of contacts and joints, Hz; null for what <see cref="Stiff"/> says.</summary>
    public float? SpringFrequency { get; init; }
    public ContactScope Contacts { get; init; } = ContactScope.All;

    public float SubstepDuration => Dt / SubstepCount;

    public SpringSettings Spring => SpringFrequency is float hertz ? new(hertz, 1)
        : Stiff ? EngineTraits.RigidSpring(this) : EngineTraits.DefaultSpring(SubstepDuration);

    /// <summary>Settings of an effort; cases change what they are about.</summary>
    public static AccuracySettings For(Effort effort) => effort == Effort.Default
        ? new()
        : new()
        {
            SubstepCount = 16,
            RelaxationCount = EngineTraits.AccurateRelaxationCount,
            AngularMode = EngineTraits.AccurateAngularMode,
            SubstepsForFreeBodies = true,
            Stiff = true,
        };

    public override string ToString() =>
        string.Create(CultureInfo.InvariantCulture,
            $"s{SubstepCount} i{VelocityIterationCount}{RelaxationWord}{LoadPathWords}{JointWord}{(Stiff ? " stiff" : "")}");

    string RelaxationWord => RelaxationCount > 0 ? string.Create(CultureInfo.InvariantCulture, $" r{RelaxationCount}") : "";

    string JointWord => DirectJoints switch
    {
        _ when DirectJoints == EngineDefaults.DirectJoints => "",
        DirectJointsChoice.Off => " swept",
        DirectJointsChoice.Always => " direct",
        _ => " direct where needed",
    };

    string LoadPathWords => LoadPath == EngineDefaults.LoadPath ? "" : $" load path {LoadPath}";
}
