using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>How the farthest point of the difference moves as the best direction rotates, where a shape is round.</summary>
/// <remarks>
/// A farthest point on a circle of radius R moves along the circle's tangent, by R over the sine of the angle between the direction and the circle's
/// axis for each radian that the direction rotates that way. So the second derivative of the depth by the direction is known: for each round shape a
/// weight times the tangent times itself, and nothing for what is flat. That is enough for Newton's step to the direction in which the
/// farthest point is where the target is seen from the simplex. Without it the descent goes on across the chord between two points of a circle,
/// which always leads to the middle between them: a bisection.
/// </remarks>
struct SearchCurvature
{
    // Squared sine of the angle to the axis below which the end of a cylinder counts as flat.
    const float FlatSquaredSine = SearchTolerances.NearlyParallel * SearchTolerances.NearlyParallel;
    // Part of the curvature that the depth may take away. Where shapes overlap, the target moves along with the plane: a depth of h is a curvature
    // of -h. Where that is more than there is, the direction is no minimum, and steps remain steps down.
    const float GreatestLoss = 0.9f;
    // A step is at most half a radian where nothing resists it, and less the nearer the target is: then this is nothing beside the curvature, and
    // steps are Newton's.
    const float Stiffness = 2;
    // Squared cosine of the angle between an edge of the simplex and the best direction up to which it says where to go.
    const float GreatestSquaredSlope = 0.75f;

    /// <summary>A's tangent, and that of B where both are round, as long as the radius; that of B where only B is round.</summary>
    public Vector3Wide Tangent, OtherTangent;
    /// <summary>What the squares of tangents are multiplied by; zero where the shape counts as flat.</summary>
    public Vector<float> Weight, OtherWeight;
    /// <summary>Sum and product of the two principal curvatures.</summary>
    public Vector<float> Sum, Product;

    /// <summary>What the square of a tangent is multiplied by.</summary>
    /// <param name="radial">From the centre of the circle to the farthest point, m.</param>
    /// <param name="squaredRadius">The square of its length.</param>
    /// <param name="direction">Best direction.</param>
    /// <param name="scale">Scale of the search.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> FindWeight(in Vector3Wide radial, Vector<float> squaredRadius, in Vector3Wide direction, Vector<float> scale)
    {
        var height = Vector3Wide.Dot(radial, direction);
        return Wide.Mask(Vector.GreaterThan(height * height, squaredRadius * new Vector<float>(FlatSquaredSine)), scale / height);
    }

    /// <summary>Lanes that can be stepped: the simplex is a point, or an edge that is not along the best direction.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<int> HasNewtonStep(in SimplexForm form, in Vector3Wide direction)
    {
        var along = Vector3Wide.Dot(form.Edge, direction);
        var isAcross = Vector.LessThan(along * along, form.Edge.LengthSquared() * new Vector<float>(GreatestSquaredSlope));
        return Vector.GreaterThan(Sum, Vector<float>.Zero) & (form.PointMask | (form.EdgeMask & isAcross));
    }

    /// <summary>The tangent of a shape that does not count as flat.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector3Wide AnyTangent(bool bothRound) =>
        bothRound ? Vector3Wide.Select(Vector.GreaterThan(Weight, Vector<float>.Zero), Tangent, OtherTangent) : Tangent;

    /// <summary>By how much the farthest point moves along a direction for each radian that the best direction rotates to it.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector<float> Along(in Vector3Wide direction, bool bothRound)
    {
        var along = Vector3Wide.Dot(Tangent, direction);
        var curvature = Weight * (along * along);
        if (!bothRound)
            return curvature;
        along = Vector3Wide.Dot(OtherTangent, direction);
        return curvature + OtherWeight * (along * along);
    }

    /// <summary>Rotates the best direction to where the farthest point should be.</summary>
    /// <param name="form">What the simplex is.</param>
    /// <param name="offset">From the closest point of the simplex to the target.</param>
    /// <param name="length">Its length.</param>
    /// <param name="depth">Depth in the best direction.</param>
    /// <param name="best">Best direction.</param>
    /// <param name="mask">Lanes to change; those of others stay as they are.</param>
    /// <param name="bothRound">Whether there are two tangents.</param>
    /// <param name="direction">Direction to go on in.</param>
    // With H the curvature, n the best direction and o what of the offset is across it, the step d solves (H + s) d = o. Where nothing is round, and
    // s is the offset's part along n, that is the way from the simplex to the target; where shapes are apart, it is Newton's step as it stands.
    // H = u aa' + v bb' in the plane across n, so that (H + s)^-1 o = ((trace H + s) o - u a(a.o) - v b(b.o)) / (det H + s (trace H + s)).
    // At an edge the step is a rotation about it: nothing else stays across the edge.
    [MethodImpl(MethodImplOptions.NoInlining)]
    public readonly void NewtonStep(in SimplexForm form, in Vector3Wide offset, Vector<float> length, Vector<float> depth, in Vector3Wide best,
        Vector<int> mask, bool bothRound, ref Vector3Wide direction)
    {
        var loss = new Vector<float>(GreatestLoss);
        var outward = Vector3Wide.Dot(offset, best);
        var stiffness = Wide.Max(outward, (length - outward) * new Vector<float>(Stiffness));
        var inside = Wide.Max(depth, Vector<float>.Zero);
        Vector3Wide stepped;
        if ((form.PointMask & mask) != Vector<int>.Zero)
        {
            var flexible = stiffness - Wide.Min(inside, Product * loss / Sum);
            var sum = Sum + flexible;
            stepped = (offset - best * outward) * sum - Tangent * (Weight * Vector3Wide.Dot(Tangent, offset));
            if (bothRound)
                stepped -= OtherTangent * (OtherWeight * Vector3Wide.Dot(OtherTangent, offset));
            stepped = best + stepped * (Vector<float>.One / (Product + flexible * sum));
        }
        else
        {
            stepped = best;
        }
        if ((form.EdgeMask & mask) != Vector<int>.Zero)
        {
            var squaredEdge = form.Edge.LengthSquared();
            var across = Vector3Wide.Cross(form.Edge, best);
            var squaredAcross = across.LengthSquared();
            var curvature = Along(across, bothRound);
            var angle = Vector3Wide.Dot(offset, across) * Vector.SquareRoot(squaredEdge * squaredAcross) /
                (curvature - Wide.Min(inside * squaredAcross, curvature * loss) + stiffness * squaredAcross);
            var overEdge = best * squaredEdge - form.Edge * Vector3Wide.Dot(form.Edge, best) + across * angle;
            stepped = Vector3Wide.Select(form.EdgeMask, overEdge, stepped);
        }
        stepped *= Vector<float>.One / stepped.Length();
        direction = Vector3Wide.Select(mask, stepped, direction);
    }
}
