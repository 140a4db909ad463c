using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Where a descent is: its simplex, the best direction, and the depth in it.</summary>
struct SearchDescent
{
    // Cosine of the angle between the remembered triangle's normal and the remembered direction up to which the normal is used.
    const float LeastNormalCosine = 0.9f;

    public SearchSimplex Simplex;
    /// <summary>The farthest point that was found last.</summary>
    public SearchVertex Vertex;
    /// <summary>How the farthest point moves; of pairs with a round shape.</summary>
    public SearchCurvature Curvature;
    /// <summary>What the simplex is.</summary>
    public SimplexForm Form;
    /// <summary>Unit, from A to B, in A's frame.</summary>
    public Vector3Wide Direction;
    /// <summary>Of the cores, scaled.</summary>
    public Vector<float> Depth;

    /// <summary>What the descent seeks: the origin's projection on the best plane, or the origin where that plane is beyond it.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly Vector3Wide Target() => Direction * Wide.Max(Depth, Vector<float>.Zero);

    /// <summary>Puts what is remembered where the shapes are now. Pairs of which nothing is known start along the offset of their centres.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public Vector<int> Start(in DepthSearchStateWide state, in SearchFrame frame)
    {
        var distance = frame.Center.Length();
        var up = new Vector3Wide(Vector<float>.Zero, Vector<float>.One, Vector<float>.Zero);
        Direction = Vector3Wide.Select(
            Vector.GreaterThan(distance, Vector<float>.Zero), frame.Center * (-Vector<float>.One / distance), up);
        Depth = Vector<float>.Zero;
        var knownMask = Vector.GreaterThan(state.Direction.LengthSquared(), new Vector<float>(0.5f));
        // Without a simplex the descent starts with the first support point.
        if (knownMask == Vector<int>.Zero)
            return knownMask;
        Place(state.PointA0, state.PointB0, frame, out Simplex.A);
        Place(state.PointA1, state.PointB1, frame, out Simplex.B);
        Place(state.PointA2, state.PointB2, frame, out Simplex.C);

        // The triangle's own normal where it has one: exact where a face of the difference is closest.
        var e1 = Simplex.B.Point - Simplex.A.Point;
        var e2 = Simplex.C.Point - Simplex.A.Point;
        var normal = Vector3Wide.Cross(e1, e2);
        var squared = normal.LengthSquared();
        var length = Vector.SquareRoot(squared);
        var along = Vector3Wide.Dot(normal, state.Direction);
        var useNormal =
            Vector.GreaterThan(squared, e1.LengthSquared() * e2.LengthSquared() * new Vector<float>(SearchTolerances.SquaredSineOfPlane)) &
            Vector.GreaterThan(Vector.Abs(along), length * new Vector<float>(LeastNormalCosine));
        var known = Vector3Wide.Select(useNormal, normal * Wide.CopySign(Vector<float>.One / length, along), state.Direction);
        Direction = Vector3Wide.Select(knownMask, known, Direction);
        return knownMask;
    }

    /// <summary>Writes what the next step starts with.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly void Remember(
        in SearchFrame frame, Vector<int> deepMask, Vector<int> certifiedMask, Vector<float> certifiedDepth, ref DepthSearchStateWide state)
    {
        state.Direction = Direction;
        state.PointA0 = Simplex.A.OnA;
        state.PointA1 = Simplex.B.OnA;
        state.PointA2 = Simplex.C.OnA;
        state.PointB0 = Simplex.A.OnB;
        state.PointB1 = Simplex.B.OnB;
        state.PointB2 = Simplex.C.OnB;
        state.CertifiedDepth = Wide.Mask(deepMask, Wide.Select(certifiedMask, Depth, certifiedDepth)) * frame.InverseScale;
        state.Age = Wide.Select(certifiedMask, frame.AgeSpread(), state.Age + Vector<int>.One) & deepMask;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void Place(in Vector3Wide onA, in Vector3Wide onB, in SearchFrame frame, out SearchVertex vertex)
    {
        vertex.OnA = onA;
        vertex.OnB = onB;
        vertex.Point = frame.Difference(onA, onB);
    }
}
