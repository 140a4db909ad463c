using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>What is to be done with a container, whatever its type.</summary>
interface IContainerUser
{
    /// <summary>Receives the container.</summary>
    void Use<TContainer>(in TContainer container) where TContainer : unmanaged, IContainer;
}

/// <summary>The types of shapes that are made of children.</summary>
static unsafe class ContainerTypes
{
    /// <summary>Hands a shape to its user, if it is made of children.</summary>
    /// <param name="typeId">Type of the shape.</param>
    /// <param name="shape">The shape.</param>
    /// <param name="user">Receives it.</param>
    /// <returns>Whether it is.</returns>
    public static bool TryUse<TUser>(int typeId, void* shape, ref TUser user) where TUser : struct, IContainerUser, allows ref struct
    {
        switch (typeId)
        {
            case Compound.Id:
                user.Use(*(Compound*)shape);
                return true;
            case BigCompound.Id:
                user.Use(*(BigCompound*)shape);
                return true;
            case Mesh.Id:
                user.Use(*(Mesh*)shape);
                return true;
            case HeightField.Id:
                user.Use(*(HeightField*)shape);
                return true;
            default:
                return false;
        }
    }
}
