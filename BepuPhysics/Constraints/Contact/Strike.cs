using System.Numerics;

namespace BepuPhysics.Constraints.Contact;

/// <summary>What the impacts of a substep have made of a body.</summary>
struct Strike
{
    /// <summary>What its velocity has gained, m/s.</summary>
    public Vector3 Change;
    /// <summary>When the last one was, s from the beginning of the substep; zero without any.</summary>
    public float Time;

    /// <summary>Adds an impact.</summary>
    public void Add(in Vector3 change, float time)
    {
        Change += change;
        Time = time;
    }
}
