using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;

namespace BepuPhysics;

/// <summary>Chooses what a shape may touch, and receives the contacts. Called on the thread that asked, in no particular order.</summary>
public interface IShapeContactHandler
{
    /// <summary>Whether a collidable whose bounds are near is to be tested.</summary>
    bool AllowTest(CollidableReference collidable);

    /// <summary>Whether a child of a collidable is to be tested; asked only for shapes that are made of children.</summary>
    /// <param name="collidable">The collidable.</param>
    /// <param name="childIndex">Number of the convex piece, as <see cref="ISweepHitHandler"/> has it.</param>
    bool AllowTest(CollidableReference collidable, int childIndex);

    /// <summary>The shape has contacts with a collidable; called once for a collidable that it has any with.</summary>
    /// <param name="collidable">The collidable.</param>
    /// <param name="manifold">
    /// The contacts, as a step would have them: offsets from the position of the shape, normals out of the collidable, depths that are negative
    /// within the margin.
    /// </param>
    void OnContacts<TManifold>(CollidableReference collidable, ref TManifold manifold)
        where TManifold : unmanaged, IContactManifold<TManifold>;
}
