using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>Counts the support points of each lane's descent, by which slow lanes are told from quick ones.</summary>
struct SearchEffort : ISearchStatistics
{
    /// <summary>Number of support points of each shape.</summary>
    public Vector<int> Evaluations;

    // Masks are -1.
    public void Evaluated(Vector<int> mask) => Evaluations -= mask;

    public readonly void Capped(Vector<int> mask) { }

    public readonly void TriedTetrahedron(Vector<int> triedMask, Vector<int> certifiedMask) { }

    public readonly void EvaluatedRing(Vector<int> mask, int count) { }

    public readonly void Expanded(int lane, int evaluations, ExpansionEnd end) { }
}
