using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;

namespace DemoTests.Constraints;

/// <summary>Friction of a patch that slides and turns, in double precision and by the rows: along x and y of the surface, and about its normal.</summary>
static class SlidingReference
{
    const double GreatestTumble = .05;

    /// <summary>What a sweep without it made of the friction of a contact is made to what slides.</summary>
    // Velocities and impulses at the start are those after the normal rows.
    public static void Slide(
        RowBench bench, int typeId, ConstraintRow[] rows, double[] startVelocities, double[] startImpulses, double[] velocities, double[] impulses)
    {
        var contacts = ConstraintTypeIds.ContactCount(typeId);
        var (friction, joins) = (rows[contacts..], Joins(bench, typeId));
        var start = startImpulses[contacts..];
        var normals = startImpulses[..contacts];
        var load = normals.Sum();
        var isHeld = float.IsNegative(bench.Prestep(ContactPrestepLayout.Spring(contacts)));
        if (load <= 0 || isHeld || (contacts == 1 && !joins))
            return;
        var maximum = friction[0].FrictionCoefficient * load;
        var bound = contacts > 1 ? friction[0].FrictionCoefficient * normals.Zip(rows, (impulse, row) => impulse * row.Lever).Sum() : 0;
        if (Length(start[0], start[1]) <= .7 * maximum && Math.Abs(start[2]) <= .3 * bound)
            return;
        double[] motion = [.. friction.Select(row => RowTests.Dot(bench.Jacobian(row), startVelocities))];
        var normal = rows[0].A.Linear;
        var turn = AngularVelocity(startVelocities, 0) - (bench.BodyCount > 1 ? AngularVelocity(startVelocities, 1) : default);
        if ((turn - normal * (float)motion[2]).Length() >= GreatestTumble * 240)
            return;

        // Places along x and y, from the centre where friction acts.
        var (x, y) = (friction[0].A.Linear, friction[1].A.Linear);
        // The row along x has the arm crossed with x: its part along n is - arm . y, and that along y is arm . n; the row along y has arm . x along n.
        var center = (X: (double)Vector3.Dot(friction[1].A.Angular, normal), Y: -(double)Vector3.Dot(friction[0].A.Angular, normal));
        // Of the contacts, along x and y from the centre of A.
        double[][] arms = [.. Enumerable.Range(0, contacts).Select(i => Vector(bench, i * ContactPrestepLayout.FloatsPerContact))
            .Select(arm => new double[] { Vector3.Dot(arm, x), Vector3.Dot(arm, y) })];
        double[] middle = [.. Enumerable.Range(0, 2).Select(k => Mean(arms.Select(arm => arm[k])))];
        if (joins)
        {
            double height = Vector3.Dot(friction[0].A.Angular, y);
            double ahead = height * friction[0].FrictionCoefficient / Math.Max(Length(start[0], start[1]), maximum);
            middle = [start[0] * ahead, start[1] * ahead];
        }
        double[][] ways = [.. arms.Select(arm => arm.Zip(middle, (a, m) => a - m).ToArray())];
        var length = contacts == 1 ? 0 : Elongation(ways, normals);
        if (contacts == 3 && joins)
            length = Math.Max(0, (length - 1 / 9.0) / (8 / 9.0));
        var round = contacts == 3 && !joins ? .46 : .6;
        var part = round + (.5 - round) * length;
        // What is not one face says its lever, in fiftieths from .46 on, by the last five bits of its greatest speed of recovery.
        var (code, rim) = (BitConverter.SingleToInt32Bits(bench.Prestep(ContactPrestepLayout.MaximumRecovery(contacts))) & 31, 0.0);
        if (code > 0)
        {
            part = .44 + code / 50.0;
            rim = Math.Clamp(3 * part - 2, 0, 1);
            length = 0;
        }
        var lever = part * Mean(ways.Select(way => Math.Sqrt(RowTests.Dot(way, way))));
        var off = (X: middle[0] - center.X, Y: middle[1] - center.Y);

        var (vx, vy, spin) = (motion[0] - motion[2] * off.Y, motion[1] + motion[2] * off.X, motion[2]);
        var (sliding, turning) = (Length(vx, vy), Math.Abs(spin) * lever);
        var ratio = sliding / turning;
        var early = 2 / 3.0 + .15 * length - rim / 6 * (1 - Math.Min(1, ratio * ratio));
        var late = 1.5 + rim / 2 * (1 - Math.Min(1, 1 / (ratio * ratio)));
        var along = -maximum * early / Fourth(early * sliding, turning);
        double[] wanted = [vx * along, vy * along, -maximum * lever * lever * spin / Fourth(late * sliding, turning)];
        wanted[2] += off.X * wanted[1] - off.Y * wanted[0];
        var response = bench.Response(RowTests.Sum(bench, friction, wanted));
        var power = -RowTests.Dot(wanted, motion);
        var slowing = RowTests.Dot(RowTests.Sum(bench, friction, wanted), response) / power * 3 * (joins ? 4.0 / contacts : 1);
        if (!(power > 0 && slowing < 1))
            return;
        var share = Math.Min(1, 2 - 2 * slowing);
        double[] change = new double[3];
        for (int i = 0; i < 3; ++i)
        {
            impulses[contacts + i] += (wanted[i] - impulses[contacts + i]) * share;
            change[i] = impulses[contacts + i] - start[i];
        }
        response = bench.Response(RowTests.Sum(bench, friction, change));
        for (int i = 0; i < velocities.Length; ++i)
            velocities[i] = startVelocities[i] + response[i];

        double Mean(IEnumerable<double> values) => normals.Zip(values, (weight, value) => weight * value).Sum() / load;
    }

    // With one body the place of friction is there or not; with two the coefficient has a sign.
    static bool Joins(RowBench bench, int typeId)
    {
        var contacts = ConstraintTypeIds.ContactCount(typeId);
        if (bench.BodyCount > 1)
            return float.IsNegative(bench.Prestep(ContactPrestepLayout.Friction(contacts)));
        var place = ContactPrestepLayout.OffsetB(contacts);
        return Vector(bench, place) != default;
    }

    static Vector3 AngularVelocity(double[] velocities, int body) =>
        new((float)velocities[body * 6 + 3], (float)velocities[body * 6 + 4], (float)velocities[body * 6 + 5]);

    // Of the moments of second order the difference of the principal ones over their sum, squared: of two, the sum of squares is that of all entries.
    static double Elongation(double[][] ways, double[] weights)
    {
        double sum = 0, squares = 0;
        for (int k = 0; k < 2; ++k)
        {
            for (int l = 0; l < 2; ++l)
            {
                var moment = ways.Zip(weights, (way, weight) => weight * way[k] * way[l]).Sum();
                squares += moment * moment;
                sum += k == l ? moment : 0;
            }
        }
        return sum > 0 ? Math.Clamp(2 * squares / (sum * sum) - 1, 0, 1) : 0;
    }

    static Vector3 Vector(RowBench bench, int place) => new(bench.Prestep(place), bench.Prestep(place + 1), bench.Prestep(place + 2));

    static double Length(double x, double y) => Math.Sqrt(x * x + y * y);

    static double Fourth(double a, double b) => Math.Pow(Math.Pow(a, 4) + Math.Pow(b, 4), .25);
}
