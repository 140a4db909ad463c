using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;

namespace DemoTests.Quality;

/// <summary>Finds the sources that the tests were built from.</summary>
static class RepositoryFiles
{
    static readonly string[] skippedFolders = ["artifacts", "bin", "obj", ".git", "BenchmarkDotNet.Artifacts", "TestResults"];

    /// <summary>Folder of the solution.</summary>
    public static string Root { get; } = FindRoot();

    static string FindRoot()
    {
        for (DirectoryInfo? folder = new(AppContext.BaseDirectory); folder is not null; folder = folder.Parent)
        {
            if (File.Exists(Path.Combine(folder.FullName, "Physics.sln")))
                return folder.FullName;
        }
        throw new DirectoryNotFoundException($"No folder above {AppContext.BaseDirectory} has a Physics.sln.");
    }

    /// <summary>Full path of a file or folder of the repository.</summary>
    public static string PathOf(string relativePath) => Path.Combine(Root, relativePath);

    /// <summary>Content of a file of the repository.</summary>
    public static string Read(string relativePath) => File.ReadAllText(PathOf(relativePath));

    /// <summary>Files below a folder, by path relative to the repository, with slashes, in order; not what builds leave behind.</summary>
    public static IReadOnlyList<string> Find(string folder, string pattern) =>
        [.. Directory.EnumerateFiles(PathOf(folder), pattern, SearchOption.AllDirectories)
            .Select(path => Path.GetRelativePath(Root, path).Replace('\\', '/'))
            .Where(path => !path.Split('/').Any(part => Array.IndexOf(skippedFolders, part) >= 0))
            .Order(StringComparer.Ordinal)];
}
