using System;
using System.Diagnostics;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Diagnostics;

namespace BepuPhysics.Collidables;

/// <summary>How far a container reaches, its centre at the origin, m.</summary>
/// <param name="Min">Lower corner of its box.</param>
/// <param name="Max">Upper corner of its box.</param>
/// <param name="MaximumRadius">Distance to its farthest point.</param>
/// <param name="MaximumAngularExpansion">Greatest way that a turn carries its surface out of the box.</param>
readonly record struct ContainerExtent(Vector3 Min, Vector3 Max, float MaximumRadius, float MaximumAngularExpansion);

// Bounds of shapes that are measured one by one: those that are made of children.
public abstract unsafe partial class ShapeBatch
{
    /// <summary>Measures a shape that is made of children, its centre at the origin.</summary>
    private protected virtual ContainerExtent Measure(int shapeIndex, in Quaternion orientation) => throw new UnreachableException();

    /// <summary>Bounds of a bundle of shapes that are made of children; see <see cref="GetBounds"/>.</summary>
    private protected void GetBoundsOneByOne(ReadOnlySpan<int> shapeIndices, in QuaternionWide orientations, out Vector<float> maximumRadius,
        out Vector<float> maximumAngularExpansion, out Vector3Wide min, out Vector3Wide max)
    {
        Check.That(shapeIndices.Length <= Vector<float>.Count);
        maximumRadius = maximumAngularExpansion = default;
        min = max = default;
        var turns = orientations;
        for (int lane = 0; lane < shapeIndices.Length; ++lane)
        {
            if (shapeIndices[lane] < 0)
                continue;
            var extent = Measure(shapeIndices[lane], Lanes.Read<Quaternion, QuaternionWide>(ref turns, lane));
            GatherScatter.Get(ref maximumRadius, lane) = extent.MaximumRadius;
            GatherScatter.Get(ref maximumAngularExpansion, lane) = extent.MaximumAngularExpansion;
            Lanes.Write(extent.Min, ref min, lane);
            Lanes.Write(extent.Max, ref max, lane);
        }
    }
}
