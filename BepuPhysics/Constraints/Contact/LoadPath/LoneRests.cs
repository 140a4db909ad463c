using System.Numerics;

namespace BepuPhysics.Constraints.Contact;

/// <summary>What a block has found that rests alone on what nothing pushes, and is none of the graph's.</summary>
unsafe struct LoneRests
{
    /// <summary>Whether contacts of any are held.</summary>
    public bool AreHeld;
    /// <summary>Those that rest on a floor whose velocities a game has changed, with room for all.</summary>
    public FloorRider* Riders;
    /// <summary>Number of these.</summary>
    public int RiderCount;
}

/// <summary>A body that rests alone on a floor whose velocities a game has changed since the last step.</summary>
struct FloorRider
{
    /// <summary>Index in the active set.</summary>
    public int Body;
    /// <summary>Index of the kinematic body.</summary>
    public int Floor;
    /// <summary>What has changed of the floor's velocity, where the body is, m/s.</summary>
    public Vector3 FloorChange;
    /// <summary>What has changed of its angular velocity, rad/s.</summary>
    public Vector3 FloorTurnChange;
}
