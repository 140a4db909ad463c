using System;
using System.Diagnostics;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Threading;

namespace DemoTests.Quality;

/// <summary>The packages of the libraries, packed from what the tests were built with, in a folder that goes away afterwards.</summary>
public sealed class Packages : IDisposable
{
    /// <summary>Ids of the packages.</summary>
    public static string[] Ids { get; } = ["Tootbird.BepuUtilities", "Tootbird.BepuPhysics"];

    readonly string workFolder = Directory.CreateTempSubdirectory("physics-packages-").FullName;

    /// <summary>Folder with the packages, to be used as a package source.</summary>
    public string Folder { get; }

    /// <summary>Packs, or takes the packages of the folder that the environment variable PHYSICS_PACKAGES names.</summary>
    public Packages()
    {
        if (Environment.GetEnvironmentVariable("PHYSICS_PACKAGES") is { Length: > 0 } packed)
        {
            Folder = Path.GetFullPath(packed, RepositoryFiles.Root);
            return;
        }
        Folder = Path.Combine(workFolder, "packages");
        var configuration = typeof(Packages).Assembly.GetCustomAttribute<AssemblyConfigurationAttribute>()!.Configuration;
        foreach (var id in Ids)
        {
            var project = RepositoryFiles.PathOf(id["Tootbird.".Length..]);
            Dotnet($"pack \"{project}\" -c {configuration} --no-build --output \"{Folder}\"", RepositoryFiles.Root);
        }
    }

    /// <summary>The one package file of an id.</summary>
    public string File(string id, string extension = ".nupkg") => Directory.GetFiles(Folder, id + ".*" + extension)
        .Single(path => Path.GetExtension(path) == extension && char.IsAsciiDigit(Path.GetFileName(path)[id.Length + 1]));

    /// <summary>Version of the packages.</summary>
    public string Version => Path.GetFileNameWithoutExtension(File(Ids[0]))[(Ids[0].Length + 1)..];

    /// <summary>A folder of its own for a test.</summary>
    public string CreateFolder(string name) => Directory.CreateDirectory(Path.Combine(workFolder, name)).FullName;

    /// <summary>Runs a command of the SDK, and returns what it wrote.</summary>
    /// <exception cref="InvalidOperationException">It failed; the message has its output.</exception>
    public static string Dotnet(string arguments, string folder) => Run("dotnet", arguments, folder);

    /// <summary>Runs a program, and returns what it wrote.</summary>
    /// <exception cref="InvalidOperationException">It failed; the message has its output.</exception>
    public static string Run(string program, string arguments, string folder)
    {
        var start = new ProcessStartInfo(program, arguments)
        {
            WorkingDirectory = folder,
            RedirectStandardOutput = true,
            RedirectStandardError = true,
            UseShellExecute = false,
        };
        // Variables of the build that runs this test belong to it; and servers that outlive the command would hold its output open.
        foreach (var name in start.Environment.Keys.Where(name => name.StartsWith("MSBUILD", StringComparison.OrdinalIgnoreCase)).ToArray())
            start.Environment.Remove(name);
        start.Environment["MSBUILDDISABLENODEREUSE"] = "1";
        start.Environment["DOTNET_CLI_USE_MSBUILD_SERVER"] = "0";
        start.Environment["UseSharedCompilation"] = "false";
        using var process = Process.Start(start)!;
        var error = process.StandardError.ReadToEndAsync(CancellationToken.None);
        var output = process.StandardOutput.ReadToEnd();
        process.WaitForExit();
        if (process.ExitCode != 0)
            throw new InvalidOperationException($"{program} {arguments} ended with {process.ExitCode}:\n{output}\n{error.Result}");
        return output;
    }

    /// <inheritdoc/>
    public void Dispose() => Directory.Delete(workFolder, recursive: true);
}
