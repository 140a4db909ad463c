using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Stiffness and damping of a constraint, independent of the masses that it connects.</summary>
/// <remarks>
/// The default, all zero, is rigid: as stiff as the substep allows. A frequency that is given is kept up to that limit,
/// <see cref="JointCyclesPerSubstep"/> or <see cref="ContactCyclesPerSubstep"/>, beyond which the sweeps of a substep would add energy.
/// </remarks>
public struct SpringSettings
{
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

    /// <summary>Frequency of rigid joints in periods per substep; without relaxations, the upper limit of every joint's.</summary>
    /// <remarks>Joints of a dynamic body that has three or more of them take <see cref="ContactCyclesPerSubstep"/>, if that is less.</remarks>
    /// <param name="iterations">Sweeps per substep, at least 1.</param>
    /// <param name="relaxations">Sweeps without correction of position, at least 0.</param>
    public static float JointCyclesPerSubstep(int iterations, int relaxations = 0) => SubstepStiffness.JointCycles(iterations, relaxations);

    /// <summary>Frequency of rigid contacts in periods per substep; without relaxations, the upper limit of every contact's.</summary>
    /// <param name="iterations">Sweeps per substep, at least 1.</param>
    /// <param name="relaxations">Sweeps without correction of position, at least 0.</param>
    public static float ContactCyclesPerSubstep(int iterations, int relaxations = 0) => SubstepStiffness.ContactCycles(iterations, relaxations);

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

    /// <summary>Whether the settings can be simulated: not negative, and within <see cref="Limits"/>.</summary>
    public static bool Validate(in SpringSettings springSettings) =>
        springSettings.AngularFrequency >= 0 && springSettings.AngularFrequency <= Limits.MaximumSpringFrequency * MathF.Tau &&
        springSettings.TwiceDampingRatio >= 0 && springSettings.TwiceDampingRatio <= Limits.MaximumDampingRatio * 2;
}

/// <summary>A bundle of <see cref="SpringSettings"/>.</summary>
public struct SpringSettingsWide : IWide<SpringSettings>
{
    /// <inheritdoc cref="SpringSettings.AngularFrequency"/>
    public Vector<float> AngularFrequency;
    /// <inheritdoc cref="SpringSettings.TwiceDampingRatio"/>
    public Vector<float> TwiceDampingRatio;

    /// <summary>Coefficients of the implicit Euler step of the spring, or of its relaxation.</summary>
    /// <param name="substep">The substep, and what its present sweep is for.</param>
    /// <param name="limits">How stiff the kind of constraint may be in it.</param>
    // A damped spring  m a = -k x - c v  advanced implicitly over h is the velocity constraint
    //   v + ErrorToVelocity x + gamma lambda = 0,  ErrorToVelocity = h k / (h k + c),  gamma = 1 / (h (h k + c))  per unit effective mass.
    // With k = w^2, c = 2 z w:  ErrorToVelocity = w / (w h + 2 z),  gamma = 1 / (w h (w h + 2 z)).
    // Solved for the total impulse with effective mass M:  dl = -M MassScale (v + ErrorToVelocity x) - ImpulseScale lambda.
    //
    // Relaxation takes back the velocity that the correction of position has left behind, and is for what is meant to be rigid: C' = 0
    // without any softness. The velocity of a spring that a game asked for is no correction, and stays.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly SoftnessWide ForSubstep(in Substep substep, in SubstepStiffness limits) =>
        ForSubstep(substep, new Vector<float>(limits.RigidFrequencyDt), new Vector<float>(limits.GreatestFrequencyDt), swings: false, Vector<float>.Zero);

