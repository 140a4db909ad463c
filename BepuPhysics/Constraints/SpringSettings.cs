using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Stiffness and damping of a constraint, independent of the masses that it connects.</summary>
/// <remarks>
/// The default, all zero, is rigid: as stiff as the substep allows. A frequency that is given is kept up to that limit,
/// <see cref="CyclesPerSubstep"/> periods per substep, beyond which the sweeps of a substep would add energy.
/// </remarks>
public struct SpringSettings
{
    const float CyclesPerIteration = 0.125f;
    const float MaximumCycles = 0.5f;

    /// <summary>Undamped angular frequency, rad/s; 0 for rigid.</summary>
    public float AngularFrequency;
    /// <summary>Twice the damping ratio; unused when rigid, which is critically damped.</summary>
    public float TwiceDampingRatio;

    /// <summary>As stiff as the substep allows, critically damped.</summary>
    public static SpringSettings Rigid => default;

    /// <summary>Describes a spring.</summary>
    /// <param name="frequency">Undamped frequency, Hz; above 0.</param>
    /// <param name="dampingRatio">Ratio to critical damping: 0 swings for ever, 1 returns fastest without overshoot; not negative.</param>
    public SpringSettings(float frequency, float dampingRatio)
    {
        AngularFrequency = frequency * MathF.Tau;
        TwiceDampingRatio = dampingRatio * 2;
    }

    /// <summary>Frequency of the rigid default, and upper limit of every frequency, times the length of a substep.</summary>
    /// <param name="iterations">Sweeps per substep, at least 1.</param>
    // 0.125 is stable with one sweep per substep and no relaxation; 0.25 gains energy at mass ratios of 100, and an exactly
    // straight chain diverges there. Each further sweep moves a load over one more constraint. Beyond half a period per substep
    // an implicit spring has no stiffness left to gain.
    public static float CyclesPerSubstep(int iterations) => MathF.Min(CyclesPerIteration * iterations, MaximumCycles);

    /// <summary>Undamped frequency, Hz; 0 for rigid.</summary>
    public float Frequency
    {
        readonly get => AngularFrequency / MathF.Tau;
        set => AngularFrequency = value * MathF.Tau;
    }

    /// <summary>Ratio to critical damping.</summary>
    public float DampingRatio
    {
        readonly get => TwiceDampingRatio * 0.5f;
        set => TwiceDampingRatio = value * 2;
    }

    /// <summary>Whether the settings can be simulated: finite and not negative.</summary>
    public static bool Validate(in SpringSettings settings) =>
        float.IsFinite(settings.AngularFrequency) && float.IsFinite(settings.TwiceDampingRatio) &&
        settings.AngularFrequency >= 0 && settings.TwiceDampingRatio >= 0;
}

/// <summary>A bundle of <see cref="SpringSettings"/>.</summary>
public struct SpringSettingsWide : IWide<SpringSettings>
{
    /// <inheritdoc cref="SpringSettings.AngularFrequency"/>
    public Vector<float> AngularFrequency;
    /// <inheritdoc cref="SpringSettings.TwiceDampingRatio"/>
    public Vector<float> TwiceDampingRatio;

    /// <summary>Coefficients of the implicit Euler step of the spring.</summary>
    // A damped spring  m a = -k x - c v  advanced implicitly over h is the velocity constraint
    //   v + ErrorToVelocity x + gamma lambda = 0,  ErrorToVelocity = h k / (h k + c),  gamma = 1 / (h (h k + c))  per unit effective mass.
    // With k = w^2, c = 2 z w:  ErrorToVelocity = w / (w h + 2 z),  gamma = 1 / (w h (w h + 2 z)).
    // Solved for the total impulse with effective mass M:  dl = -M MassScale (v + ErrorToVelocity x) - ImpulseScale lambda.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly SoftnessWide ForSubstep(in Substep substep)
    {
        var stiffest = new Vector<float>(substep.StiffestFrequencyDt);
        var given = AngularFrequency * substep.Dt;
        var rigid = Vector.Equals(given, Vector<float>.Zero);
        var frequencyDt = Vector.ConditionalSelect(rigid, new Vector<float>(substep.RigidFrequencyDt), Wide.Min(given, stiffest));
        var sum = frequencyDt + Vector.ConditionalSelect(rigid, new Vector<float>(2), TwiceDampingRatio);
        var product = frequencyDt * sum;
        SoftnessWide softness;
        softness.MassScale = product / (product + Vector<float>.One);
        softness.ImpulseScale = Vector<float>.One - softness.MassScale;
        softness.ErrorToVelocity = frequencyDt * substep.InverseDt / sum;
        return softness;
    }
}

/// <summary>Coefficients that turn a rigid velocity constraint into a damped spring for one substep.</summary>
public struct SoftnessWide
{
    /// <summary>Velocity that is wanted per unit of position error, 1/s.</summary>
    public Vector<float> ErrorToVelocity;
    /// <summary>Factor on the effective mass.</summary>
    public Vector<float> MassScale;
    /// <summary>Factor on the accumulated impulse.</summary>
    public Vector<float> ImpulseScale;
}
