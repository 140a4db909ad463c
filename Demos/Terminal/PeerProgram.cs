using System;
using System.CommandLine;
using System.Diagnostics;
using System.IO;
using Demos.Scenes;

namespace Demos.Terminal;

/// <summary>The program of <c>Benchmarks/Peer</c>: these sources, compiled against the bepuphysics2 of a folder.</summary>
public static class PeerProgram
{
    /// <summary>The option that says where the peer is.</summary>
    /// <param name="purpose">What it is for: to ...</param>
    internal static Option<string?> CreateOption(string purpose) => new("--peer")
    {
        Description = $"Folder with bepuphysics2's BepuPhysics.dll and BepuUtilities.dll, or a built peer program (.dll), to {purpose}.",
        HelpName = "FOLDER",
    };

    /// <summary>Path of the assembly: a built program as it is, or one that is built for the engine of a folder.</summary>
    /// <param name="programOrFolder">A .dll, or what holds the peer's BepuPhysics.dll and BepuUtilities.dll.</param>
    /// <exception cref="SceneException">There is no such engine in the folder, or the program does not compile against it.</exception>
    public static string Find(string programOrFolder) =>
        programOrFolder.EndsWith(".dll", StringComparison.OrdinalIgnoreCase) ? programOrFolder : Build(programOrFolder);

    /// <summary>Runs a program, this one or the peer's, in a process of its own, and reads what it writes.</summary>
    /// <param name="program">Path of the assembly.</param>
    /// <param name="arguments">Its arguments.</param>
    /// <param name="read">Called with each line.</param>
    /// <exception cref="SceneException">It cannot be started, or does not end well.</exception>
    public static void Run(string program, string[] arguments, Action<string> read)
    {
        var start = new ProcessStartInfo("dotnet", [program, .. arguments]) { RedirectStandardOutput = true };
        using Process process = Process.Start(start) ?? throw new SceneException($"dotnet cannot be started to run {program}");
        while (process.StandardOutput.ReadLine() is string line)
            read(line);
        process.WaitForExit();
        if (process.ExitCode != 0)
            throw new SceneException($"{program} ended with status {process.ExitCode}");
    }

    /// <summary>Builds it and returns the path of the assembly.</summary>
    /// <param name="folder">Holds the peer's BepuPhysics.dll and BepuUtilities.dll.</param>
    /// <exception cref="SceneException">There is no such engine in the folder, or the program does not compile against it.</exception>
    static string Build(string folder)
    {
        if (!File.Exists(Path.Combine(folder, "BepuPhysics.dll")))
            throw new SceneException($"there is no BepuPhysics.dll in the folder '{folder}' of --peer");
        string root = FindRoot();
        var start = new ProcessStartInfo("dotnet") { RedirectStandardOutput = true, RedirectStandardError = true };
        string[] arguments = ["build", Path.Combine(root, "Benchmarks", "Peer"), "-c", "Release", $"-p:PeerFolder={Path.GetFullPath(folder)}"];
        foreach (string argument in arguments)
            start.ArgumentList.Add(argument);
        using Process process = Process.Start(start) ?? throw new SceneException("dotnet cannot be started to build the peer program");
        // Read as it comes: a full pipe would stop the build.
        var errors = process.StandardError.ReadToEndAsync();
        string output = process.StandardOutput.ReadToEnd();
        process.WaitForExit();
        string errorText = errors.GetAwaiter().GetResult();
        if (process.ExitCode != 0)
            throw new SceneException($"the peer program does not build:\n{(errorText.Length > 0 ? errorText : output).Trim()}");
        return Path.Combine(root, "artifacts", "bin", "Peer", "release", "Peer.dll");
    }

    static string FindRoot()
    {
        for (DirectoryInfo? folder = new(AppContext.BaseDirectory); folder is not null; folder = folder.Parent)
        {
            if (File.Exists(Path.Combine(folder.FullName, "Physics.sln")))
                return folder.FullName;
        }
        throw new SceneException("this program does not lie below the folder of Physics.sln, so the peer's source cannot be found");
    }
}
