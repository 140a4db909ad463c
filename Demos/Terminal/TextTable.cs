using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using Spectre.Console;

namespace Demos.Terminal;

/// <summary>A table of texts, as every report writes it: for eyes, for a page, or for another program.</summary>
public sealed class TextTable
{
    readonly string[] names;
    readonly bool[] isNumber;
    readonly List<string[]> rows = [];

    /// <param name="columns">Names of the columns; one that begins with &gt; holds figures, which stand at the right.</param>
    public TextTable(params ReadOnlySpan<string> columns)
    {
        names = new string[columns.Length];
        isNumber = new bool[columns.Length];
        for (int i = 0; i < columns.Length; ++i)
        {
            isNumber[i] = columns[i].StartsWith('>');
            names[i] = isNumber[i] ? columns[i][1..] : columns[i];
        }
    }

    /// <summary>Whether a table without names of columns, and without a rule under them, is wanted in plain text.</summary>
    public bool IsHeadless { get; init; }

    /// <summary>Whether somebody looks at what is written there, on a terminal that can show lines and colours.</summary>
    public static bool IsTerminal(TextWriter writer) =>
        writer == Console.Out && !Console.IsOutputRedirected && AnsiConsole.Profile.Capabilities.Interactive;

    /// <summary>Adds a row; cells that are left out are empty.</summary>
    /// <exception cref="ArgumentException">There are more cells than columns.</exception>
    public void Add(params ReadOnlySpan<string> cells)
    {
        if (cells.Length > names.Length)
            throw new ArgumentException($"a row of {cells.Length} cells in a table of {names.Length} columns", nameof(cells));
        var row = new string[names.Length];
        Array.Fill(row, "");
        cells.CopyTo(row);
        rows.Add(row);
    }

    /// <summary>Writes it with lines on a terminal, and as columns of plain text everywhere else.</summary>
    public void Write(TextWriter writer, string? title = null)
    {
        if (IsTerminal(writer))
            WriteToTerminal(title);
        else
            WriteText(writer, title);
    }

    /// <summary>Writes columns of plain text.</summary>
    public void WriteText(TextWriter writer, string? title = null)
    {
        if (title is not null)
            writer.WriteLine(title);
        var widths = new int[names.Length];
        IEnumerable<string[]> lines = IsHeadless ? rows : rows.Prepend(names);
        foreach (string[] row in lines)
        {
            for (int i = 0; i < row.Length; ++i)
                widths[i] = Math.Max(widths[i], row[i].Length);
        }
        foreach (string[] row in lines)
            writer.WriteLine(string.Join("  ", row.Select((cell, i) => isNumber[i] ? cell.PadLeft(widths[i]) : cell.PadRight(widths[i]))).TrimEnd());
    }

    /// <summary>Writes a table of a page in Markdown.</summary>
    public void WriteMarkdown(TextWriter writer)
    {
        WriteRow(names);
        WriteRow([.. isNumber.Select(number => number ? "---:" : "---")]);
        foreach (string[] row in rows)
            WriteRow([.. row.Select(cell => cell.Replace("|", "\\|", StringComparison.Ordinal))]);
        void WriteRow(string[] cells) => writer.WriteLine($"| {string.Join(" | ", cells)} |");
    }

    /// <summary>Writes comma-separated values to a file, whose folder is made if there is none.</summary>
    public void WriteCsv(string path)
    {
        if (Path.GetDirectoryName(Path.GetFullPath(path)) is string folder)
            Directory.CreateDirectory(folder);
        File.WriteAllText(path, string.Concat(rows.Prepend(names).Select(row => string.Join(',', row.Select(Quote)) + "\n")));
    }

    void WriteToTerminal(string? title)
    {
        var table = new Table().Border(TableBorder.Rounded);
        if (title is not null)
            table.Title(Markup.Escape(title));
        for (int i = 0; i < names.Length; ++i)
        {
            var column = new TableColumn(Markup.Escape(names[i]));
            table.AddColumn(isNumber[i] ? column.RightAligned() : column);
        }
        foreach (string[] row in rows)
            table.AddRow(Array.ConvertAll(row, Markup.Escape));
        AnsiConsole.Write(table);
    }

    static string Quote(string cell) =>
        cell.AsSpan().IndexOfAny(',', '"', '\n') < 0 ? cell : $"\"{cell.Replace("\"", "\"\"", StringComparison.Ordinal)}\"";
}
