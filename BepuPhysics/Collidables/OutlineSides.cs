using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuPhysics.Trees;

namespace BepuPhysics.Collidables;

/// <summary>Tells which triangles a shape is beside, or in front of: what the box around it meets is often only the box around them.</summary>
/// <remarks>
/// A shape is apart from a triangle if it is beyond one of the planes that stand on its edges, or in front of its own. That is looked at along four
/// directions at once, those of AB, BC and CA and the normal. What is behind a triangle is not left out: it may have been pressed through.
/// </remarks>
readonly struct OutlineSides
{
    // Of what the lengths that a direction and a distance are made of come to: cross products of edges, and a product with a corner, are rounded.
    const float Slack = 1e-5f;
    // Squares below it have lost digits: directions of triangles of some micrometres are not looked along.
    const float LeastSquare = 1e-34f;

    readonly Lanes center, x, y, z, axis;
    readonly Vector128<float> radius, roundRadius, front;
    readonly bool isBox;

    /// <summary>A vector in each lane.</summary>
    public readonly struct Lanes(Vector128<float> x, Vector128<float> y, Vector128<float> z)
    {
        public readonly Vector128<float> X = x, Y = y, Z = z;

        public Lanes(in Vector3 v) : this(Vector128.Create(v.X), Vector128.Create(v.Y), Vector128.Create(v.Z)) { }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Vector128<float> Dot(in Lanes v) => X * v.X + Y * v.Y + Z * v.Z;

        /// <summary>From each vector to the next.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Lanes ToNext() => new(Next(X) - X, Next(Y) - Y, Next(Z) - Z);

        /// <summary>One of the vectors in all lanes.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Lanes Spread(int lane) => new(Vector128.Create(X[lane]), Vector128.Create(Y[lane]), Vector128.Create(Z[lane]));

        /// <summary>The greatest number of all, without signs.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Vector128<float> Greatest()
        {
            var greatest = BoxMath.Max(BoxMath.Max(Vector128.Abs(X), Vector128.Abs(Y)), Vector128.Abs(Z));
            greatest = BoxMath.Max(greatest, Vector128.Shuffle(greatest, Vector128.Create(2, 3, 0, 1)));
            return BoxMath.Max(greatest, Vector128.Shuffle(greatest, Vector128.Create(1, 0, 3, 2)));
        }
    }

    /// <param name="shape">The shape.</param>
    /// <param name="isMirrored">Whether corners are in the other order: A, B and C follow each other counterclockwise seen from the front.</param>
    public OutlineSides(in ShapeOutline shape, bool isMirrored)
    {
        center = new(shape.Center);
        (x, y, z, axis) = (new(shape.X), new(shape.Y), new(shape.Z), new(shape.Axis));
        (radius, roundRadius) = (Vector128.Create(shape.Radius), Vector128.Create(shape.RoundRadius));
        front = Vector128.Create(isMirrored ? -1f : 1);
        isBox = shape.IsBox;
    }

    // Of each lane the next.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Next(Vector128<float> lanes) => Vector128.Shuffle(lanes, Vector128.Create(1, 2, 3, 0));

    /// <summary>Whether the shape is apart from a triangle by the side of it that it is on; not where anything is beyond all numbers.</summary>
    /// <param name="corners">A, B, C and A, in the frame of the outline.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool IsApart(in Lanes corners)
    {
        // AB, BC, CA and nothing; from the corners to the shape.
        var edges = corners.ToNext();
        var ways = new Lanes(center.X - corners.X, center.Y - corners.Y, center.Z - corners.Z);
        var face = Cross(edges.Spread(0), edges.Spread(2));
        var outwards = Cross(face, edges);
        var isFace = Vector128.Create(0, 0, 0, -1).AsSingle();
        var directions = new Lanes(
            Vector128.ConditionalSelect(isFace, face.X * front, outwards.X),
            Vector128.ConditionalSelect(isFace, face.Y * front, outwards.Y),
            Vector128.ConditionalSelect(isFace, face.Z * front, outwards.Z));
        var squared = directions.Dot(directions);
        var reach = radius * Vector128.Sqrt(squared) + Vector128.Abs(directions.Dot(y));
        if (isBox)
            reach += Vector128.Abs(directions.Dot(x)) + Vector128.Abs(directions.Dot(z));
        else
        {
            var along = directions.Dot(axis);
            reach += roundRadius * Vector128.Sqrt(BoxMath.Max(squared - along * along, Vector128<float>.Zero));
        }
        var length = edges.Greatest();
        var slack = length * length * ways.Greatest() * Vector128.Create(Slack);
        slack = Vector128.ConditionalSelect(isFace, slack, slack * length);
        var isApart = Vector128.GreaterThan(directions.Dot(ways), reach + slack) & Vector128.GreaterThan(squared, Vector128.Create(LeastSquare));
        return isApart.ExtractMostSignificantBits() != 0;
    }

    /// <summary>The cross products of vectors side by side.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Lanes Cross(in Lanes a, in Lanes b) => new(a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);
}
