using System;
using System.Linq;
using System.Numerics;

namespace DemoTests.Collidables;

/// <summary>
/// The hull of a few points by trying every triangle in whole numbers of any length, and its moments in double precision. No two points are
/// in one plane with two others: each is moved by a pseudorandom part of a billionth of the finest float, which changes no moment.
/// </summary>
sealed class ExactHull
{
    double volume;
    readonly double[] second = new double[6];

    public ExactHull(Vector3[] points)
    {
        var random = new Random(1);
        points = [.. points.Distinct()];
        // Floats as whole numbers of the finest float's unit, and thirty bits below it.
        var least = points.SelectMany(p => new[] { p.X, p.Y, p.Z }).Where(x => x != 0).Min(x => MathF.ILogB(x)) - 23;
        var exact = points.Select(p => (X: Whole(p.X), Y: Whole(p.Y), Z: Whole(p.Z))).ToArray();
        var relative = points.Select(p => ((double)p.X - points[0].X, (double)p.Y - points[0].Y, (double)p.Z - points[0].Z)).ToArray();
        double firstX = 0, firstY = 0, firstZ = 0;
        for (int a = 0; a < points.Length; ++a)
        {
            for (int b = a + 1; b < points.Length; ++b)
            {
                for (int c = b + 1; c < points.Length; ++c)
                {
                    var signs = Enumerable.Range(0, points.Length).Where(p => p != a && p != b && p != c).Select(p => Side(a, b, c, p)).Distinct().ToArray();
                    if (signs.Length != 1)
                        continue;
                    // Counterclockwise seen from outside when the others are below.
                    Add(relative[a], relative[signs[0] < 0 ? b : c], relative[signs[0] < 0 ? c : b]);
                }
            }
        }
        double x = firstX / volume, y = firstY / volume, z = firstZ / volume;
        double[] square = [x * x, y * x, y * y, z * x, z * y, z * z];
        for (int i = 0; i < 6; ++i)
            second[i] = second[i] / volume - square[i];

        BigInteger Whole(float value) => (new BigInteger(Math.ScaleB((double)value, -least)) << 30) + random.Next(-100, 100);

        int Side(int a, int b, int c, int p)
        {
            var (u, v, w) = (Minus(b, a), Minus(c, a), Minus(p, a));
            return (w.X * (u.Y * v.Z - u.Z * v.Y) + w.Y * (u.Z * v.X - u.X * v.Z) + w.Z * (u.X * v.Y - u.Y * v.X)).Sign;
        }

        (BigInteger X, BigInteger Y, BigInteger Z) Minus(int i, int j) => (exact[i].X - exact[j].X, exact[i].Y - exact[j].Y, exact[i].Z - exact[j].Z);

        void Add((double X, double Y, double Z) p, (double X, double Y, double Z) q, (double X, double Y, double Z) r)
        {
            var six = p.X * (q.Y * r.Z - q.Z * r.Y) + p.Y * (q.Z * r.X - q.X * r.Z) + p.Z * (q.X * r.Y - q.Y * r.X);
            double sumX = p.X + q.X + r.X, sumY = p.Y + q.Y + r.Y, sumZ = p.Z + q.Z + r.Z;
            volume += six / 6;
            firstX += six * sumX / 24;
            firstY += six * sumY / 24;
            firstZ += six * sumZ / 24;
            second[0] += six / 120 * (p.X * p.X + q.X * q.X + r.X * r.X + sumX * sumX);
            second[1] += six / 120 * (p.Y * p.X + q.Y * q.X + r.Y * r.X + sumY * sumX);
            second[2] += six / 120 * (p.Y * p.Y + q.Y * q.Y + r.Y * r.Y + sumY * sumY);
            second[3] += six / 120 * (p.Z * p.X + q.Z * q.X + r.Z * r.X + sumZ * sumX);
            second[4] += six / 120 * (p.Z * p.Y + q.Z * q.Y + r.Z * r.Y + sumZ * sumY);
            second[5] += six / 120 * (p.Z * p.Z + q.Z * q.Z + r.Z * r.Z + sumZ * sumZ);
        }
    }

    /// <summary>Entries XX, YX, YY, ZX, ZY, ZZ about the centre of mass.</summary>
    public double[] Inertia(double mass) =>
    [
        mass * (second[2] + second[5]), -mass * second[1], mass * (second[0] + second[5]),
        -mass * second[3], -mass * second[4], mass * (second[0] + second[2]),
    ];

    /// <summary>The inverse of <see cref="Inertia"/>, by cofactors.</summary>
    public double[] InverseInertia(double mass)
    {
        var i = Inertia(mass);
        double xx = i[2] * i[5] - i[4] * i[4], yx = i[3] * i[4] - i[1] * i[5], zx = i[1] * i[4] - i[2] * i[3];
        var scale = 1 / (i[0] * xx + i[1] * yx + i[3] * zx);
        return [xx * scale, yx * scale, (i[0] * i[5] - i[3] * i[3]) * scale,
            zx * scale, (i[1] * i[3] - i[0] * i[4]) * scale, (i[0] * i[2] - i[1] * i[1]) * scale];
    }
}
