using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>The core of one convex shape in its own frame, in double precision, and by how much the core is rounded.</summary>
/// <remarks>
/// As for the depth search the core of a sphere is its centre, that of a capsule its segment, and other shapes are their own; of a
/// half-space there is only its plane, and no farthest point.
/// </remarks>
unsafe struct ImpactCore
{
    enum Kind
    {
        Point, Segment, Box, Cylinder, Hull, Triangle, Plane, Own
    }

    // Within this part of the radius, a vertex that floats do not show as the farthest may be it.
    const float VertexRounding = 1e-6f;

    Kind kind;
    // Half extents of a box; half length, and radius, of a segment or cylinder. Corners of a triangle. Normal of a plane.
    DoubleVector3 a, b, c;
    HullHeader* hull;
    // Of a hull, or a shape of a game's own, about its origin.
    double hullScale;
    // Of such a shape: what is asked, how, and the radius of a ball about its origin that is in its core, m.
    void* source;
    delegate*<void*, DoubleVector3, DoubleVector3> farthest;
    double innerRadius;

    /// <summary>Distance of the surface from the core, m.</summary>
    public double Margin;
    /// <summary>Distance of the core's farthest point from the origin of the shape, m.</summary>
    public double Reach;
    /// <summary>
    /// Radius of the shape, about its origin, or of a triangle about the middle of its corners, m. What it is like in size.
    /// </summary>
    public double Size;
    /// <summary>Direction in front of a triangle, of any length; zero for all that has no back.</summary>
    public DoubleVector3 Front;

