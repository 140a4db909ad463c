using System;
using System.Collections.Generic;
using Demos.References;

namespace DemoTests.Support;

/// <summary>Depth of two cylinders in A's frame.</summary>
/// <remarks>
/// f(m) = rA |m across a| + hA |m.a| + rB |m across b| + hB |m.b| - m.o with the axes a and b. It has creases across a and across b: those
/// circles are searched alone, with their corners a, b and a x b. Elsewhere it is smooth, and Newton steps find its minima. Where they are to
/// start is told by branches and bounds, which also show in the end that nothing is less.
/// </remarks>
sealed class ConvexCylinders : IConvexSearch
{
    // Radians: smooth minima that are as good as the least, but for the tolerance of the candidates, are looked for from all triangles of this
    // size where they may be.
    const double StartAngle = 0.1;
    // Part of the smaller size: nothing is less by more than this.
    const double Gap = 2e-7;
    // Around one axis, and along parallel ones, a whole circle of directions is as good, to rounding.
    const int GreatestTriangleCount = 5000;

    readonly double radiusA;
    readonly double halfLengthA;
    readonly double radiusB;
    readonly double halfLengthB;
    readonly Double3 axisA = new(0, 1, 0);
    readonly Double3 axisB;
    readonly Double3 pole;
    readonly List<Double3> specials = [];
    readonly List<Double3> minima = [];
    readonly double gap;

    public ConvexCylinders(ConvexShape a, ConvexShape b, ConvexRotation rotation)
    {
        (radiusA, halfLengthA, radiusB, halfLengthB) = (a.Radius, a.HalfLength, b.Radius, b.HalfLength);
        axisB = rotation.Y;
        gap = Gap * Math.Min(a.OuterRadius, b.OuterRadius);
        var cross = Double3.Cross(axisA, axisB);
        pole = cross.Length > 1e-12 ? cross * (1 / cross.Length) : new(1, 0, 0);
        foreach (var direction in new[] { axisA, axisB, pole })
        {
            specials.Add(direction);
            specials.Add(-direction);
        }
    }

    public (double Depth, double AxisDepth) Find(Double3 offset, ConvexCandidates found)
    {
        foreach (var direction in specials)
            found.Add(Value(direction, offset), direction);
        SearchCircle(axisA, offset, found);
        SearchCircle(axisB, offset, found);
        void Visit(Double3 m) => Descend(m, offset, found);
        Double3 Support(Double3 m) => FarthestPoint(m, out _, out _, out _, out _) - offset;
        ConvexBranching.Search(Support, () => found.Least + found.Tolerance, Visit, StartAngle, GreatestTriangleCount);
        ConvexBranching.Search(Support, () => found.Least - gap, Visit, 0, GreatestTriangleCount);
        return (found.Least, found.Least);
    }

    static Double3 Across(Double3 v, Double3 axis) => v - axis * Double3.Dot(v, axis);

    double Value(Double3 m, Double3 offset) => Extent(m) - Double3.Dot(m, offset);

    double Extent(Double3 m)
    {
        var alongB = Double3.Dot(m, axisB);
        // The rounding of the difference of squares would matter near the axis; the product with it does not have any.
        var acrossB = Double3.Cross(m, axisB).Length;
        return radiusA * Math.Sqrt(m.X * m.X + m.Z * m.Z) + halfLengthA * Math.Abs(m.Y) + radiusB * acrossB + halfLengthB * Math.Abs(alongB);
    }

    void SearchCircle(Double3 axis, Double3 offset, ConvexCandidates found)
    {
        minima.Clear();
        var limit = found.Least + found.Tolerance;
        var slope = radiusA + halfLengthA + radiusB + halfLengthB + offset.Length;
        ConvexArc.Minimise(pole, Double3.Cross(axis, pole), 2 * Math.PI, slope, ref limit, found.Tolerance, m => Value(m, offset), minima);
        foreach (var m in minima)
        {
            var unit = m * (1 / m.Length);
            found.Add(Value(unit, offset), unit);
        }
    }

    /// <summary>Farthest point of the difference, but for the offset.</summary>
    Double3 FarthestPoint(Double3 m, out Double3 sideA, out Double3 sideB, out double lengthA, out double lengthB)
    {
        sideA = Across(m, axisA);
        sideB = Across(m, axisB);
        (lengthA, lengthB) = (sideA.Length, sideB.Length);
        sideA *= lengthA > 0 ? 1 / lengthA : 0;
        sideB *= lengthB > 0 ? 1 / lengthB : 0;
        return sideA * radiusA + axisA * (halfLengthA * Math.Sign(Double3.Dot(m, axisA)))
            + sideB * radiusB + axisB * (halfLengthB * Math.Sign(Double3.Dot(m, axisB)));
    }

    /// <summary>
    /// Newton steps in the plane across the direction, shortened until they descend; a step along the slope where f is no bowl. Steps that have
    /// to be short end at a crease, and would only creep along it.
    /// </summary>
    void Descend(Double3 m, Double3 offset, ConvexCandidates found)
    {
        var value = Value(m, offset);
        // Below the rounding of the terms that make up f nothing is gained.
        var least = 1e-15 * (radiusA + halfLengthA + radiusB + halfLengthB);
        for (int i = 0; i < 60; ++i)
        {
            var support = FarthestPoint(m, out var sideA, out var sideB, out var lengthA, out var lengthB) - offset;
            if (lengthA < 1e-12 || lengthB < 1e-12)
                break;
            var t = Double3.Cross(m, Math.Abs(m.X) < 0.6 ? new(1, 0, 0) : new(0, 1, 0));
            t *= 1 / t.Length;
            var b = Double3.Cross(m, t);
            double gradientT = Double3.Dot(support, t), gradientB = Double3.Dot(support, b);
            var bendA = Double3.Cross(axisA, sideA);
            var bendB = Double3.Cross(axisB, sideB);
            double at = Double3.Dot(bendA, t), ab = Double3.Dot(bendA, b), bt = Double3.Dot(bendB, t), bb = Double3.Dot(bendB, b);
            double curveA = radiusA / lengthA, curveB = radiusB / lengthB;
            var tt = curveA * at * at + curveB * bt * bt - value;
            var tb = curveA * at * ab + curveB * bt * bb;
            var bbSum = curveA * ab * ab + curveB * bb * bb - value;
            var determinant = tt * bbSum - tb * tb;
            double stepT, stepB;
            if (tt > 0 && determinant > 1e-12 * tt * Math.Abs(bbSum))
                (stepT, stepB) = ((tb * gradientB - bbSum * gradientT) / determinant, (tb * gradientT - tt * gradientB) / determinant);
            else
            {
                var scale = 0.1 / Math.Max(1e-300, Math.Sqrt(gradientT * gradientT + gradientB * gradientB));
                (stepT, stepB) = (-gradientT * scale, -gradientB * scale);
            }
            var length = Math.Sqrt(stepT * stepT + stepB * stepB);
            var fraction = length > 0.3 ? 0.3 / length : 1;
            var improved = false;
            for (int j = 0; j < 12 && !improved; ++j, fraction *= 0.5)
            {
                var next = m + t * (stepT * fraction) + b * (stepB * fraction);
                next *= 1 / next.Length;
                var nextValue = Value(next, offset);
                if (nextValue < value - least)
                {
                    (m, value) = (next, nextValue);
                    improved = true;
                }
            }
            if (!improved || length < 1e-13)
                break;
        }
        found.Add(value, m);
    }
}
