using System.Numerics;
using BepuPhysics.Trees;

namespace BepuPhysics;

/// <summary>Receives the hits of a ray on one shape. Called on the thread that asked.</summary>
public interface IShapeRayHitHandler
{
    /// <summary>Whether a child of the shape is to be tested; only shapes that are made of children ask.</summary>
    /// <param name="childIndex">Number of the convex piece, as for hits.</param>
    bool AllowTest(int childIndex);

    /// <summary>The ray hits within <paramref name="maximumT"/>.</summary>
    /// <param name="ray">The ray.</param>
    /// <param name="maximumT">Farthest t that is still of interest; lower it to hear of no farther hits.</param>
    /// <param name="t">Place of the hit: ray.Origin + ray.Direction * t; zero for a ray that starts inside.</param>
    /// <param name="normal">Unit normal that points out of the shape, in world axes.</param>
    /// <param name="childIndex">
    /// Number of the convex piece that was hit: of the triangle of a mesh, of the child of a compound, or, where that is made of children
    /// itself, what <see cref="Collidables.Compound.FindPiece"/> takes apart; zero for a shape without children.
    /// </param>
    void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, int childIndex);
}
