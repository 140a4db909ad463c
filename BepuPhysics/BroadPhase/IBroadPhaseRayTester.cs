using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Receives the collidables whose bounds a ray meets.</summary>
public interface IBroadPhaseRayTester
{
    /// <summary>Called on the querying thread for a collidable whose bounds the ray meets before the present maximum.</summary>
    /// <param name="collidable">The collidable.</param>
    /// <param name="rayData">The ray.</param>
    /// <param name="maximumT">Length of the ray that is still of interest, in units of its direction; lower it to end the query
    /// sooner.</param>
    /// <param name="pool">The pool that the query was given.</param>
    unsafe void RayTest(CollidableReference collidable, RayData* rayData, float* maximumT, BufferPool pool);
}
