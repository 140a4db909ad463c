namespace BepuPhysics.Collidables;

/// <summary>How a collidable moves.</summary>
public enum CollidableMobility
{
    /// <summary>A body that forces and contacts move.</summary>
    Dynamic = 0,
    /// <summary>A body that keeps the velocity it was given; nothing pushes it.</summary>
    Kinematic = 1,
    /// <summary>Never moves by itself.</summary>
    Static = 2,
}
