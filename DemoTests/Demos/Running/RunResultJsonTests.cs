using System.IO;
using System.Linq;
using System.Text.Json;
using Demos.Running;
using Xunit;

namespace DemoTests.Runner;

public class RunResultJsonTests
{
    static readonly RunResult sample = new()
    {
        Engine = "engine \"of\" ours",
        Scene = "глина",
        Steps = 12,
        StepDuration = 0.5f,
        Hash = 0xABCDEF,
        Stages = new StageTimes(1, null, 3, null, 5, 6, 7),
        Pairs = 3,
        MaximumPenetration = 0.25,
        KineticEnergy = double.NaN,
        PotentialEnergy = double.PositiveInfinity,
        Hashes = [new StepHash(4, 1), new StepHash(8, ulong.MaxValue)],
    };

    [Fact]
    public void All_members_are_there_in_the_order_of_the_format()
    {
        JsonElement root = Write(sample);

        Assert.Equal(
            [
                "engine", "scene", "steps", "dt", "substeps", "iterations", "threads", "lanes", "seed", "ms", "stages", "bodies", "awake",
                "statics", "pairs", "manifolds", "contacts", "constraints", "batches", "fallback", "managedBytes", "poolBytes",
                "maxPenetration", "maxJointError", "rmsJointError", "kineticEnergy", "potentialEnergy", "moved", "lost", "notFinite",
                "hash", "hashes",
            ],
            root.EnumerateObject().Select(member => member.Name));
        Assert.Equal(["mean", "median", "p95", "p99", "max"], root.GetProperty("ms").EnumerateObject().Select(member => member.Name));
        Assert.Equal(["sleep", "predict", "broad", "narrow", "flush", "solve", "settle"],
            root.GetProperty("stages").EnumerateObject().Select(member => member.Name));
    }

    [Fact]
    public void What_a_run_does_not_have_is_null()
    {
        JsonElement root = Write(sample);

        Assert.Equal(3, root.GetProperty("pairs").GetInt32());
        Assert.Equal(JsonValueKind.Null, root.GetProperty("contacts").ValueKind);
        Assert.Equal(0.25, root.GetProperty("maxPenetration").GetDouble());
        Assert.Equal(JsonValueKind.Null, root.GetProperty("maxJointError").ValueKind);
        Assert.Equal(JsonValueKind.Null, root.GetProperty("stages").GetProperty("predict").ValueKind);
    }

    [Fact]
    public void What_is_not_finite_is_null()
    {
        JsonElement root = Write(sample);

        Assert.Equal(JsonValueKind.Null, root.GetProperty("kineticEnergy").ValueKind);
        Assert.Equal(JsonValueKind.Null, root.GetProperty("potentialEnergy").ValueKind);
    }

    [Fact]
    public void Hashes_have_sixteen_digits()
    {
        JsonElement root = Write(sample);

        Assert.Equal("0000000000abcdef", root.GetProperty("hash").GetString());
        Assert.Equal("[[4,\"0000000000000001\"],[8,\"ffffffffffffffff\"]]", JsonSerializer.Serialize(root.GetProperty("hashes")));
    }

    [Fact]
    public void What_is_written_can_be_read()
    {
        string path = Path.GetTempFileName();
        try
        {
            RunResultJson.Write(path, sample);
            RunJson read = RunResultJson.Read(path);
            Assert.Equal((sample.Engine, sample.Scene, 0.25, (double?)null), (read.Engine, read.Scene, read.MaxPenetration, read.Stages.Predict));
            Assert.Equal([new RunHashJson(4, "0000000000000001"), new RunHashJson(8, "ffffffffffffffff")], read.Hashes);
        }
        finally
        {
            File.Delete(path);
        }
    }

    static JsonElement Write(RunResult result)
    {
        using var stream = new MemoryStream();
        RunResultJson.Write(stream, result);
        return JsonDocument.Parse(stream.ToArray()).RootElement;
    }
}
