using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>How a floor moves in a substep: to who moves along with it, everything on it is at rest.</summary>
/// <param name="linear">Velocity of its centre, m/s.</param>
/// <param name="angular">Its angular velocity, rad/s.</param>
/// <param name="center">Its centre, m.</param>
/// <param name="halfStep">Half of the substep, s: what goes round is taken along by what the floor does under it in the middle of the substep.</param>
readonly struct FloorMotion(Vector3 linear, Vector3 angular, Vector3 center, float halfStep)
{
    /// <summary>Angular velocity of all that moves along, rad/s.</summary>
    internal Vector3 Angular => angular;

    /// <summary>Velocity of what moves along at a place, m/s.</summary>
    internal Vector3 At(Vector3 place)
    {
        if (angular == default)
            return linear;
        var along = Exact.Cross(angular, place - center);
        return linear + (along + Exact.Cross(angular, along) * halfStep);
    }
}
