namespace BepuPhysics;

/// <summary>What a simulation can bear: values beyond are refused where they are given.</summary>
/// <remarks>
/// Within these, any combination of values gives a state of numbers, by a scan over random combinations (<c>LimitsTests</c>). That does not mean
/// that each gives a good simulation: floats have seven digits, so that 10,000 km from the origin a body is placed to the metre.
/// </remarks>
public static class Limits
{
    /// <summary>Greatest coordinate of a position, m.</summary>
    public const float MaximumPosition = 1e9f;
    /// <summary>Greatest component of a linear velocity, m/s.</summary>
    public const float MaximumLinearVelocity = 1e7f;
    /// <summary>Greatest component of an angular velocity, rad/s.</summary>
    public const float MaximumAngularVelocity = 1e7f;
    /// <summary>Square of the greatest distance from the origin, m, and of the greatest speeds, m/s and rad/s, that count as sound.</summary>
    // Above what a game may describe, and far below overflow.
    internal const float GreatestSoundSquare = 1e25f;
    /// <summary>Least mass of a body, kg.</summary>
    public const float MinimumMass = 1e-9f;
    /// <summary>Greatest mass of a body, kg; zero inverse mass is that of a body which nothing moves.</summary>
    public const float MaximumMass = 1e12f;
    /// <summary>Greatest entry of an inverse inertia tensor, 1/(kg m2).</summary>
    // A ball of a micrometre's radius and of the least mass has 2.5e21.
    public const float MaximumInverseInertia = 1e22f;
    /// <summary>Least sum of the diagonal of an inverse inertia tensor that is not zero, 1/(kg m2).</summary>
    // The greatest ball of the greatest mass has 7.5e-26; products of smaller ones lose their digits below the least normal float.
    public const float MinimumInverseInertia = 1e-28f;
    /// <summary>Least radius or half extent of a shape, m.</summary>
    public const float MinimumSize = 1e-6f;
    /// <summary>Greatest radius or half extent of a shape, m.</summary>
    public const float MaximumSize = 1e7f;
    /// <summary>Greatest coordinate of a point in the frame of a body, such as the anchor of a joint, m.</summary>
    public const float MaximumOffset = 1e7f;
    /// <summary>Greatest distance that a joint may demand, m; areas and volumes are at most its square and its cube.</summary>
    public const float MaximumDistance = 1e8f;
    /// <summary>Greatest angle of a joint, radians: beyond, neighbouring floats are no angles any more.</summary>
    public const float MaximumAngle = 1e5f;
    /// <summary>Greatest ratio of a gear, either way.</summary>
    public const float MaximumGearRatio = 1e4f;
    /// <summary>Greatest speculative margin that may be asked for as the least one, m.</summary>
    public const float MaximumMinimumSpeculativeMargin = 1e7f;
    /// <summary>Greatest component of an impulse, N s; of its arm, m; of a ray's direction.</summary>
    public const float MaximumImpulse = 1e15f;
    /// <summary>Shortest step, s.</summary>
    public const float MinimumTimestep = 1e-7f;
    /// <summary>Longest step, s: far beyond what any step can simulate. Those who ask for more mean milliseconds.</summary>
    public const float MaximumTimestep = 1;
    /// <summary>Greatest frequency of a spring, Hz.</summary>
    public const float MaximumSpringFrequency = 1e9f;
    /// <summary>Greatest damping ratio of a spring.</summary>
    public const float MaximumDampingRatio = 1e6f;
    /// <summary>Greatest base speed of a servo, m/s or rad/s; its greatest speed and force may be as large as they like.</summary>
    public const float MaximumServoBaseSpeed = 1e7f;
}
