using System.Numerics;
using BepuPhysics.Collidables;

namespace BepuPhysics;

/// <summary>Chooses what a swept shape may hit and receives the hits. Called on the thread that asked, in no particular order.</summary>
/// <remarks>
/// A query ends sooner when the handler lowers the maximum: to the t of a hit for the nearest hit, to zero for any hit at all. Of hits at
/// the same t as the maximum a handler hears too.
/// </remarks>
public interface ISweepHitHandler
{
    /// <summary>Whether a collidable whose bounds the sweep meets is to be tested.</summary>
    bool AllowTest(CollidableReference collidable);

    /// <summary>Whether a child of a collidable is to be tested; asked only for shapes that are made of children.</summary>
    /// <param name="collidable">The collidable.</param>
    /// <param name="childIndex">
    /// Number of the convex piece: of the triangle of a mesh, of the child of a compound, or, where that is made of children itself, what
    /// <see cref="Compound.FindPiece"/> takes apart.
    /// </param>
    bool AllowTest(CollidableReference collidable, int childIndex);

    /// <summary>
    /// The swept shape touches a collidable first at a time within <paramref name="maximumT"/>; called once for a collidable.
    /// </summary>
    /// <param name="maximumT">Latest t that is still of interest; lower it to hear of no later hits.</param>
    /// <param name="t">Time of the hit, s: never later than the shapes touch.</param>
    /// <param name="hitLocation">Point on the surface of the collidable where it is touched, in the world, m.</param>
    /// <param name="hitNormal">Unit normal that points out of the collidable, towards the swept shape, in world axes.</param>
    /// <param name="collidable">What was hit.</param>
    void OnHit(ref float maximumT, float t, Vector3 hitLocation, Vector3 hitNormal, CollidableReference collidable);

    /// <summary>The swept shape overlaps or touches a collidable from the start, so that there is neither place nor normal.</summary>
    /// <param name="maximumT">Latest t that is still of interest; lower it to hear of no later hits.</param>
    /// <param name="collidable">What was hit.</param>
    void OnHitAtZeroT(ref float maximumT, CollidableReference collidable);
}
