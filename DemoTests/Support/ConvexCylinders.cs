using System;
using System.Collections.Generic;

namespace DemoTests.Support;

/// <summary>Depth of two cylinders in A's frame.</summary>
/// <remarks>
/// f(m) = rA |m across a| + hA |m.a| + rB |m across b| + hB |m.b| - m.o with the axes a and b. It has creases across a and across b: those
/// circles are searched alone, with their corners a, b and a x b. They cut the sphere into four lunes, in which f is smooth except at a
/// and b: a grid over each lune finds where to start, and Newton steps go on from there.
/// </remarks>
sealed class ConvexCylinders : IConvexSearch
{
    const int RowCount = 33;
    const int ColumnCount = 13;
    const int MaximumStartCount = 6;
    // Radians.
    const double BesideCrease = 1e-3;

    readonly double radiusA;
    readonly double halfLengthA;
    readonly double radiusB;
    readonly double halfLengthB;
    readonly Double3 axisA = new(0, 1, 0);
    readonly Double3 axisB;
    readonly Double3 pole;
    readonly List<Double3> specials = [];
    // By lune, row and column.
    readonly Double3[] grid = new Double3[4 * RowCount * ColumnCount];
    readonly double[] extents = new double[4 * RowCount * ColumnCount];
    readonly double[] values = new double[RowCount * ColumnCount];
    readonly List<Double3> minima = [];
    readonly List<(double Value, int Index)> starts = [];

    public ConvexCylinders(ConvexShape a, ConvexShape b, ConvexRotation rotation)
    {
        (radiusA, halfLengthA, radiusB, halfLengthB) = (a.Radius, a.HalfLength, b.Radius, b.HalfLength);
        axisB = rotation.Y;
        var cross = Double3.Cross(axisA, axisB);
        pole = cross.Length > 1e-12 ? cross * (1 / cross.Length) : new(1, 0, 0);
        foreach (var direction in new[] { axisA, axisB, pole })
        {
            specials.Add(direction);
            specials.Add(-direction);
        }
        FillGrid();
    }

    public (double Depth, double AxisDepth) Find(Double3 offset, ConvexCandidates found)
    {
        foreach (var direction in specials)
            found.Add(Value(direction, offset), direction);
        SearchCircle(axisA, offset, found);
        SearchCircle(axisB, offset, found);
        foreach (var direction in stackalloc[] { offset, Across(offset, axisA), Across(offset, axisB) })
        {
            if (direction.Length > 0)
                Descend(direction * (1 / direction.Length), offset, found);
        }
        for (int lune = 0; lune < 4; ++lune)
            SearchLune(lune, offset, found);
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
            // A bowl beside the crease may be narrower than the grid; steps that start on its side of the crease end in it.
            foreach (var side in stackalloc[] { axis, -axis })
            {
                var beside = unit + side * BesideCrease;
                Descend(beside * (1 / beside.Length), offset, found);
            }
        }
    }

    void FillGrid()
    {
        // Longitudes around the pole, from axis A: the two creases, each twice.
        var right = Double3.Cross(pole, axisA);
        var turn = Math.Atan2(Double3.Dot(axisB, right), Double3.Dot(axisB, axisA));
        double[] borders = [Wrap(Math.PI / 2), Wrap(-Math.PI / 2), Wrap(turn + Math.PI / 2), Wrap(turn - Math.PI / 2)];
        Array.Sort(borders);
        var index = 0;
        for (int lune = 0; lune < 4; ++lune)
        {
            var from = borders[lune];
            var to = lune < 3 ? borders[lune + 1] : borders[0] + 2 * Math.PI;
            for (int row = 0; row < RowCount; ++row)
            {
                var latitude = Math.PI * (row + 0.5) / RowCount;
                for (int column = 0; column < ColumnCount; ++column, ++index)
                {
                    var longitude = from + (to - from) * (column + 0.5) / ColumnCount;
                    var across = axisA * Math.Cos(longitude) + right * Math.Sin(longitude);
                    grid[index] = pole * Math.Cos(latitude) + across * Math.Sin(latitude);
                    extents[index] = Extent(grid[index]);
                }
            }
        }
    }

    static double Wrap(double angle) => angle < 0 ? angle + 2 * Math.PI : angle >= 2 * Math.PI ? angle - 2 * Math.PI : angle;

    void SearchLune(int lune, Double3 offset, ConvexCandidates found)
    {
        var start = lune * RowCount * ColumnCount;
        for (int i = 0; i < values.Length; ++i)
            values[i] = extents[start + i] - Double3.Dot(grid[start + i], offset);
        starts.Clear();
        for (int row = 0; row < RowCount; ++row)
        {
            for (int column = 0; column < ColumnCount; ++column)
            {
                if (IsLowest(row, column))
                    starts.Add((values[row * ColumnCount + column], start + row * ColumnCount + column));
            }
        }
        // A smooth lune has no more than a few bowls; there are many lowest points only where f is level.
        starts.Sort();
        for (int i = 0; i < Math.Min(starts.Count, MaximumStartCount); ++i)
            Descend(grid[starts[i].Index], offset, found);
    }

    bool IsLowest(int row, int column)
    {
        var value = values[row * ColumnCount + column];
        for (int i = Math.Max(0, row - 1); i <= Math.Min(RowCount - 1, row + 1); ++i)
        {
            for (int j = Math.Max(0, column - 1); j <= Math.Min(ColumnCount - 1, column + 1); ++j)
            {
                if (values[i * ColumnCount + j] < value)
                    return false;
            }
        }
        return true;
    }

    /// <summary>Newton steps in the plane across the direction, shortened until they descend; a step along the slope where f is no bowl.</summary>
    void Descend(Double3 m, Double3 offset, ConvexCandidates found)
    {
        var value = Value(m, offset);
        // Below the rounding of the terms that make up f nothing is gained.
        var least = 1e-15 * (radiusA + halfLengthA + radiusB + halfLengthB);
        for (int i = 0; i < 60; ++i)
        {
            var sideA = Across(m, axisA);
            var sideB = Across(m, axisB);
            double lengthA = sideA.Length, lengthB = sideB.Length;
            if (lengthA < 1e-12 || lengthB < 1e-12)
                break;
            sideA *= 1 / lengthA;
            sideB *= 1 / lengthB;
            var support = sideA * radiusA + axisA * (halfLengthA * Math.Sign(Double3.Dot(m, axisA)))
                + sideB * radiusB + axisB * (halfLengthB * Math.Sign(Double3.Dot(m, axisB))) - offset;
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
            for (int j = 0; j < 30 && !improved; ++j, fraction *= 0.5)
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
