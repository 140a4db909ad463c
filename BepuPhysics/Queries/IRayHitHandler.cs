using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;

namespace BepuPhysics;

/// <summary>Chooses what a ray may hit and receives the hits. Called on the thread that asked, in no particular order.</summary>
/// <remarks>A query ends sooner when the handler lowers the maximum: to the t of a hit for the nearest hit, to zero for any hit at all.</remarks>
public interface IRayHitHandler
{
    /// <summary>The ray hits a collidable within <paramref name="maximumT"/>.</summary>
    /// <param name="ray">The ray.</param>
    /// <param name="maximumT">Farthest t that is still of interest; lower it to hear of no farther hits.</param>
    /// <param name="t">Place of the hit: ray.Origin + ray.Direction * t; zero for a ray that starts inside.</param>
    /// <param name="normal">Unit normal that points out of the shape, in world axes.</param>
    /// <param name="collidable">What was hit.</param>
    /// <param name="childIndex">
    /// Number of the convex piece that was hit: of the triangle of a mesh, of the child of a compound, or, where that is made of children
    /// itself, what <see cref="Compound.FindPiece"/> takes apart; zero for a shape without children.
    /// </param>
    void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, CollidableReference collidable, int childIndex);

    /// <summary>Whether a collidable whose bounds the ray meets is to be tested.</summary>
    bool AllowTest(CollidableReference collidable);

    /// <summary>Whether a child of a collidable is to be tested; asked only for shapes that are made of children.</summary>
    /// <param name="collidable">The collidable.</param>
    /// <param name="childIndex">Number of the convex piece, as for hits.</param>
    bool AllowTest(CollidableReference collidable, int childIndex);
}