    /// <summary>Whether the core is a single point.</summary>
    public readonly bool IsPoint
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => kind == Kind.Point;
    }

    /// <summary>Whether the shape is a half-space.</summary>
    public readonly bool IsPlane
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => kind == Kind.Plane;
    }

    /// <summary>Whether a turn about the Y axis changes nothing.</summary>
    public readonly bool IsRoundAboutY => kind is Kind.Segment or Kind.Cylinder;

    /// <summary>Normal of a half-space, or a corner of a triangle.</summary>
    public readonly DoubleVector3 First => a;

    /// <summary>The core of a point, which has no size.</summary>
    public static ImpactCore Point => default;

    /// <summary>Whether a shape type has a core.</summary>
    public static bool Exists(int typeId) =>
        typeId is Sphere.Id or Capsule.Id or Box.Id or Triangle.Id or Cylinder.Id or ConvexHull.Id or HalfSpace.Id;

    /// <summary>Whether a shape type, which may be a game's own, has a core.</summary>
    public static bool Exists(int typeId, Shapes shapes) =>
        typeId <= ShapeLimits.LastTypeId ? Exists(typeId) : shapes.FindBatch(typeId) is IConvexCoreBatch;

    /// <summary>The core of a shape that has one, and may be a game's own.</summary>
    /// <param name="typeId">Type of the shape.</param>
    /// <param name="shape">The shape, which stays where it is.</param>
    /// <param name="shapes">Shapes that there are.</param>
    public static ImpactCore Of(int typeId, void* shape, Shapes shapes) =>
        typeId <= ShapeLimits.LastTypeId ? Of(typeId, shape) : ((IConvexCoreBatch)shapes.GetBatch(typeId)).CoreOf(shape);

    /// <summary>The core of a shape of a game's own.</summary>
    /// <param name="source">What is asked for farthest points; stays where it is.</param>
    /// <param name="farthest">Finds a farthest point of the core along a unit direction.</param>
    /// <param name="margin">Distance of the surface from the core, m.</param>
    /// <param name="reach">Distance from the origin of the shape that no point of the core is beyond, m.</param>
    /// <param name="innerRadius">Radius of a ball about the origin that is in the core, m; negative or zero where none is.</param>
    public static ImpactCore Own(
        void* source, delegate*<void*, DoubleVector3, DoubleVector3> farthest, double margin, double reach, double innerRadius)
    {
        var rounded = reach * (1 + VertexRounding);
        return new()
        {
            kind = Kind.Own,
            source = source,
            farthest = farthest,
            innerRadius = Math.Max(0, innerRadius),
            hullScale = 1,
            Margin = margin,
            Reach = rounded,
            Size = rounded + margin,
        };
    }

    /// <summary>The core of a shape that has one.</summary>
    /// <param name="typeId">Type of the shape.</param>
    /// <param name="shape">The shape.</param>
    public static ImpactCore Of(int typeId, void* shape)
    {
        var core = default(ImpactCore);
        switch (typeId)
        {
            case Sphere.Id:
                core.kind = Kind.Point;
                core.Margin = core.Size = ((Sphere*)shape)->Radius;
                break;
            case Capsule.Id:
                var capsule = (Capsule*)shape;
                core.kind = Kind.Segment;
                core.Margin = capsule->Radius;
                core.Reach = capsule->HalfLength;
                core.a = new(0, capsule->HalfLength, 0);
                core.Size = core.Reach + core.Margin;
                break;
            case Box.Id:
                var box = (Box*)shape;
                core.kind = Kind.Box;
                core.a = new(box->HalfWidth, box->HalfHeight, box->HalfLength);
                core.Size = core.Reach = core.a.Length;
                break;
            case Cylinder.Id:
                var cylinder = (Cylinder*)shape;
                core.kind = Kind.Cylinder;
                core.a = new(cylinder->Radius, cylinder->HalfLength, 0);
                core.Size = core.Reach = core.a.Length;
                break;
            case ConvexHull.Id:
                core.kind = Kind.Hull;
                core.hull = ((ConvexHull*)shape)->Header;
                core.hullScale = 1;
                // Of the farthest vertex as floats have it: what bounds a motion must not be less.
                core.Size = core.Reach = core.hull->OuterRadius * (1 + VertexRounding);
                break;
            case Triangle.Id:
                core.SetTriangle((Triangle*)shape);
                break;
            default:
                core.kind = Kind.Plane;
                core.a = new(((HalfSpace*)shape)->Normal);
                core.a = core.a * (1 / core.a.Length);
                core.Size = double.MaxValue;
                break;
        }
        return core;
    }

    /// <summary>Takes a part of its inner radius off the shape, all around; a hull is made smaller by that part, which takes no less off.</summary>
    /// <param name="part">The part.</param>
    /// <param name="most">Inner radius that counts where that of the shape is larger, m.</param>
    // A ball of the inner radius is in a hull, and so is what a hull that is smaller by a part sweeps with a ball of that part of the radius.
    public void Thin(double part, double most)
    {
        switch (kind)
        {
            case Kind.Point or Kind.Segment:
                Margin -= part * Math.Min(Margin, most);
                Size = Reach + Margin;
                break;
            case Kind.Box or Kind.Cylinder:
                var skin = part * Math.Min(most, Math.Min(a.X, kind == Kind.Box ? Math.Min(a.Y, a.Z) : a.Y));
                a = kind == Kind.Box ? new(a.X - skin, a.Y - skin, a.Z - skin) : new(a.X - skin, a.Y - skin, 0);
                Size = Reach = a.Length;
                break;
            case Kind.Hull:
                hullScale = 1 - part * Math.Min(1, most / hull->InnerRadius);
                Reach *= hullScale;
                Size *= hullScale;
                break;
            case Kind.Own when innerRadius > 0:
                hullScale = 1 - part * Math.Min(1, most / innerRadius);
                Reach *= hullScale;
                Size = Reach + Margin;
                break;
        }
    }

    void SetTriangle(Triangle* triangle)
    {
        kind = Kind.Triangle;
        a = new(triangle->A);
        b = new(triangle->B);
        c = new(triangle->C);
        Reach = Math.Max(a.Length, Math.Max(b.Length, c.Length));
        var middle = (a + b + c) * (1.0 / 3);
        Size = Math.Max((a - middle).Length, Math.Max((b - middle).Length, (c - middle).Length));
        if (!triangle->TwoSided)
            Front = DoubleVector3.Cross(c - a, b - a);
    }

    /// <summary>Finds the point of the core that is nearest to a point, where there is a closed form.</summary>
    /// <param name="point">The point, in the frame of the shape.</param>
    /// <param name="nearest">The nearest point; the point itself where that is in the core.</param>
    /// <returns>Whether there is a closed form: for all but hulls, half-spaces and what games make.</returns>
    public readonly bool TryGetNearest(in DoubleVector3 point, out DoubleVector3 nearest)
    {
        nearest = default;
        switch (kind)
        {
            case Kind.Point:
                return true;
            case Kind.Segment:
                nearest = new(0, Math.Clamp(point.Y, -a.Y, a.Y), 0);
                return true;
            case Kind.Box:
                nearest = new(Math.Clamp(point.X, -a.X, a.X), Math.Clamp(point.Y, -a.Y, a.Y), Math.Clamp(point.Z, -a.Z, a.Z));
                return true;
            case Kind.Cylinder:
                var across = Math.Sqrt(point.X * point.X + point.Z * point.Z);
                var scale = across > a.X ? a.X / across : 1;
                nearest = new(point.X * scale, Math.Clamp(point.Y, -a.Y, a.Y), point.Z * scale);
                return true;
            case Kind.Triangle:
                nearest = point + ImpactSimplex.NearestToOrigin(a - point, b - point, c - point);
                return true;
            default:
                return false;
        }
    }

    /// <summary>Radius of a cylinder about an axis through the origin of the shape that holds the core.</summary>
    /// <param name="axis">Unit direction in the frame of the shape.</param>
    public readonly double RadiusAbout(in DoubleVector3 axis)
    {
        switch (kind)
        {
            case Kind.Segment:
                return DistanceFrom(axis, a);
            case Kind.Box:
                // The farthest of the four corners that are not each other's opposites.
                return Math.Max(
                    Math.Max(DistanceFrom(axis, a), DistanceFrom(axis, new(-a.X, a.Y, a.Z))),
                    Math.Max(DistanceFrom(axis, new(a.X, -a.Y, a.Z)), DistanceFrom(axis, new(a.X, a.Y, -a.Z))));
            case Kind.Cylinder:
                return Math.Min(Reach, a.X + DistanceFrom(axis, new(0, a.Y, 0)));
            case Kind.Triangle:
                return Math.Max(DistanceFrom(axis, a), Math.Max(DistanceFrom(axis, b), DistanceFrom(axis, c)));
            case Kind.Hull:
                var radius = 0.0;
                for (int i = 0; i < hull->VertexCount; ++i)
                    radius = Math.Max(radius, DistanceFrom(axis, new(hull->GetPoint(i))));
                return radius * hullScale;
            case Kind.Own:
                return Reach;
            default:
                return 0;
        }
    }

    static double DistanceFrom(in DoubleVector3 axis, in DoubleVector3 point) => DoubleVector3.Cross(axis, point).Length;

    /// <summary>A point of the core that is farthest along a direction; of several, always the same.</summary>
    /// <param name="direction">Unit direction in the frame of the shape.</param>
    public readonly DoubleVector3 Support(in DoubleVector3 direction)
    {
        switch (kind)
        {
            case Kind.Segment:
                return new(0, Math.CopySign(a.Y, direction.Y), 0);
            case Kind.Box:
                return new(Math.CopySign(a.X, direction.X), Math.CopySign(a.Y, direction.Y), Math.CopySign(a.Z, direction.Z));
            case Kind.Cylinder:
                var across = Math.Sqrt(direction.X * direction.X + direction.Z * direction.Z);
                var scale = across > 0 ? a.X / across : 0;
                return new(direction.X * scale, Math.CopySign(a.Y, direction.Y), direction.Z * scale);
            case Kind.Triangle:
                double onA = DoubleVector3.Dot(a, direction), onB = DoubleVector3.Dot(b, direction), onC = DoubleVector3.Dot(c, direction);
                return onA >= onB ? onA >= onC ? a : c : onB >= onC ? b : c;
            case Kind.Hull:
                return FarthestVertex(direction) * hullScale;
            case Kind.Own:
                return farthest(source, direction) * hullScale;
            default:
                return default;
        }
    }

    // Floats, as many at once as there are lanes, leave few vertices to compare in doubles: those that may be the farthest for all that
    // floats tell. Which these are is the same at any width.
    readonly DoubleVector3 FarthestVertex(in DoubleVector3 direction)
    {
        var single = direction.ToSingle();
        Vector<float> x = new(single.X), y = new(single.Y), z = new(single.Z);
        var points = hull->Points;
        var count = hull->VertexBundleCount;
        var farthest = new Vector<float>(float.MinValue);
        for (int i = 0; i < count; ++i)
        {
            var distance = points[i].X * x + points[i].Y * y + points[i].Z * z;
            farthest = Vector.ConditionalSelect(Vector.GreaterThan(distance, farthest), distance, farthest);
        }
        var greatest = farthest[0];
        for (int lane = 1; lane < Vector<float>.Count; ++lane)
            greatest = farthest[lane] > greatest ? farthest[lane] : greatest;
        var least = new Vector<float>(greatest - VertexRounding * hull->OuterRadius);
        var best = default(DoubleVector3);
        var bestDistance = double.MinValue;
        for (int i = 0; i < count; ++i)
        {
            var mask = Vector.GreaterThanOrEqual(points[i].X * x + points[i].Y * y + points[i].Z * z, least);
            if (mask == Vector<int>.Zero)
                continue;
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                if (mask[lane] == 0)
                    continue;
                var point = new DoubleVector3(points[i].X[lane], points[i].Y[lane], points[i].Z[lane]);
                var distance = DoubleVector3.Dot(point, direction);
                if (distance > bestDistance)
                    (best, bestDistance) = (point, distance);
            }
        }
        return best;
    }
}
