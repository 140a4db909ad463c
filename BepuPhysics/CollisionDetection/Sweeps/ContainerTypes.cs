using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>The types of shapes that are made of children.</summary>
static unsafe class ContainerTypes
{
    /// <summary>Hands a shape to its user, if it is made of children.</summary>
    /// <param name="typeId">Type of the shape.</param>
    /// <param name="shape">The shape.</param>
    /// <param name="shapes">Shapes that there are, of a game's own types too.</param>
    /// <param name="user">Receives it.</param>
    /// <returns>Whether it is.</returns>
    public static bool TryUse<TUser>(int typeId, void* shape, Shapes shapes, ref TUser user) where TUser : struct, IContainerUser, allows ref struct
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
                return typeId > ShapeLimits.LastTypeId && TryUseOwn(typeId, shape, shapes, ref user);
        }
    }

    static bool TryUseOwn<TUser>(int typeId, void* shape, Shapes shapes, ref TUser user) where TUser : struct, IContainerUser, allows ref struct
    {
        if (shapes.FindBatch(typeId) is not IHomogeneousBatch batch)
            return false;
        batch.Use(shape, ref user);
        return true;
    }
}
