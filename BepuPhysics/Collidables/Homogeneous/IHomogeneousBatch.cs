namespace BepuPhysics.Collidables;

/// <summary>What can be asked of a batch of shapes of a game's own that are made of children, without knowing their type.</summary>
unsafe interface IHomogeneousBatch
{
    /// <summary>Hands a shape of the type to its user, which knows it as a container.</summary>
    /// <param name="shape">The shape, which need not be in the batch.</param>
    /// <param name="user">Receives it.</param>
    void Use<TUser>(void* shape, ref TUser user) where TUser : struct, IContainerUser, allows ref struct;
}
