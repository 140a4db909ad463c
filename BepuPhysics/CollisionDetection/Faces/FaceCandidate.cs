using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>A corner of the overlap of two features.</summary>
struct FaceCandidate
{
    /// <summary>Depth of a corner that does not exist.</summary>
    public const float None = -float.MaxValue;

    /// <summary>Place across the normal, from the witness, m.</summary>
    public Vector<float> X, Y;
    /// <summary>Depth along the normal, m; <see cref="None"/> where there is no such corner.</summary>
    public Vector<float> Depth;
    /// <summary>Tells the corners of an overlap apart; eight bits.</summary>
    public Vector<int> Name;
    /// <summary>What squared distances count by: more where the corner was one of the first two contacts the last time.</summary>
    public Vector<float> Weight;
}
