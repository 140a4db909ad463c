using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>What a test knows of a pair besides its contacts.</summary>
struct PairMeasures
{
    /// <summary>Upper bound of the pair's depth, m: shapes are apart by at least its negation.</summary>
    public float Depth;
    /// <summary>Distance from A's centre to the farthest point of A, m.</summary>
    public float ReachA;
    /// <summary>Distance from B's centre to the farthest point of B, m.</summary>
    public float ReachB;
    /// <summary>Number of support points that the descent took; certificates are rare, and not in it.</summary>
    public int Evaluations;
}

/// <summary>A bundle of <see cref="PairMeasures"/>.</summary>
struct PairMeasuresWide : IWide<PairMeasures>
{
    /// <inheritdoc cref="PairMeasures.Depth"/>
    public Vector<float> Depth;
    /// <inheritdoc cref="PairMeasures.ReachA"/>
    public Vector<float> ReachA;
    /// <inheritdoc cref="PairMeasures.ReachB"/>
    public Vector<float> ReachB;
    /// <inheritdoc cref="PairMeasures.Evaluations"/>
    public Vector<int> Evaluations;

    /// <summary>Distance from the centre of a shape to its farthest point, m.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector<float> Reach<TShapeWide, TSupport>(in TShapeWide shape)
        where TShapeWide : unmanaged where TSupport : unmanaged, ISupport<TShapeWide>
    {
        TSupport.GetExtents(shape, out var center, out _, out var outer);
        return center.Length() + outer + TSupport.Margin(shape);
    }
}
