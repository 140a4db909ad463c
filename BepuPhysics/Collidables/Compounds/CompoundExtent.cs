using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>How far the children of a compound reach, gathered child by child.</summary>
/// <remarks>
/// The reach of a compound along a direction d is h(d) = max (p.d + h_c(d)) over children c at p. It is at most R = max (|p| + R_c), and at
/// least the mean of p.d + r_c, where r_c = R_c - E_c is the least reach of a child: so at least mean(r_c) - |mean(p)|. What a turn can add is
/// no more than the difference of the two.
/// </remarks>
struct CompoundExtent
{
    public Vector3 Min, Max;
    public float MaximumRadius;
    Vector3 positionSum;
    float leastReachSum;
    int count;

    public void Add(in Vector3 min, in Vector3 max, in Vector3 position, float maximumRadius, float maximumAngularExpansion)
    {
        Min = count == 0 ? min : Exact.Min(Min, min);
        Max = count == 0 ? max : Exact.Max(Max, max);
        MaximumRadius = MathHelper.Max(MaximumRadius, Exact.Length(position) + maximumRadius);
        positionSum += position;
        leastReachSum += maximumRadius - maximumAngularExpansion;
        ++count;
    }

    /// <summary>Greatest way that a turn carries the surface out of its box.</summary>
    public readonly float MaximumAngularExpansion =>
        count == 0 ? 0 : MathHelper.Max(0, MaximumRadius + (Exact.Length(positionSum) - leastReachSum) / count);
}
