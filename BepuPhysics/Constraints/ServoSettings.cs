using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>How fast and how hard a servo may move towards its target.</summary>
/// <param name="maximumSpeed">Greatest speed towards the target, m/s or rad/s; not negative.</param>
/// <param name="baseSpeed">Speed towards the target that is used however small the error, as long as it does not overshoot; not negative.</param>
/// <param name="maximumForce">Greatest force or torque, N or N m; not negative.</param>
public struct ServoSettings(float maximumSpeed, float baseSpeed, float maximumForce)
{
    /// <summary>Greatest speed towards the target, m/s or rad/s.</summary>
    public float MaximumSpeed = maximumSpeed;
    /// <summary>Speed towards the target that is used however small the error, as long as it does not overshoot.</summary>
    public float BaseSpeed = baseSpeed;
    /// <summary>Greatest force or torque, N or N m.</summary>
    public float MaximumForce = maximumForce;

    /// <summary>No limits.</summary>
    public static ServoSettings Default => new(float.MaxValue, 0, float.MaxValue);

    /// <summary>Whether the settings can be simulated: not NaN and not negative, and a base speed within <see cref="Limits"/>.</summary>
    public static bool Validate(in ServoSettings settings) =>
        settings.MaximumSpeed >= 0 && settings.BaseSpeed >= 0 && settings.MaximumForce >= 0 && settings.BaseSpeed <= Limits.MaximumServoBaseSpeed;
}

/// <summary>A bundle of <see cref="ServoSettings"/>.</summary>
public struct ServoSettingsWide : IWide<ServoSettings>
{
    /// <inheritdoc cref="ServoSettings.MaximumSpeed"/>
    public Vector<float> MaximumSpeed;
    /// <inheritdoc cref="ServoSettings.BaseSpeed"/>
    public Vector<float> BaseSpeed;
    /// <inheritdoc cref="ServoSettings.MaximumForce"/>
    public Vector<float> MaximumForce;
}
