using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuPhysics.CollisionDetection;

/// <summary>A corner of the overlap of two features of any kind.</summary>
struct FaceCandidate : IContactCandidate
{
    /// <summary>Position across the normal, from the witness, m.</summary>
    public Vector<float> X, Y;
    /// <summary>Depth along the normal, m; <see cref="IContactCandidate.None"/> where there is no such corner.</summary>
    public Vector<float> Depth;
    /// <summary>Tells the corners of an overlap apart; eight bits.</summary>
    public Vector<int> Name;
    /// <summary>What squared distances count by: more where the corner was one of the first two contacts the last time.</summary>
    public Vector<float> Weight;

    readonly Vector<float> IContactCandidate.X => X;

    readonly Vector<float> IContactCandidate.Y => Y;

    readonly Vector<float> IContactCandidate.Depth => Depth;

    readonly Vector<int> IContactCandidate.Name(int index) => Name;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly Vector<float> IContactCandidate.Weigh(Vector<float> squaredDistance) => squaredDistance * Weight;

    // Those that are not deep enough do not exist.
    static Vector<int> IContactCandidate.TakesPart(Vector<float> depth, Vector<float> limit) => Vector.GreaterThan(depth, limit);
}
