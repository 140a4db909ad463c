using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>What is remembered of the last test of a pair, for pairs whose test costs more than remembering it.</summary>
/// <remarks>
/// A record of three parts, each with its own type: whether the outcome still holds (<see cref="RetestBound"/>), the contacts to carry along while it
/// does (<see cref="CarriedContacts"/>), and the simplex that the next search starts with when it does not (<see cref="DepthSearchState"/>). The record
/// itself knows which shapes they are of, where they lie, and how bundles of them are read and written.
/// </remarks>
// Four cache lines. The first decides whether there will be a test, and is all that a pair without contacts needs. But for the second row of eight
// floats, all is written as bundles, and the search's state is read so.
[StructLayout(LayoutKind.Sequential, Size = 4 * CacheLine)]
unsafe partial struct PairHistory
{
    RetestBound bound;
    // Whether the last search took more support points than a quick one does.
    bool isSlow;
    ShapeIdentity shapeA;
    ShapeIdentity shapeB;
    int padding;

    /// <summary>Where the depth search ended, and which corners were the first contacts.</summary>
    public DepthSearchState Search;

    CarriedContacts contacts;

    const int CacheLine = 64;

    // Support points of a search beyond which it is a slow one: a step of a descent costs several times what finding the old simplex right does.
    const int QuickEvaluations = 1;
    const int SlowFlag = 1 << 30;

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
        if (!bound.Holds(offsetB, currentA, currentB, speculativeMargin, out var translation, out var rotation))
            return false;
        if (bound.ContactMask == 0)
        {
            result.Count = 0;
            result.OffsetB = offsetB;
            result.Normal = default;
            return true;
        }
        contacts.Carry(bound, bound.ContactMask, offsetB, translation, rotation, bound.AIsLarger ? currentA : currentB, rolls: false, ref result);
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
}
