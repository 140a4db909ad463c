using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>What the last test of a pair found and where its bodies were, for pairs whose test costs more than remembering it.</summary>
/// <remarks>
/// It serves twice. The depth search starts from the simplex that it ended with. And while the bodies have hardly moved against each
/// other, there is no test at all: shapes that were farther apart than they can have come closer since still have no contacts, and
/// contacts are carried along with the surfaces that they lie on.
/// </remarks>
// What carrying contacts along costs in accuracy: a vertex that rests on a face is followed exactly, as the face turns with its body;
// other features slide by the square of the angle, which the tolerance bounds to 1e-6 of the size. The normal turns with the larger
// shape; where it belongs to the smaller, it lags by up to Tolerance rad until the next test.
// The first three rows are gathered and scattered as bundles: size and alignment are multiples of a row of eight floats.
unsafe struct PairHistory
{
    /// <summary>Where the depth search ended, and which corners were the first contacts.</summary>
    public DepthSearchState Search;

    Quaternion orientationA;
    Quaternion orientationB;
    ConvexContactManifold manifold;
    // Upper bound of the depth of the pair; the margin that its contacts were found with.
    float depth;
    float margin;
    // Distance from each centre to the farthest point of the shape.
    float reachA;
    float reachB;
    // Steps until the next test, come what may; zero where nothing is known.
    int remaining;
    ShapeIdentity shapeA;
    ShapeIdentity shapeB;
    int padding0, padding1, padding2, padding3;

    /// <summary>Greatest displacement, against each other, of bodies whose contacts are carried along; part of the smaller's reach.</summary>
    public const float Tolerance = 1e-3f;

    /// <summary>
    /// Steps after which a pair is tested even though it has not moved: a bound for the drift of carried contacts, and for how long a
    /// shape that was changed in place keeps the contacts of its old form.
    /// </summary>
    public const int Lifetime = 16;

    // Relative rounding of offsets and depths, with room: what shapes that are apart must be farther apart by.
    const float Rounding = 1e-5f;

    /// <summary>Forgets everything unless the pair has the shapes that the history is about.</summary>
    public void Identify(in ShapeIdentity a, in ShapeIdentity b)
    {
        if (shapeA == a && shapeB == b)
            return;
        this = default;
        shapeA = a;
        shapeB = b;
    }

    /// <summary>Records the outcome of a test.</summary>
    /// <param name="found">Contacts, as they were found.</param>
    /// <param name="measures">What the test knows besides.</param>
    /// <param name="turnA">Orientation of A.</param>
    /// <param name="turnB">Orientation of B.</param>
    /// <param name="speculativeMargin">Margin of the test.</param>
    /// <param name="leastCarriedCount">Number of contacts from which on they may be carried along.</param>
    public void Record(in ConvexContactManifold found, in PairMeasures measures, in Quaternion turnA, in Quaternion turnB, float speculativeMargin,
        int leastCarriedCount)
    {
        manifold = found;
        orientationA = turnA;
        orientationB = turnB;
        depth = measures.Depth;
        margin = speculativeMargin;
        reachA = measures.ReachA;
        reachB = measures.ReachB;
        remaining = found.Count == 0 || found.Count >= leastCarriedCount ? Lifetime : 0;
    }

    /// <summary>Finds the contacts without a test, if the bodies have hardly moved since the last one.</summary>
    /// <param name="offsetB">Position of B less that of A.</param>
    /// <param name="currentA">Orientation of A.</param>
    /// <param name="currentB">Orientation of B.</param>
    /// <param name="speculativeMargin">Distance up to which contacts are wanted.</param>
    /// <param name="result">The contacts; written only on success.</param>
    /// <returns>Whether that was possible.</returns>
    public bool TryReuse(in Vector3 offsetB, in Quaternion currentA, in Quaternion currentB, float speculativeMargin,
        ref ConvexContactManifold result)
    {
        if (remaining == 0)
            return false;
        --remaining;
        var turnA = Exact.Concatenate(Exact.Conjugate(orientationA), currentA);
        var turnB = Exact.Concatenate(Exact.Conjugate(orientationB), currentB);
        var aIsLarger = reachA > reachB;
        var displacement = Displacement(offsetB, aIsLarger ? turnA : turnB, aIsLarger ? turnB : turnA, aIsLarger ? reachB : reachA);
        if (manifold.Count == 0)
        {
            if (!(displacement + speculativeMargin < -depth - Rounding * (reachA + reachB)))
                return false;
            result.Count = 0;
            result.OffsetB = offsetB;
            result.Normal = default;
            return true;
        }
        var allowed = Tolerance * (aIsLarger ? reachB : reachA);
        if (!(displacement < allowed && (speculativeMargin <= margin || speculativeMargin <= allowed)))
            return false;
        Carry(offsetB, turnA, turnB, aIsLarger, ref result);
        return true;
    }

