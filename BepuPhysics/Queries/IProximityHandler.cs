using BepuPhysics.Collidables;

namespace BepuPhysics;

/// <summary>Chooses what is asked how near it is, and receives what is near. Called on the thread that asked, in no particular order.</summary>
public interface IProximityHandler
{
    /// <summary>Whether a collidable whose bounds are near is to be tested.</summary>
    bool AllowTest(CollidableReference collidable);

    /// <summary>Whether a child of a collidable is to be tested; asked only for shapes that are made of children.</summary>
    /// <param name="collidable">The collidable.</param>
    /// <param name="childIndex">Number of the convex piece, as <see cref="ISweepHitHandler"/> has it.</param>
    bool AllowTest(CollidableReference collidable, int childIndex);

    /// <summary>A collidable is no farther away than the maximum; called once for a collidable, with its nearest part.</summary>
    /// <param name="maximumDistance">
    /// Greatest distance that is still of interest, m. Lower it to a distance to hear of nothing farther; below zero ends the query.
    /// </param>
    /// <param name="proximity">How near it is.</param>
    void OnProximity(ref float maximumDistance, in Proximity proximity);
}
