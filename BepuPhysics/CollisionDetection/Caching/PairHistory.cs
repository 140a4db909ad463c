using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints.Contact;
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
// Everything is in the axes of the larger shape, as seen from the centre of the smaller: contacts are short distances then, even on a floor
// of a kilometre.
// Four cache lines. The first decides whether there will be a test, and all that a pair without contacts needs. But for the second row of eight
// floats, all is written as bundles, and the search's state is read so.
[StructLayout(LayoutKind.Sequential, Size = 4 * CacheLine)]
unsafe partial struct PairHistory
{
    // Pose of the smaller shape in the frame of the larger at the last test.
    Quaternion turn;
    Vector3 offset;
    // Of a pair without contacts: how much closer the shapes may come, less the margin, until they can have some. Of others: the margin that
    // these were found with.
    float room;
    // Distance from the centre of the smaller shape to its farthest point.
    float reach;
    // Steps until the next test, come what may; zero where nothing is known.
    short remaining;
    // A bit for each of the places below that has a contact.
    byte contactMask;
    bool aIsLarger;
    bool isSlow;
    ShapeIdentity shapeA;
    ShapeIdentity shapeB;
    int padding;

    /// <summary>Where the depth search ended, and which corners were the first contacts.</summary>
    public DepthSearchState Search;

    Vector3 normal;
    FourVectors places;
    FourFloats depths;
    FeatureIds features;

    const int CacheLine = 64;

    /// <summary>Greatest displacement, against each other, of bodies whose contacts are carried along; part of the smaller's reach.</summary>
    public const float Tolerance = 1e-3f;

    /// <summary>
    /// Steps after which a pair is tested even though it has not moved: a bound for the drift of carried contacts, and for how long a
    /// shape that was changed in place keeps the contacts of its old form.
    /// </summary>
    public const int Lifetime = 16;

    // Support points of a search beyond which it is a slow one: a step of a walk costs several times what finding the old simplex right does.
    const int QuickEvaluations = 1;
    const int SlowFlag = 1 << 30;

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

    /// <summary>What a test is told of the pair: the index of its history, and whether the last test was a slow one.</summary>
    /// <param name="index">Index of this history.</param>
    public readonly int GetReference(int index) => isSlow ? index | SlowFlag : index;

    /// <summary>The index of a reference; negative for <see cref="PairInput.NoHistory"/>.</summary>
    public static int GetIndex(int reference) => reference < 0 ? reference : reference & ~SlowFlag;

    /// <summary>Whether the last test of a pair was a slow one, and the next will most likely be.</summary>
    public static bool IsSlow(int reference) => reference >= SlowFlag;

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
        FindPose(offsetB, currentA, currentB, out var currentTurn, out var currentOffset);
        var translation = currentOffset - offset;
        var displacement = Exact.Length(translation) + reach * Displacement(currentTurn);
        if (contactMask == 0)
        {
            if (!(displacement + speculativeMargin < room))
                return false;
            result.Count = 0;
            result.OffsetB = offsetB;
            result.Normal = default;
            return true;
        }
        var allowed = Tolerance * reach;
        if (!(displacement < allowed && (speculativeMargin <= room || speculativeMargin <= allowed)))
            return false;
        Carry(offsetB, translation, currentTurn, aIsLarger ? currentA : currentB, ref result);
        return true;
    }

    static int Stride => sizeof(PairHistory) / sizeof(float);

    static float* SearchOf(PairHistory* histories) => (float*)&histories->Search;

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
            Unsafe.Add(ref target, i) = Transpose.Gather(SearchOf(histories) + i * Rows8.Count, Stride, indices);
    }

    /// <summary>Writes the state of the search of each lane that has a history.</summary>
    public static void ScatterSearch(PairHistory* histories, Vector<int> indices, in DepthSearchStateWide state)
    {
        ref var source = ref Unsafe.As<DepthSearchStateWide, Rows8>(ref Unsafe.AsRef(in state));
        for (int i = 0; i < SearchRowCount; ++i)
            Transpose.Scatter(Unsafe.Add(ref source, i), SearchOf(histories) + i * Rows8.Count, Stride, indices);
    }

    /// <summary>Pose of the smaller shape in the frame of the larger.</summary>
    readonly void FindPose(in Vector3 offsetB, in Quaternion turnA, in Quaternion turnB, out Quaternion relative, out Vector3 place)
    {
        var toLarger = Exact.Conjugate(aIsLarger ? turnA : turnB);
        relative = Exact.Concatenate(aIsLarger ? turnB : turnA, toLarger);
        place = Exact.Rotate(aIsLarger ? offsetB : -offsetB, toLarger);
    }

    /// <summary>Upper bound of how far a point of the smaller shape at a distance of one has moved by rotation, as the larger one sees it.</summary>
    // Unit quaternions q and r that differ by a rotation of t have |q - r| = 2 sin(t / 4); a point at a distance of 1 moves by
    // 2 sin(t / 2) = 4 sin(t / 4) cos(t / 4) <= 2 |q - r|. A dot product near one would lose the angle to rounding.
    readonly float Displacement(in Quaternion current)
    {
        var sign = Exact.Dot(turn, current) < 0 ? -1f : 1f;
        var x = current.X - sign * turn.X;
        var y = current.Y - sign * turn.Y;
        var z = current.Z - sign * turn.Z;
        var w = current.W - sign * turn.W;
        return 2 * MathF.Sqrt(x * x + y * y + z * z + w * w);
    }

    // Each contact is a point of the larger shape's surface and one of the smaller's, half its depth to either side.
    readonly void Carry(in Vector3 offsetB, in Vector3 translation, in Quaternion currentTurn, in Quaternion larger, ref ConvexContactManifold result)
    {
        Matrix3x3.CreateFromQuaternion(Exact.Concatenate(Exact.Conjugate(turn), currentTurn), out var rotation);
        Matrix3x3.CreateFromQuaternion(larger, out var toWorld);
        result.OffsetB = offsetB;
        Matrix3x3.Transform(normal, toWorld, out result.Normal);
        // From the larger shape's surface to the smaller one's where they touch.
        var across = aIsLarger ? normal : -normal;
        var center = aIsLarger ? offsetB : default;
        var count = 0;
        for (int i = 0; contactMask >> i != 0; ++i)
        {
            if ((contactMask >> i & 1) == 0)
                continue;
            ref var carried = ref ConvexContactManifold.GetConvexContactReference(ref result, count++);
            var halfway = across * (depths[i] * 0.5f);
            var onLarger = places[i] - halfway - translation;
            Matrix3x3.Transform(places[i] + halfway, rotation, out var onSmaller);
            Matrix3x3.Transform((onLarger + onSmaller) * 0.5f, toWorld, out var place);
            carried.Offset = place + center;
            carried.Depth = Exact.Dot(onSmaller - onLarger, across);
            carried.FeatureId = features[i];
        }
        result.Count = count;
    }
}

/// <summary>Names the shape of a collidable for as long as it exists: a later one in the same slot has another generation.</summary>
/// <param name="Shape">Where the shape is.</param>
/// <param name="Generation">How many shapes were in that place before.</param>
readonly record struct ShapeIdentity(TypedIndex Shape, int Generation);
