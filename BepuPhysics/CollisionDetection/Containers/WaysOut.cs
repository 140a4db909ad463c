using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Puts the plane that leads out of a solid in the place of a child of it.</summary>
/// <remarks>
/// A triangle of a surface knows its front and no depth: what is behind it is in nobody's way. So where the origin of a shape is inside of a solid, the
/// two meet as the shape and a half-space do whose plane goes through the nearest point of the surface: it has all of the contacts of
/// the shape with it, and the depth by which all of the shape gets out.
/// </remarks>
static unsafe class WaysOut
{
    /// <summary>Finds the way out of a solid for a point.</summary>
    /// <param name="solid">The solid.</param>
    /// <param name="offset">The point less the centre of the solid, world axes.</param>
    /// <param name="orientation">Rotation from the frame of the solid to the world.</param>
    /// <param name="way">The way out, in the frame of the solid.</param>
    /// <returns>Whether the point is inside.</returns>
    public static bool Find<TSolid>(in TSolid solid, Vector3 offset, in Quaternion orientation, out WayOut way) where TSolid : unmanaged, IContainer =>
        solid.FindWayOut(Exact.Rotate(offset, Exact.Conjugate(orientation)), out way);

    /// <summary>The way out for the middle of a convex shape.</summary>
    public static bool Find<TSolid>(in ParentPair pair, bool solidIsA, in TSolid solid, out WayOut way) where TSolid : unmanaged, IContainer =>
        solidIsA ? Find(solid, pair.OffsetB, pair.OrientationA, out way) : Find(solid, -pair.OffsetB, pair.OrientationB, out way);

    /// <summary>The way out for a child of another container.</summary>
    public static bool Find<TOther, TSolid>(
        in ParentPair pair, bool solidIsA, in TOther other, int child, in TSolid solid, Shapes shapes, void* scratch, out WayOut way)
        where TOther : unmanaged, IContainer where TSolid : unmanaged, IContainer
    {
        other.GetChild(child, shapes, scratch, out var found);
        way = default;
        // Those of a surface have no middle of their own.
        if (found.TypeId == Triangle.Id)
            return false;
        return solidIsA
            ? Find(solid, pair.OffsetB + Exact.Rotate(found.Pose.Position, pair.OrientationB), pair.OrientationA, out way)
            : Find(solid, Exact.Rotate(found.Pose.Position, pair.OrientationA) - pair.OffsetB, pair.OrientationB, out way);
    }

    /// <summary>Replaces the solid among two shapes by the way out.</summary>
    /// <param name="children">The two, of which the solid's offset and orientation are its own.</param>
    /// <param name="solidIsA">Whether the solid is A.</param>
    /// <param name="way">The way out.</param>
    /// <param name="scratch">Room for a child that is made on the way.</param>
    public static void Set(ref ChildShapes children, bool solidIsA, in WayOut way, void* scratch)
    {
        *(HalfSpace*)scratch = new(way.Normal);
        children.LeadsOut = true;
        ContainerPlaces.SetShape(ref children, solidIsA, HalfSpace.Id, scratch);
        if (solidIsA)
            children.OffsetA = Exact.Rotate(way.Place, children.OrientationA);
        else
            children.OffsetB += Exact.Rotate(way.Place, children.OrientationB);
    }
}
