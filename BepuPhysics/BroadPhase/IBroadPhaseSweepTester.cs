using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>Receives the collidables whose bounds a moving box meets.</summary>
public interface IBroadPhaseSweepTester
{
    /// <summary>Called on the querying thread for a collidable whose bounds are met before the present maximum.</summary>
    /// <param name="collidable">The collidable.</param>
    /// <param name="maximumT">Length of the sweep that is still of interest, in units of its direction; lower it to end the query
    /// sooner.</param>
    void Test(CollidableReference collidable, ref float maximumT);
}
