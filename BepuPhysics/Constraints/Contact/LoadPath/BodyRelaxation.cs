using System.Runtime.Intrinsics;

namespace BepuPhysics.Constraints.Contact;

/// <summary>A body as rounds of a relaxation see it.</summary>
struct BodyRelaxation
{
    /// <summary>Velocity, m/s, to the floor on which the island rests.</summary>
    public Vector128<float> Linear;
    /// <summary>Angular velocity to that floor, rad/s.</summary>
    public Vector128<float> Angular;
    /// <summary>Both before the present round.</summary>
    public Vector128<float> StartLinear, StartAngular;
    /// <summary>What the direction in which the next round goes on changes of them: as impulses change velocities, so do directions.</summary>
    public Vector128<float> DirectionLinear, DirectionAngular;

    /// <summary>Begins the first round.</summary>
    internal void Begin()
    {
        (StartLinear, StartAngular) = (Linear, Angular);
        DirectionLinear = DirectionAngular = default;
    }

    /// <summary>Goes on by a share of the direction of the rounds before, and takes what this round has changed into the direction.</summary>
    internal void Follow(Vector128<float> share)
    {
        RowLanes.Follow(ref Linear, ref StartLinear, ref DirectionLinear, share);
        RowLanes.Follow(ref Angular, ref StartAngular, ref DirectionAngular, share);
    }
}
