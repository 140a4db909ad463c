using System.Globalization;
using System.IO;
using System.Linq;
using System.Text.Json;

namespace Demos.Running;

/// <summary>Writes a run as the JSON object that every program that runs scenes writes, and reads it back.</summary>
public static class RunResultJson
{
    /// <summary>Writes the file in one go, so that no half of it is left behind.</summary>
    public static void Write(string path, RunResult result) =>
        File.WriteAllBytes(path, JsonSerializer.SerializeToUtf8Bytes(ToJson(result), RunJsonContext.Default.RunJson));

    /// <summary>Writes the object to a stream.</summary>
    public static void Write(Stream stream, RunResult result) => JsonSerializer.Serialize(stream, ToJson(result), RunJsonContext.Default.RunJson);

    /// <summary>Reads what a program has written.</summary>
    /// <exception cref="JsonException">It is no run.</exception>
    public static RunJson Read(string path) =>
        JsonSerializer.Deserialize(File.ReadAllBytes(path), RunJsonContext.Default.RunJson) ?? throw new JsonException($"{path} holds no run");

    /// <summary>A hash as it is written everywhere: 16 hexadecimal digits.</summary>
    public static string HashText(ulong hash) => hash.ToString("x16", CultureInfo.InvariantCulture);

    static RunJson ToJson(RunResult result)
    {
        StepTimes times = result.Times;
        StageTimes stages = result.Stages;
        return new RunJson
        {
            Engine = result.Engine,
            Scene = result.Scene,
            Steps = result.Steps,
            StepsAsked = result.IsStopped ? result.StepsAsked : null,
            Dt = result.StepDuration,
            Substeps = result.Substeps,
            Iterations = result.Iterations,
            Relaxations = result.Relaxations > 0 ? result.Relaxations : null,
            Threads = result.Threads,
            Lanes = result.Lanes,
            Seed = result.Seed,
            Ms = new RunTimesJson(Known(times.Mean), Known(times.Median), Known(times.P95), Known(times.P99), Known(times.Max)),
            Stages = new RunStagesJson(Known(stages.Sleep), Known(stages.Predict), Known(stages.Broad), Known(stages.Narrow), Known(stages.Flush),
                Known(stages.Solve), Known(stages.Settle)),
            Bodies = result.Bodies,
            Awake = result.Awake,
            Statics = result.Statics,
            Pairs = result.Pairs,
            Manifolds = result.Manifolds,
            Contacts = result.Contacts,
            Constraints = result.Constraints,
            Batches = result.Batches,
            Fallback = result.Fallback,
            ManagedBytes = result.ManagedBytes,
            PoolBytes = result.PoolBytes,
            MaxPenetration = Known(result.MaximumPenetration),
            MaxJointError = Known(result.MaximumJointError),
            RmsJointError = Known(result.RmsJointError),
            KineticEnergy = Known(result.KineticEnergy),
            PotentialEnergy = Known(result.PotentialEnergy),
            Moved = result.Moved,
            Lost = result.Lost,
            NotFinite = result.NotFinite,
            Hash = HashText(result.Hash),
            Hashes = [.. result.Hashes.Select(entry => new RunHashJson(entry.Step, HashText(entry.Hash)))],
        };
    }

    /// <summary>JSON has no word for what is not finite: such a figure is null, and "notFinite" says why.</summary>
    static double? Known(double? value) => value is double number && double.IsFinite(number) ? number : null;
}
