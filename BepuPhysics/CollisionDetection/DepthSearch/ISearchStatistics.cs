using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>Counts what a search does. The empty one costs nothing.</summary>
interface ISearchStatistics
{
    /// <summary>A pair of support points was asked for in the lanes that are set.</summary>
    void Evaluated(Vector<int> mask);

    /// <summary>A descent ended at its limit in the lanes that are set.</summary>
    void Capped(Vector<int> mask);

    /// <summary>The free tetrahedron was tried in the lanes of the first mask, and showed that the depth is the least in those of the second.</summary>
    void TriedTetrahedron(Vector<int> triedMask, Vector<int> certifiedMask);

    /// <summary>A number of support points around the minimum was asked for in the lanes that are set.</summary>
    void EvaluatedRing(Vector<int> mask, int count);

    /// <summary>The polytope was expanded for a lane.</summary>
    void Expanded(int lane, int evaluations, ExpansionEnd end);
}

/// <summary>Counts nothing.</summary>
readonly struct NoSearchStatistics : ISearchStatistics
{
    public void Evaluated(Vector<int> mask) { }

    public void Capped(Vector<int> mask) { }

    public void TriedTetrahedron(Vector<int> triedMask, Vector<int> certifiedMask) { }

    public void EvaluatedRing(Vector<int> mask, int count) { }

    public void Expanded(int lane, int evaluations, ExpansionEnd end) { }
}

/// <summary>Why the expansion of a polytope ended.</summary>
enum ExpansionEnd
{
    /// <summary>No direction is better by more than the slack.</summary>
    Certified,
    /// <summary>A direction was found in which the cores do not overlap.</summary>
    Apart,
    /// <summary>The difference has no volume; its thin side was looked at.</summary>
    Flat,
    /// <summary>Too many evaluations or faces.</summary>
    Limit,
}