    static int SearchRowCount => sizeof(DepthSearchState) / (Rows8.Count * sizeof(float));

    /// <summary>Reads the state of the search of each lane; zero for lanes without a history.</summary>
    public static void GatherSearch(PairHistory* histories, Vector<int> indices, out DepthSearchStateWide state)
    {
        if (Vector.LessThanAll(indices, Vector<int>.Zero))
        {
            state = default;
            return;
        }
        // Empty lanes read the first history, which is nobody's and zero.
        Unsafe.SkipInit(out state);
        ref var target = ref Unsafe.As<DepthSearchStateWide, Rows8>(ref state);
        for (int i = 0; i < SearchRowCount; ++i)
            Unsafe.Add(ref target, i) = Transpose.Gather((float*)histories + i * Rows8.Count, sizeof(PairHistory) / sizeof(float), indices);
    }

    /// <summary>Writes the state of the search of each lane that has a history.</summary>
    public static void ScatterSearch(PairHistory* histories, Vector<int> indices, in DepthSearchStateWide state)
    {
        if (Vector.LessThanAll(indices, Vector<int>.Zero))
            return;
        ref var source = ref Unsafe.As<DepthSearchStateWide, Rows8>(ref Unsafe.AsRef(in state));
        for (int i = 0; i < SearchRowCount; ++i)
            Transpose.Scatter(Unsafe.Add(ref source, i), (float*)histories + i * Rows8.Count, sizeof(PairHistory) / sizeof(float), indices);
    }

    /// <summary>Upper bound of how far any point of the smaller shape has moved, as the larger one sees it.</summary>
    // Unit quaternions q and r that differ by a rotation of t have |q - r| = 2 sin(t / 4); a point at a distance of 1 moves by
    // 2 sin(t / 2) = 4 sin(t / 4) cos(t / 4) <= 2 |q - r|. A dot product near one would lose the angle to rounding.
    readonly float Displacement(in Vector3 offsetB, in Quaternion turnLarger, in Quaternion turnSmaller, float reachSmaller)
    {
        var translation = Exact.Distance(offsetB, Exact.Rotate(manifold.OffsetB, turnLarger));
        var sign = Exact.Dot(turnLarger, turnSmaller) < 0 ? -1f : 1f;
        var x = turnLarger.X - sign * turnSmaller.X;
        var y = turnLarger.Y - sign * turnSmaller.Y;
        var z = turnLarger.Z - sign * turnSmaller.Z;
        var w = turnLarger.W - sign * turnSmaller.W;
        return translation + 2 * reachSmaller * MathF.Sqrt(x * x + y * y + z * z + w * w);
    }

    // Each contact is a point of A's surface and one of B's, half its depth to either side.
    readonly void Carry(in Vector3 offsetB, in Quaternion turnA, in Quaternion turnB, bool aIsLarger, ref ConvexContactManifold result)
    {
        Matrix3x3.CreateFromQuaternion(turnA, out var rotationA);
        Matrix3x3.CreateFromQuaternion(turnB, out var rotationB);
        var normal = manifold.Normal;
        result.Count = manifold.Count;
        result.OffsetB = offsetB;
        Matrix3x3.Transform(normal, aIsLarger ? rotationA : rotationB, out result.Normal);
        var source = manifold;
        for (int i = 0; i < manifold.Count; ++i)
        {
            ref readonly var contact = ref ConvexContactManifold.GetConvexContactReference(ref source, i);
            ref var carried = ref ConvexContactManifold.GetConvexContactReference(ref result, i);
            var halfway = normal * (contact.Depth * 0.5f);
            Matrix3x3.Transform(contact.Offset - halfway, rotationA, out var pointA);
            Matrix3x3.Transform(contact.Offset + halfway - manifold.OffsetB, rotationB, out var pointB);
            pointB += offsetB;
            carried.Offset = (pointA + pointB) * 0.5f;
            carried.Depth = Exact.Dot(pointB - pointA, result.Normal);
            carried.FeatureId = contact.FeatureId;
        }
    }
}

/// <summary>Names the shape of a collidable for as long as it exists: a later one in the same slot has another generation.</summary>
/// <param name="Shape">Where the shape is.</param>
/// <param name="Generation">How many shapes were in that place before.</param>
readonly record struct ShapeIdentity(TypedIndex Shape, int Generation);
