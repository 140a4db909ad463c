using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuUtilities;
using Xunit;

namespace DemoTests.Robustness;

/// <summary>When a number goes wrong.</summary>
public enum MishapMoment
{
    BetweenSteps,
    BeforeCollisionDetection,
    CollisionsDetected,
    FirstSubstepStarts,
    LaterSubstepStarts,
    SubstepEnds,
    LastSubstepEnds,
    StepEnds,
    Callback,
}

/// <summary>Writes what cannot be simulated to one body, at one moment.</summary>
sealed class Mishap(MishapMoment moment, string harm)
{
    public const int Substeps = 4;

    static readonly Dictionary<string, Harm> harms = new()
    {
        ["position NaN"] = (ref m) => m.Pose.Position.Y = float.NaN,
        ["position infinite"] = (ref m) => m.Pose.Position.X = float.NegativeInfinity,
        ["position huge"] = (ref m) => m.Pose.Position.Z = 1e30f,
        ["orientation NaN"] = (ref m) => m.Pose.Orientation.W = float.NaN,
        ["orientation zero"] = (ref m) => m.Pose.Orientation = default,
        ["linear NaN"] = (ref m) => m.Velocity.Linear = new Vector3(float.NaN),
        ["linear infinite"] = (ref m) => m.Velocity.Linear.X = float.PositiveInfinity,
        ["linear huge"] = (ref m) => m.Velocity.Linear.X = float.MaxValue,
        ["angular NaN"] = (ref m) => m.Velocity.Angular.Z = float.NaN,
        ["angular infinite"] = (ref m) => m.Velocity.Angular.Y = float.PositiveInfinity,
        ["angular huge"] = (ref m) => m.Velocity.Angular.Y = -1e25f,
        ["all"] = (ref m) => System.Runtime.InteropServices.MemoryMarshal.CreateSpan(ref m.Pose.Orientation.X, 16).Fill(float.NaN),
    };

    public delegate void Harm(ref MotionState motion);

    public static TheoryData<MishapMoment, string> All
    {
        get
        {
            var data = new TheoryData<MishapMoment, string>();
            foreach (var moment in Enum.GetValues<MishapMoment>())
            {
                foreach (var harm in harms.Keys)
                {
                    // A callback has velocities only to write to.
                    if (moment != MishapMoment.Callback || harm[0] is 'l' || harm.StartsWith("an", StringComparison.Ordinal))
                        data.Add(moment, harm);
                }
            }
            return data;
        }
    }

    public bool Armed { get; set; }

    public BodyReference Target { get; set; }

    /// <summary>How often it happened.</summary>
    public int Count { get; private set; }

    public void Pass(MishapMoment here)
    {
        if (!Armed || here != moment)
            return;
        ++Count;
        harms[harm](ref Target.MotionState);
    }

    public void PassCallback(Vector<int> bodyIndices, ref BodyVelocityWide velocity)
    {
        if (!Armed || moment != MishapMoment.Callback)
            return;
        for (int i = 0; i < Vector<int>.Count; ++i)
        {
            if (bodyIndices[i] != Target.MemoryLocation.Index)
                continue;
            ++Count;
            var motion = new MotionState
            {
                Velocity = new(
                    Lanes.Read<Vector3, Vector3Wide>(ref velocity.Linear, i), Lanes.Read<Vector3, Vector3Wide>(ref velocity.Angular, i)),
            };
            harms[harm](ref motion);
            Lanes.Write(motion.Velocity.Linear, ref velocity.Linear, i);
            Lanes.Write(motion.Velocity.Angular, ref velocity.Angular, i);
        }
    }
}

/// <summary>Gravity but for a mishap.</summary>
struct MishapGravity(Mishap mishap) : IPoseIntegratorCallbacks
{
    Vector<float> change;

    public readonly AngularIntegrationMode AngularIntegrationMode => AngularIntegrationMode.ConserveMomentumWithGyroscopicTorque;

    public readonly bool AllowSubstepsForUnconstrainedBodies => true;

    public readonly bool IntegrateVelocityForKinematics => false;

    public readonly void Initialize(Simulation simulation)
    {
    }

    public void PrepareForIntegration(float dt) => change = new Vector<float>(-10 * dt);

    public readonly void IntegrateVelocity(
        Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia,
        Vector<int> integrationMask, int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity)
    {
        velocity.Linear.Y += change;
        mishap.PassCallback(bodyIndices, ref velocity);
    }
}
