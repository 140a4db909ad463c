using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>How hard and how softly a motor holds its target velocity.</summary>
public struct MotorSettings
{
    /// <summary>Greatest force or torque, N or N m.</summary>
    public float MaximumForce;
    /// <summary>Force or torque per velocity error, the inverse of <see cref="Softness"/>.</summary>
    public float Damping;

    /// <summary>Inverse of the damping: 0 holds the velocity exactly within the force limit.</summary>
    public float Softness
    {
        readonly get => 1 / Damping;
        set => Damping = value <= 0 ? float.MaxValue : 1 / value;
    }

    /// <summary>Describes a motor.</summary>
    /// <param name="maximumForce">Greatest force or torque, N or N m; not negative.</param>
    /// <param name="softness">Velocity error per force; 0 holds the velocity exactly.</param>
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
    /// <inheritdoc cref="MotorSettings.MaximumForce"/>
    public Vector<float> MaximumForce;
    /// <inheritdoc cref="MotorSettings.Damping"/>
    public Vector<float> Damping;
}
