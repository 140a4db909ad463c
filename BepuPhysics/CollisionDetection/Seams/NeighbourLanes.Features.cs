using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// What nobody has to test: triangles that have nothing of what touches over them.
unsafe partial struct NeighbourLanes
{
    // A direction as steep to the triangle's normal as this cosine says is the neighbours'.
    const float LeastCosine = 0.05f;
    // Part of the sizes by which a feature must be beside a triangle to have nothing over it: far above the rounding of the test that looks for it.
    const float Beside = 1e-4f;
    // Part by which the two kinds of features of a cylinder, or two faces of a box, must differ in angle not to be mistaken for each other.
    const float Distinct = 1e-3f;

    // Lanes that have no contacts for sure, without a test: the direction is the neighbours', or what touches is beside the triangle. What is near to that is
    // tested. What is a triangle too may have gone through the neighbour, and be seen by nobody else.
    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly Vector<int> HasNone(in Shape shape, in Best best)
    {
        var none = Vector.LessThan(Vector3Wide.Dot(best.Direction, shape.Normal), new Vector<float>(LeastCosine));
        FindFeature(shape, -best.Direction, out var feature, out var isKnown);
        var tolerance = new Vector<float>(Beside) * (otherSize + shape.Size + center.Length());
        var isApart = Vector.LessThan(best.Depth, -margin - tolerance);
        var isBeside = IsBeside(shape.AB, best.Direction, feature, tolerance) | IsBeside(shape.BC, best.Direction, feature, tolerance) |
            IsBeside(shape.CA, best.Direction, feature, tolerance);
        return Vector.AndNot(none | (isKnown & (isApart | isBeside)), Vector.Equals(otherType, new Vector<int>(Triangle.Id)));
    }

    // What of the other shape faces a direction: a point, a line, a parallelogram or a disc, from the shape's centre: its middle, the ways from there to its
    // sides, and the radius of what is around all of these.
    struct Feature
    {
        public Vector3Wide Middle, U, V;
        public Vector<float> Radius;
    }

    readonly Vector<int> IsBeside(in Edge edge, in Vector3Wide along, in Feature feature, Vector<float> tolerance)
    {
        var across = Vector3Wide.Cross(along, edge.Way);
        var beyond = Vector3Wide.Dot(across, feature.Middle - center) - Vector3Wide.Dot(across, edge.Corner) -
            Vector.Abs(Vector3Wide.Dot(across, feature.U)) - Vector.Abs(Vector3Wide.Dot(across, feature.V)) -
            (feature.Radius + tolerance) * across.Length();
        return Vector.GreaterThan(beyond, Vector<float>.Zero);
    }

    // What of the other shape faces a direction, and whether it is known: of hulls it is not, nor where two features face the direction alike.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly void FindFeature(in Shape shape, in Vector3Wide along, out Feature feature, out Vector<int> isKnown)
    {
        isKnown = ~Vector.Equals(otherType, new Vector<int>(ConvexHull.Id));
        feature.Middle = feature.V = Vector3Wide.Zero;
        feature.Radius = Vector<float>.Zero;
        feature.U = shape.Y * half.Y;
        if (Has(Box.Id))
            FindFace(shape, along, ref feature, ref isKnown);
        if (Has(Cylinder.Id))
            FindSide(shape, along, ref feature, ref isKnown);
    }

    readonly void FindFace(in Shape shape, in Vector3Wide along, ref Feature feature, ref Vector<int> isKnown)
    {
        var distinct = new Vector<float>(Distinct);
        var isBox = Vector.Equals(otherType, new Vector<int>(Box.Id));
        var (alongX, alongY, alongZ) = (Vector3Wide.Dot(shape.X, along), Vector3Wide.Dot(shape.Y, along), Vector3Wide.Dot(shape.Z, along));
        var (x, y, z) = (Vector.Abs(alongX), Vector.Abs(alongY), Vector.Abs(alongZ));
        var isX = isBox & Vector.GreaterThan(x, y + distinct) & Vector.GreaterThan(x, z + distinct);
        var isY = isBox & Vector.GreaterThan(y, x + distinct) & Vector.GreaterThan(y, z + distinct);
        var isZ = isBox & Vector.GreaterThan(z, x + distinct) & Vector.GreaterThan(z, y + distinct);
        var (sideX, sideY, sideZ) = (shape.X * half.X, shape.Y * half.Y, shape.Z * half.Z);
        feature.Middle = Vector3Wide.Select(isX, shape.X * Wide.CopySign(half.X, alongX), feature.Middle);
        feature.Middle = Vector3Wide.Select(isY, shape.Y * Wide.CopySign(half.Y, alongY), feature.Middle);
        feature.Middle = Vector3Wide.Select(isZ, shape.Z * Wide.CopySign(half.Z, alongZ), feature.Middle);
        feature.U = Vector3Wide.Select(isY | isZ, sideX, feature.U);
        feature.V = Vector3Wide.Select(isX | isY, sideZ, feature.V);
        feature.V = Vector3Wide.Select(isZ, sideY, feature.V);
        isKnown &= ~isBox | isX | isY | isZ;
    }

    // A cap, or the line of the side that faces the direction.
    readonly void FindSide(in Shape shape, in Vector3Wide direction, ref Feature feature, ref Vector<int> isKnown)
    {
        var distinct = new Vector<float>(Distinct);
        var isCylinder = Vector.Equals(otherType, new Vector<int>(Cylinder.Id));
        var along = Vector3Wide.Dot(shape.Y, direction);
        var across = direction - shape.Y * along;
        var length = across.Length();
        var isCap = isCylinder & Vector.GreaterThan(Vector.Abs(along), length + distinct);
        var isEither = Vector.AndNot(isCylinder & Vector.GreaterThan(Vector.Abs(along), length - distinct), isCap);
        var isSide = Vector.AndNot(Vector.AndNot(isCylinder, isCap), isEither);
        feature.Middle = Vector3Wide.Select(isCap, shape.Y * Wide.CopySign(half.Y, along), feature.Middle);
        feature.Middle = Vector3Wide.Select(isSide, across * (discRadius / length), feature.Middle);
        feature.U = Vector3Wide.Select(isCap, Vector3Wide.Zero, feature.U);
        feature.Radius = Wide.Select(isCap, discRadius, feature.Radius);
        isKnown = Vector.AndNot(isKnown, isEither);
    }
}
