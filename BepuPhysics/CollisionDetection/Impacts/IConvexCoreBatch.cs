namespace BepuPhysics.CollisionDetection;

/// <summary>What can be asked of a batch of convex shapes of a game's own, without knowing their type.</summary>
unsafe interface IConvexCoreBatch
{
    /// <summary>The core of a shape of the type, which need not be in the batch and stays where it is as long as the core is used.</summary>
    ImpactCore CoreOf(void* shape);
}
