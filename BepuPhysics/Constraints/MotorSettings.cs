using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>How hard and how softly a motor holds its target velocity.</summary>
public struct MotorSettings
{
    /// <summary>Greatest force or torque, N or N m; not negative. Of a motor with several rows, of all together.</summary>
    public float MaximumForce;
    /// <summary>Acceleration per velocity error, 1/s, the inverse of <see cref="Softness"/>; not negative.</summary>
    /// <remarks>It counts per effective mass: for a damping of D N s/m on a free body of mass m it is D / m.</remarks>
    public float Damping;

    /// <summary>Velocity error per acceleration, s, the inverse of the damping: 0 holds the velocity exactly within the force limit.</summary>
    /// <remarks>Against a load F on an effective mass m the velocity stays behind by the softness times F / m.</remarks>
    public float Softness
    {
        readonly get => 1 / Damping;
        set => Damping = value <= 0 ? float.MaxValue : 1 / value;
    }

    /// <summary>Describes a motor.</summary>
    /// <param name="maximumForce">Greatest force or torque, N or N m; not negative.</param>
    /// <param name="softness">Velocity error per acceleration, s; 0 holds the velocity exactly.</param>
    public MotorSettings(float maximumForce, float softness)
    {
        MaximumForce = maximumForce;
        Softness = softness;
    }

    /// <summary>Whether the settings can be simulated: not NaN and not negative.</summary>
    public static bool Validate(in MotorSettings settings) => settings.MaximumForce >= 0 && settings.Damping >= 0;
}

/// <summary>A bundle of <see cref="MotorSettings"/>.</summary>
public struct MotorSettingsWide : IWide<MotorSettings>
{
    // Beyond, the softness is less than rounding; without a bound an infinite one would be divided by itself.
    const float GreatestDampingDt = 1e15f;

    /// <inheritdoc cref="MotorSettings.MaximumForce"/>
    public Vector<float> MaximumForce;
    /// <inheritdoc cref="MotorSettings.Damping"/>
    public Vector<float> Damping;

    /// <summary>Coefficients of the implicit Euler step of the damper.</summary>
    /// <param name="substep">The substep.</param>
    // A damper between velocity v and target u pushes with f = M d (u - v), M = K^-1 the effective mass. Advanced implicitly over h, its impulse is
    //   lambda = h M d (u - v+),  so that  v+ + gamma K lambda = u,  gamma = 1 / (h d).
    // In a sweep v already has the impulse lambda that was accumulated, and v+ = v + K dl for a change dl:
    //   (1 + gamma) K dl = u - v - gamma K lambda,  so  dl = M MassScale (u - v) - ImpulseScale lambda
    // with MassScale = 1 / (1 + gamma) = h d / (h d + 1) and ImpulseScale = gamma / (1 + gamma) = 1 - MassScale.
    // Without damping MassScale is 0 and ImpulseScale 1: what was accumulated is taken back.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly SoftnessWide ForSubstep(in Substep substep)
    {
        var product = Wide.Min(Damping * substep.Dt, new Vector<float>(GreatestDampingDt));
        SoftnessWide softness;
        softness.MassScale = product / (product + Vector<float>.One);
        softness.ImpulseScale = Vector<float>.One - softness.MassScale;
        softness.ErrorToVelocity = Vector<float>.Zero;
        return softness;
    }
}
