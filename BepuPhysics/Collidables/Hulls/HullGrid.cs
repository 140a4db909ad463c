using System;
using System.Numerics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>The points of a hull on a grid of whole numbers, and what counts as nothing there.</summary>
/// <remarks>
/// The grid is as fine as exact predicates in 128 bits allow: 2^39 to 2^40 cells along the longest side of the points' box, so that snapping
/// to it is a millionth of what rounding to a float was.
/// Then each point is moved by up to 32 cells (6e-11 of the size), by a number drawn from its own coordinates. Points in one plane or on one
/// line, which is what users have most of, are so brought into general position, and the builder meets nothing but ordinary points: a flat
/// face of ten thousand points costs as much as ten thousand points of a sphere. Equal points are moved alike and stay equal.
/// </remarks>
struct HullGrid
{
    const int Bits = 40;
    const double MaximumMove = 32;
    // Extents whose squares and cubes leave the range of a float have no use as shapes.
    const double MinimumExtent = 1e-18, MaximumExtent = 1e18;

    /// <summary>Whether the longest side of a box is that of a shape.</summary>
    public static bool IsSizeInRange(double extent) => extent >= MinimumExtent && extent <= MaximumExtent;

    /// <summary>What two points may differ by and still be one, and a point lie outside of the hull, relative to the thickness.</summary>
    const double ToleranceOfThickness = 3e-5;
    /// <summary>The same relative to the size: no rounding, however large, excuses more.</summary>
    const double MaximumToleranceOfSize = 3e-5;
    /// <summary>The same relative to the thickness: no rounding excuses an error of the volume above a percent.</summary>
    const double MaximumToleranceOfThickness = 1e-3;
    /// <summary>Thickness below which points are flat, relative to the size.</summary>
    const double MinimumThickness = 1e-5;
    /// <summary>Rounding of a coordinate to a float, four times over, relative to the largest coordinate.</summary>
    const double RoundingTolerance = 1.0 / (1 << 22);
    /// <summary>Thickness below which points may be flat but for their rounding, relative to the largest coordinate: four times the gap
    /// between two floats.</summary>
    const double RoundingThickness = 4.0 / (1 << 23);

    /// <summary>The points on the grid.</summary>
    public Buffer<HullPoint> Points;
    /// <summary>Middle of the points' box.</summary>
    public HullPoint Middle;
    /// <summary>Longest side of the points' box, cells.</summary>
    public double Size;
    /// <summary>Thickness below which the points are flat, cells.</summary>
    public double FlatThickness;

    double largestCoordinate;

    /// <summary>Puts points on a grid.</summary>
    /// <returns>Why that is not possible.</returns>
    /// <exception cref="ArgumentException">A point is not finite.</exception>
    public static HullFailure TryCreate(ReadOnlySpan<Vector3> points, BufferPool pool, out HullGrid grid)
    {
        grid = default;
        CheckFinite(points);
        if (points.Length < 4)
            return HullFailure.TooFewPoints;
        Vector3 min = points[0], max = points[0];
        foreach (ref readonly var point in points)
        {
            min = new(Math.Min(min.X, point.X), Math.Min(min.Y, point.Y), Math.Min(min.Z, point.Z));
            max = new(Math.Max(max.X, point.X), Math.Max(max.Y, point.Y), Math.Max(max.Z, point.Z));
        }
        var extent = Math.Max(Math.Max((double)max.X - min.X, (double)max.Y - min.Y), (double)max.Z - min.Z);
        if (extent == 0)
            return HullFailure.AllPointsCoincide;
        if (!IsSizeInRange(extent))
            return HullFailure.SizeOutOfRange;

        // A power of two, which rounds nothing.
        var cellsPerMetre = Math.ScaleB(1, Bits - 1 - Math.ILogB(extent));
        grid.Size = extent * cellsPerMetre;
        grid.largestCoordinate = cellsPerMetre * Math.Max(
            Math.Max(Math.Max(Math.Abs(min.X), Math.Abs(max.X)), Math.Max(Math.Abs(min.Y), Math.Abs(max.Y))),
            Math.Max(Math.Abs(min.Z), Math.Abs(max.Z)));
        grid.FlatThickness = Math.Max(MinimumThickness * grid.Size, RoundingThickness * grid.largestCoordinate);
        grid.Middle = new HullPoint((double)max.X - min.X, (double)max.Y - min.Y, (double)max.Z - min.Z) * (0.5 * cellsPerMetre);
        pool.Take(points.Length, out grid.Points);
        for (int i = 0; i < points.Length; ++i)
        {
            ref readonly var point = ref points[i];
            grid.Points[i] = Move(
                Math.Round(((double)point.X - min.X) * cellsPerMetre),
                Math.Round(((double)point.Y - min.Y) * cellsPerMetre),
                Math.Round(((double)point.Z - min.Z) * cellsPerMetre));
        }
        return HullFailure.None;
    }

    /// <summary>How far points may be outside of the hull, and vertices of a face from its plane, cells.</summary>
    /// <param name="thickness">Least extent of the points in any direction, roughly.</param>
    public readonly double Tolerance(double thickness) => Math.Min(
        Math.Max(ToleranceOfThickness * thickness, RoundingTolerance * largestCoordinate),
        Math.Min(MaximumToleranceOfSize * Size, MaximumToleranceOfThickness * thickness));

    public void Dispose(BufferPool pool)
    {
        pool.ReturnIfTaken(ref Points);
    }

    static void CheckFinite(ReadOnlySpan<Vector3> points)
    {
        for (int i = 0; i < points.Length; ++i)
        {
            if (!float.IsFinite(points[i].X) || !float.IsFinite(points[i].Y) || !float.IsFinite(points[i].Z))
                throw new ArgumentException($"Points of a convex hull must be finite; point {i} is {points[i]}.", nameof(points));
        }
    }

    static HullPoint Move(double x, double y, double z)
    {
        var bits = Mix(Mix(Mix((ulong)(long)x) ^ (ulong)(long)y) ^ (ulong)(long)z);
        // Three numbers from -32 to 31.
        return new(x + (bits & 63) - MaximumMove, y + (bits >> 6 & 63) - MaximumMove, z + (bits >> 12 & 63) - MaximumMove);
    }

    // The finaliser of the splitmix64 generator (Steele, Lea and Flood, 2014): every bit of the result depends on every bit given.
    static ulong Mix(ulong bits)
    {
        bits += 0x9E3779B97F4A7C15;
        bits = (bits ^ bits >> 30) * 0xBF58476D1CE4E5B9;
        bits = (bits ^ bits >> 27) * 0x94D049BB133111EB;
        return bits ^ bits >> 31;
    }
}
