using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Tells which edges are hit at the foot of a wall, while a floor holds their body.</summary>
/// <remarks>
/// What lies on a floor and is stopped by a wall, as a plate that slides to a lip, is hit by both at once: the wall turns its edge down, which the floor does
/// not let happen. One sweep of the solver makes them one after the other, so that the edge goes down at the speed of the impact for a substep, and is pushed
/// out of the floor at a part of that speed, however short the substep is: it keeps what it was pushed out with. So such impacts are made exactly, by the
/// stage of bounces, as those of thin things are: in turn, until neither approaches. Only edges: what is round climbs, and a corner that is alone is not
/// held. Whether the body comes or the wall does is the same.
/// </remarks>
static class CornerHits
{
    // Part of its distance from the centre of its body by which a contact that is hit comes nearer in the step, at least: what is slower hardly differs.
    const float LeastHit = 2e-2f;
    // Cosine of the least angle between the two that is a corner.
    const float Across = .9f;
    // Part of that distance by which contacts that are hit may be above what holds the body: a higher wall holds it up itself.
    const float LowestWall = .1f;

    // Contacts of an edge.
    const int LeastEdgeCount = 2;

    /// <summary>By how much the contacts of an edge come nearer within a step in which they are hit; zero where they are not, m.</summary>
    /// <param name="manifold">The contacts.</param>
    /// <param name="a">Velocity of the body.</param>
    /// <param name="b">Velocity of what it touches.</param>
    /// <param name="dt">Length of the step, s.</param>
    public static float WayOf(in ConvexContactManifold manifold, in BodyVelocity a, in BodyVelocity b, float dt) =>
        manifold.Count < LeastEdgeCount ? 0 : WayOfAny(manifold, a, b, dt);

    static float WayOfAny(in ConvexContactManifold manifold, in BodyVelocity a, in BodyVelocity b, float dt)
    {
        var greatest = 0f;
        // Of the body as what it touches sees it, at its centre.
        var linear = a.Linear - b.Linear + Exact.Cross(b.Angular, manifold.OffsetB);
        var angular = a.Angular - b.Angular;
        for (int i = 0; i < manifold.Count; ++i)
        {
            var arm = manifold.GetOffset(i);
            var way = -dt * Exact.Dot(manifold.Normal, linear + Exact.Cross(angular, arm));
            // Acceleration, and what else pushes, may add to it.
            if (way > greatest && 2 * way > -manifold.GetDepth(i) && way * way > LeastHit * LeastHit * Exact.LengthSquared(arm))
                greatest = way;
        }
        return greatest;
    }

    /// <summary>Whether all contacts of a wall are at its foot on a floor.</summary>
    /// <param name="wall">The contacts of the wall.</param>
    /// <param name="normal">Unit normal of the floor.</param>
    /// <param name="place">A place on the floor, relative to the body.</param>
    public static bool IsCorner(in ConvexContactManifold wall, in Vector3 normal, in Vector3 place)
    {
        if (MathF.Abs(Exact.Dot(wall.Normal, normal)) > Across)
            return false;
        for (int i = 0; i < wall.Count; ++i)
        {
            var arm = wall.GetOffset(i);
            var height = Exact.Dot(arm - place, normal);
            if (height * height > LowestWall * LowestWall * Exact.LengthSquared(arm))
                return false;
        }
        return true;
    }

    /// <summary>
    /// Whether contacts are those of the same wall as others that are hit, and are hit too, but above its foot: of a wall that is made of several things.
    /// </summary>
    /// <param name="part">The contacts.</param>
    /// <param name="wall">The others.</param>
    /// <param name="normal">Unit normal of the floor.</param>
    /// <param name="place">A place on the floor, relative to the body.</param>
    /// <param name="a">Velocity of the body.</param>
    /// <param name="b">Velocity of what the contacts are with.</param>
    /// <param name="dt">Length of the step, s.</param>
    public static bool IsHigher(in ConvexContactManifold part, in ConvexContactManifold wall, in Vector3 normal, in Vector3 place,
        in BodyVelocity a, in BodyVelocity b, float dt) =>
        Exact.Dot(part.Normal, wall.Normal) > Across && WayOfAny(part, a, b, dt) > 0 && !IsCorner(part, normal, place);

    /// <summary>Whether contacts of a floor hold the body of an edge that is hit at a wall.</summary>
    public static bool Holds(in ConvexContactManifold floor, in ConvexContactManifold wall) =>
        floor.Count > 0 && floor.GreatestDepth >= 0 && IsCorner(wall, floor.Normal, floor.Contact0.Offset);

    /// <summary>Whether one of the patches of a pair is hit while another holds the body.</summary>
    /// <param name="results">The patches, and what comes after them.</param>
    /// <param name="a">Velocity of the body.</param>
    /// <param name="b">Velocity of what it touches.</param>
    /// <param name="dt">Length of the step, s.</param>
    public static bool Has(ReadOnlySpan<ChildResult> results, in BodyVelocity a, in BodyVelocity b, float dt)
    {
        var (hit, greatest) = (-1, 0f);
        for (int i = 0; i < results.Length && results[i].Children.IsPatch; ++i)
        {
            var way = WayOf(results[i].Manifold, a, b, dt);
            if (way > greatest)
                (hit, greatest) = (i, way);
        }
        for (int i = 0; hit >= 0 && i < results.Length && results[i].Children.IsPatch; ++i)
        {
            if (Holds(results[i].Manifold, results[hit].Manifold))
                return true;
        }
        return false;
    }
}
