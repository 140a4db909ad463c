using System.CommandLine;
using Demos.Running;

namespace Demos.Terminal;

/// <summary>The options of a run. Their values are checked by the run itself, so that every caller meets the same rules.</summary>
sealed class RunOptions
{
    static readonly RunSettings defaults = new();

    readonly Option<int?> steps = Make<int?>("--steps", "Steps to run, warm-up included [default: as the scene says].");
    readonly Option<float> stepDuration = Make("--dt", "Seconds per step.", defaults.StepDuration);
    readonly Option<int> substeps = Make("--substeps", "Substeps per step.", defaults.Substeps);
    readonly Option<int> iterations = Make("--iterations", "Velocity iterations per substep.", defaults.Iterations);
    readonly Option<int> relaxations = Make("--relaxations", "Relaxation sweeps per substep.", defaults.Relaxations);
    readonly Option<LoadPathChoice> loadPath = Make("--load-path", "Whether loads are handed down to the ground in one go.", defaults.LoadPath);
    readonly Option<DirectJointsChoice> directJoints = Make(
        "--direct-joints", "Whether all joints of a structure are solved at once.", defaults.DirectJoints);
    readonly Option<int> threads = Make("--threads", "Threads that a step may use.", defaults.Threads);
    readonly Option<int> seed = Make("--seed", "Seed of scenes that are random.", defaults.Seed);
    readonly Option<int> hashEvery = Make("--hash-every", "Steps between two recorded state hashes; 0 for none.", defaults.HashEvery);
    readonly Option<int?> warmup = Make<int?>("--warmup", "First steps that are not measured [default: 30, at most half of the steps].");
    readonly Option<bool?> sleep = Make<bool?>("--sleep", "Whether bodies may fall asleep [default: as the scene says].");
    readonly Option<bool> listen = Make("--listen", "All events of all bodies are listened to, and part of the recorded hashes.", defaults.Listen);
    readonly Option<float?> frequency = Make<float?>("--frequency", "Frequency in Hz of contacts and joints [default: the engine's].");
    readonly Option<float?> dampingRatio = Make<float?>("--damping-ratio", "Damping ratio that goes with --frequency [default: 1].");

    /// <summary>Lets a command understand the options.</summary>
    public void AddTo(Command command)
    {
        Option[] options =
        [
            steps, stepDuration, substeps, iterations, relaxations, loadPath, directJoints, threads, seed, hashEvery, warmup, sleep, listen, frequency,
            dampingRatio,
        ];
        foreach (Option option in options)
            command.Options.Add(option);
    }

    /// <summary>The settings that a command line asks for.</summary>
    public RunSettings Read(ParseResult parsed) => new()
    {
        Steps = parsed.GetValue(steps),
        StepDuration = parsed.GetValue(stepDuration),
        Substeps = parsed.GetValue(substeps),
        Iterations = parsed.GetValue(iterations),
        Relaxations = parsed.GetValue(relaxations),
        LoadPath = parsed.GetValue(loadPath),
        DirectJoints = parsed.GetValue(directJoints),
        Threads = parsed.GetValue(threads),
        Seed = parsed.GetValue(seed),
        HashEvery = parsed.GetValue(hashEvery),
        Warmup = parsed.GetValue(warmup),
        Sleep = parsed.GetValue(sleep),
        Listen = parsed.GetValue(listen),
        Frequency = parsed.GetValue(frequency),
        DampingRatio = parsed.GetValue(dampingRatio),
    };

    static Option<T> Make<T>(string name, string description) => new(name) { Description = description };

    static Option<T> Make<T>(string name, string description, T defaultValue) =>
        new(name) { Description = description, DefaultValueFactory = _ => defaultValue };
}
