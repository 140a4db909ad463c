namespace BepuPhysics.Collidables;

/// <summary>What is to be done with a container, whatever its type.</summary>
interface IContainerUser
{
    /// <summary>Receives the container.</summary>
    void Use<TContainer>(in TContainer container) where TContainer : unmanaged, IContainer;
}
