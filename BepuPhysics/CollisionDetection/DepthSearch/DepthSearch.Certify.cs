using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

public static partial class DepthSearch<TShapeWideA, TSupportA, TShapeWideB, TSupportB>
{
    /// <summary>Shows that the depth of the lanes that are set is the least of all directions, or finds a better one.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Certify<TStatistics>(in TShapeWideA a, in TShapeWideB b, in SearchFrame frame, Vector<int> dueMask, Vector<int> knownMask,
        ref SearchWalk walk, ref TStatistics statistics)
        where TStatistics : struct, ISearchStatistics
    {
    }
}
