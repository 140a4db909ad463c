using System;

namespace Benchmarks.Compare;

/// <summary>Arguments that are lists, separated by commas.</summary>
static class CommaList
{
    /// <summary>What is in a list; nothing where none was given.</summary>
    public static string[] Split(string? list) => list?.Split(',', StringSplitOptions.RemoveEmptyEntries | StringSplitOptions.TrimEntries) ?? [];
}
