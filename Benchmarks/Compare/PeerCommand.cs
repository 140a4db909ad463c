using System;
using System.CommandLine;
using System.IO;

namespace Benchmarks.Compare;

/// <summary>What the commands have in common that measure in turn with a peer: who that is, how often, and where the results go.</summary>
sealed class PeerCommand
{
    readonly RootCommand root;
    readonly Option<string> peer;
    readonly Option<int> runs;
    readonly Option<string?> csv = new("--csv") { Description = "File to write the results to, usually in Benchmarks/Results." };

    /// <param name="description">What the command does.</param>
    /// <param name="program">What the peer may be besides a folder.</param>
    /// <param name="whatRuns">What is counted as a run.</param>
    /// <param name="options">Options of its own.</param>
    public PeerCommand(string description, string program, string whatRuns, params ReadOnlySpan<Option> options)
    {
        peer = new("--peer") { Description = $"Folder with the peer's BepuPhysics.dll and BepuUtilities.dll, or {program} (.dll).", Required = true };
        runs = new("--runs") { Description = whatRuns, DefaultValueFactory = _ => 5 };
        root = new(description) { peer };
        foreach (Option option in options)
            root.Options.Add(option);
        root.Options.Add(runs);
        root.Options.Add(csv);
    }

    /// <summary>Reads the arguments, measures, and returns the exit status.</summary>
    /// <param name="arguments">Arguments after the command's word.</param>
    /// <param name="measure">
    /// Measures with the peer, so many times, and writes what came of it; to a file, too, where there is a path. The peer is opened when the other
    /// arguments have been read, as it may have to be built.
    /// </param>
    public int Run(string[] arguments, Action<ParseResult, Func<SceneProgram>, int, string?> measure)
    {
        root.SetAction(parsed =>
        {
            try
            {
                int count = parsed.GetValue(runs);
                if (count < 1)
                    throw new CompareException("--runs has to be at least 1");
                measure(parsed, () => SceneProgram.OpenPeer(parsed.GetRequiredValue(peer)), count, parsed.GetValue(csv));
                return 0;
            }
            catch (Exception error) when (error is CompareException or IOException or UnauthorizedAccessException)
            {
                Console.Error.WriteLine($"error: {error.Message}");
                return 1;
            }
        });
        return root.Parse(arguments).Invoke();
    }
}
