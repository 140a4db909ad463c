namespace BepuPhysics.CollisionDetection;

/// <summary>Two shapes that touch, of a body and of something that it has to agree on with others.</summary>
struct SeamChild
{
    /// <summary>What was found for them, in the frame of A.</summary>
    public ChildResult Result;
    /// <summary>The shapes and where they are.</summary>
    public PlacedChildren Placed;
    /// <summary>As <see cref="RankedChild.Class"/>.</summary>
    public int Class;
}
