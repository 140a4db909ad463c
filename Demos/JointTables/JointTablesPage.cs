using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using Demos.Terminal;

namespace Demos.JointTables;

/// <summary>Writes what was measured as tables of a page.</summary>
static class JointTablesPage
{
    public const string Heading = """
        # Joints over substeps and sweeps

        Written by `dotnet run -c Release --project Demos -- joints --peer FOLDER --page Docs/JointAccuracy.md`, where the folder holds the two assemblies of
        bepuphysics2; names of tables choose some (`joints double-pendulum chain-100`). i is for velocity iterations per substep, r for relaxations, at 60 steps
        per second.

        Linkages are let go from rest, without friction, for a minute, beside the same bodies as equations of motion with Lagrange multipliers in double
        precision (`Demos/References/ConstrainedBodies.cs`, which has no code of the engine and is itself compared with closed forms and with Lagrange's
        equations). The period is the mean of the first ten swings; the place is that of one point of the linkage; energies are parts of the greatest kinetic
        energy; the gap is the greatest of all joints. bepuphysics2 leaves the stiffness of joints to the game: an eighth of a period per substep there, at
        least 30 Hz, or as much per sweep, whichever leaves the smaller gap.

        **Why energy is lost.** A joint that bears a force F gives way by C = K F / w^2, K being what a unit impulse does to the velocity of the joint and w
        its frequency, .785 / h for one sweep per substep. When F changes C has to follow, and the damper that brings it there takes
        (2 + w h) F' K F' / w^3, which goes with the third power of the substep. In a pendulum it is the direction of F that changes. The elbow of a double
        pendulum whips: the force in it is .84 of a bar's weight in the median and 13 to 19 times the weight in one hundredth of the time. Over a minute
        of the true motion the formula takes 32, 4.0, .50 % of the energy with 8, 16, 32 substeps; joints take 11, 2.5, .32 %. With four substeps it is more
        than there is, so the motion is damped until what is left whips no more. What helps is stiffness: two sweeps or a relaxation are twice as stiff,
        four sweeps four times. Twice the substeps are twice as stiff too, and follow the motion better. What a joint could do besides is in
        [long arms](decisions/long-arms.md): whoever turns with the bars sees .41 % of those .50 % still.

        **Chains** hang from the start with a kick at the load; what is shown is the mean stretch of a link over the second half of ten seconds. Stretch is the
        weight over stiffness: it goes with the square of substeps times sweeps, until four sweeps, beyond which they are no stiffer.
        """;

    /// <summary>Writes a table for each scene that has rows.</summary>
    public static void Write(TextWriter writer, JointTable[] tables, List<JointTableRow> rows)
    {
        foreach (JointTable table in tables)
        {
            writer.WriteLine();
            writer.WriteLine($"## {table.Name}: {table.Summary}");
            writer.WriteLine();
            JointTableRow[] own = [.. rows.Where(row => row.Table == table.Name)];
            (table.Figures.Length > 1 ? Figures(table, own) : Grid(own)).WriteMarkdown(writer);
        }
    }

    // A line for each setting.
    static TextTable Figures(JointTable table, JointTableRow[] rows)
    {
        int[] shown = [.. Enumerable.Range(0, table.Figures.Length).Where(i => table.Figures[i].Length > 0)];
        var text = new TextTable(["engine", .. shown.Select(i => $">{table.Figures[i]}").Prepend(">substeps")]);
        foreach (JointTableRow row in rows)
            text.Add([Engine(row), Whole(row.Substeps), .. shown.Select(i => Show(row.Figures[i]))]);
        return text;
    }

    // One figure: a line for each number of substeps, a column for each kind of sweeps.
    static TextTable Grid(JointTableRow[] rows)
    {
        (string Engine, int Iterations, int Relaxations)[] columns = [.. rows.Select(row => (row.Engine, row.Iterations, row.Relaxations)).Distinct()];
        var text = new TextTable(["substeps", .. columns.Select(column =>
            $">{column.Engine} {Sweeps(column.Iterations, column.Relaxations)}")]);
        foreach (IGrouping<int, JointTableRow> line in rows.GroupBy(row => row.Substeps))
        {
            text.Add([Whole(line.Key), .. columns.Select(column => line.FirstOrDefault(row => (row.Engine, row.Iterations, row.Relaxations) == column))
                .Select(row => row is null ? "" : Show(row.Figures[0]))]);
        }
        return text;
    }

    static string Engine(JointTableRow row) => $"{row.Engine} {Sweeps(row.Iterations, row.Relaxations)}";

    static string Sweeps(int iterations, int relaxations) => $"i{Whole(iterations)}{(relaxations > 0 ? $" r{Whole(relaxations)}" : "")}";

    static string Show(double figure) => double.IsFinite(figure) && Math.Abs(figure) < 1e5 ? figure.ToString("G3", CultureInfo.InvariantCulture) : "broken";

    static string Whole(int value) => value.ToString(CultureInfo.InvariantCulture);
}
