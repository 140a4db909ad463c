using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;

namespace BepuPhysics;

/// <summary>Keeps the nearest hits of a ray in the order of <see cref="RayHit.ComesBefore"/>, as many as there is room for.</summary>
/// <param name="memory">Room for the hits.</param>
/// <param name="capacity">How many, one at least.</param>
/// <param name="maximumT">Length of the ray.</param>
unsafe struct NearestRayHits(RayHit* memory, int capacity, float maximumT) : IRayHitHandler
{
    // The time at which a ray meets the bounds of a shape is rounded otherwise than that at which it meets the shape, by two ulps at most on
    // each side: to hear of all that are hit at the very same time, the search goes on by this.
    const float Slack = 1 + 4 * 1.1920929e-7f;

    public int Count { get; private set; }

    public readonly bool AllowTest(CollidableReference collidable) => true;

    public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

    public void OnRayHit(in RayData ray, ref float farthest, float t, Vector3 normal, CollidableReference collidable, int childIndex)
    {
        var hit = new RayHit
        {
            Collidable = collidable,
            ChildIndex = childIndex,
            T = t,
            Place = ray.Origin + ray.Direction * t,
            Normal = normal,
        };
        if (Count == capacity && !hit.ComesBefore(memory[Count - 1]))
            return;
        var place = Count < capacity ? Count++ : Count - 1;
        // Near hits come first for the most part, so that the place is seldom far from the end.
        for (; place > 0 && hit.ComesBefore(memory[place - 1]); --place)
            memory[place] = memory[place - 1];
        memory[place] = hit;
        if (Count == capacity)
            farthest = float.Min(maximumT, memory[Count - 1].T * Slack);
    }
}
