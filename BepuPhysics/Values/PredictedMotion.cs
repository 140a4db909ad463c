using System.Numerics;

namespace BepuPhysics;

/// <summary>What a body with a shape is expected to do in the coming step, where a kinematic body moves.</summary>
struct PredictedMotion
{
    /// <summary>Part of what its acceleration moves a body in a step for which there is room at least.</summary>
    internal const float LeastFall = 0.5f;

    /// <summary>Velocity after a step of acceleration, m/s.</summary>
    public Vector3 Linear;
    /// <summary>What that has added, m/s.</summary>
    public float Gain;
    /// <summary>Angular velocity, rad/s.</summary>
    public Vector3 Angular;
    /// <summary>Distance of the farthest point of its shape from its centre, m.</summary>
    public float Radius;
    /// <summary>How far turning can carry its surface out of where it is, at most, m.</summary>
    public float Expansion;
    /// <summary>Length of the step, s.</summary>
    public float Dt;
    /// <summary>Which body it is; rows that nobody has written, or that are of a body that went, belong to nobody.</summary>
    public BodyHandle Body;
    /// <summary>Whether it is a kinematic body that moves.</summary>
    public bool Moves;
    /// <summary>How far its surroundings are known.</summary>
    public PredictedSurroundings Surroundings;
}

/// <summary>What may be met by what moves along with a body.</summary>
enum PredictedSurroundings : byte
{
    Unknown,
    Sought,
    /// <summary>Things that move along, and nothing else.</summary>
    MoveAlong,
    Others,
}
