using System.Globalization;
using System.Linq;
using Demos.Scenes;

namespace Demos.JointTables;

/// <summary>What an engine measured of a table at one setting; a line of text when it comes from a program of its own.</summary>
sealed record JointTableRow(string Engine, string Table, int Substeps, int Iterations, int Relaxations, double[] Figures)
{
    const char Separator = ';';

    /// <summary>As a line.</summary>
    public string Line => string.Join(Separator, [Engine, Table, Text(Substeps), Text(Iterations), Text(Relaxations),
        .. Figures.Select(figure => figure.ToString("R", CultureInfo.InvariantCulture))]);

    /// <summary>Reads a line.</summary>
    /// <exception cref="SceneException">It is none.</exception>
    public static JointTableRow Parse(string line)
    {
        string[] parts = line.Split(Separator);
        return parts.Length > 5
            ? new JointTableRow(parts[0], parts[1], Count(parts[2]), Count(parts[3]), Count(parts[4]), [.. parts.Skip(5).Select(Number)])
            : throw new SceneException($"the peer program answered '{line}'");
    }

    static string Text(int count) => count.ToString(CultureInfo.InvariantCulture);

    static int Count(string text) => int.Parse(text, CultureInfo.InvariantCulture);

    static double Number(string text) => double.Parse(text, CultureInfo.InvariantCulture);
}
