using System;
using System.Collections.Generic;
using System.Numerics;

namespace Demos.References;

/// <summary>
/// A flat rigid body that slides and turns on a plane, and presses evenly on it: Coulomb's law in each point of its surface, in double precision.
/// </summary>
sealed class EvenFriction
{
    const double TimeStep = 5e-4;
    const int Cells = 40;
    const int CellsOfFoot = 8;

    readonly List<(double X, double Y)> points = [];

    EvenFriction()
    {
    }

    EvenFriction(double width, double depth, bool isDisc, int cells = Cells)
    {
        for (int i = 0; i < cells; ++i)
        {
            for (int j = 0; j < cells; ++j)
            {
                double x = (i + .5) / cells - .5, y = (j + .5) / cells - .5;
                if (!isDisc || x * x + y * y < .25)
                    points.Add((x * width, y * depth));
            }
        }
    }

    public static EvenFriction Disc(double radius) => new(2 * radius, 2 * radius, isDisc: true);

    public static EvenFriction Rectangle(double width, double depth) => new(width, depth, isDisc: false);

    /// <summary>Feet that each bear as much as another: of no width in a point, elsewhere a rectangle or a disc.</summary>
    /// <param name="width">Width of each, m.</param>
    /// <param name="depth">Depth of each, m.</param>
    /// <param name="isDisc">Whether each is a disc.</param>
    /// <param name="places">Where their middles are from that of the body.</param>
    public static EvenFriction Feet(double width, double depth, bool isDisc, IEnumerable<Vector2> places)
    {
        var feet = new EvenFriction();
        var foot = new EvenFriction(width, depth, isDisc, width > 0 ? CellsOfFoot : 1);
        foreach (var place in places)
            feet.points.AddRange(foot.points.ConvertAll(point => (place.X + point.X, place.Y + point.Y)));
        return feet;
    }

    /// <summary>How far the body comes and turns until it rests, m and rad.</summary>
    /// <param name="deceleration">Coefficient of friction times gravity, m/s2.</param>
    /// <param name="squaredGyration">Moment of inertia about the vertical over mass, m2.</param>
    /// <param name="speed">Speed at the beginning, along the width, m/s.</param>
    /// <param name="spin">Angular velocity about the vertical at the beginning, rad/s.</param>
    public (double Distance, double Angle) Rest(double deceleration, double squaredGyration, double speed, double spin)
    {
        double x = 0, y = 0, angle = 0, vx = speed, vy = 0, w = spin;
        // The last of it is slower than a step can tell.
        while (vx * vx + vy * vy + w * w * squaredGyration > 1e-6)
        {
            double fx = 0, fy = 0, moment = 0, cos = Math.Cos(angle), sin = Math.Sin(angle);
            foreach (var point in points)
            {
                double px = cos * point.X - sin * point.Y, py = sin * point.X + cos * point.Y;
                double ux = vx - w * py, uy = vy + w * px;
                // Of what all but rests friction is in proportion to its speed, or it would go to and fro.
                var along = 1 / Math.Max(Math.Sqrt(ux * ux + uy * uy), deceleration * TimeStep);
                fx -= ux * along;
                fy -= uy * along;
                moment -= (px * uy - py * ux) * along;
            }
            var share = deceleration * TimeStep / points.Count;
            vx += fx * share;
            vy += fy * share;
            w += moment * share / squaredGyration;
            x += vx * TimeStep;
            y += vy * TimeStep;
            angle += w * TimeStep;
        }
        return (Math.Sqrt(x * x + y * y), angle);
    }
}