    /// <summary>Whether a game gave none of the lanes a frequency.</summary>
    internal readonly bool AreRigid
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Vector.EqualsAll(AngularFrequency, Vector<float>.Zero);
    }

    /// <summary>Coefficients of a spring that swings as its damping ratio says, or of its relaxation, where some lanes have limits of their own.</summary>
    /// <param name="substep">The substep, and what its present sweep is for.</param>
    /// <param name="limits">How stiff the kind of constraint may be in it.</param>
    /// <param name="rigid">The coefficients of what a game gave no frequency, by the same limits.</param>
    /// <param name="hubMask">Lanes of hubs, which have the limits of these besides.</param>
    /// <param name="coupling">See <see cref="AloneCoupling"/>.</param>
    // Nearly all joints are rigid, and what is the same for all of these needs not be worked out for each.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly SoftnessWide ForSubstep(
        in Substep substep, in SubstepStiffness limits, in RigidSoftness rigid, Vector<int> hubMask, Vector<float> coupling) =>
        AreRigid ? rigid.Widen(hubMask) : ForSubstep(
            substep,
            Least(limits.RigidFrequencyDt, substep.Hubs.RigidFrequencyDt, hubMask),
            Least(limits.GreatestFrequencyDt, substep.Hubs.GreatestFrequencyDt, hubMask),
            swings: true, coupling);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Least(float limit, float hubLimit, Vector<int> hubMask) =>
        Wide.Select(hubMask, Wide.Min(new Vector<float>(limit), new Vector<float>(hubLimit)), new Vector<float>(limit));

    // The implicit step hangs where it should, but damps what swings: by w h / 2 more than the damping ratio says. With s for ImpulseScale,
    // p = MassScale ErrorToVelocity h, and an acceleration g besides, a spring by itself goes on by
    //   h v' = s (h v + h^2 g) - p x,  x' = x + h v':   two substeps multiply what swings by  s = |eigenvalue|^2,  and it hangs at  s h^2 g / p.
    // To hang at g / w^2 takes p = (w h)^2 s, which leaves s: 1 / (1 + 2 z w h + c (w h)^2) with any c, of which the implicit step has c = 1. A swing that
    // keeps exp(-2 pi z / sqrt(1 - z^2)) of itself in each of its periods has c = z^2, to the order of (w h)^3, and periods that are longer by z w h / 2, as
    // they are by the implicit step. Three coefficients would give periods as well, but depend on the impulse before the first sweep (springs.md).
    //
    // At z = 1 that is the implicit step. At z = 0 it is an explicit one, which gains energy beyond w h = 2, and where n springs hold a body beyond
    // 2 / sqrt(n). So c goes to 1 before that, with the eighth power of w h.
    /// <summary>Root of the number of springs on a body with which those of a joint swing safely: where few others are.</summary>
    internal const float AloneCoupling = 1;
    /// <summary>The same where there may be many.</summary>
    internal const float HubCoupling = 4;
    /// <summary>The same for what takes the implicit step, whatever its damping ratio.</summary>
    internal const float ImplicitCoupling = float.PositiveInfinity;
    // An undamped spring would have a MassScale of zero to divide by. So it loses a thousandth of the implicit step's.
    const float LeastStepPart = 1f / 1024;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly SoftnessWide ForSubstep(
        in Substep substep, Vector<float> rigidFrequencyDt, Vector<float> greatestFrequencyDt, bool swings, Vector<float> coupling)
    {
        var given = AngularFrequency * substep.Dt;
        var rigid = Vector.Equals(given, Vector<float>.Zero);
        if (substep.IsRelaxation)
            return new() { MassScale = Wide.Mask(rigid, Vector<float>.One) };
        var frequencyDt = Vector.ConditionalSelect(rigid, rigidFrequencyDt, Wide.Min(given, greatestFrequencyDt));
        var damping = Vector.ConditionalSelect(rigid, new Vector<float>(2), TwiceDampingRatio);
        var sum = frequencyDt + damping;
        if (swings)
        {
            var coupled = frequencyDt * coupling;
            coupled *= coupled;
            coupled *= coupled;
            var part = Wide.Max(damping * damping * new Vector<float>(0.25f), coupled * coupled + new Vector<float>(LeastStepPart));
            sum = frequencyDt * Wide.Min(part, Vector<float>.One) + damping;
        }
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
