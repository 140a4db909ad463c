using System;
using System.IO;
using System.Linq;
using System.Text.Json;
using Demos.Accuracy;
using Demos.Terminal;
using Xunit;

namespace DemoTests.Accuracy;

public sealed class AccuracyCommandTests : IDisposable
{
    readonly string folder = Directory.CreateTempSubdirectory("accuracy").FullName;

    public void Dispose() => Directory.Delete(folder, true);

    [Theory]
    [InlineData("no case 'Z9'", "accuracy", "Z9")]
    [InlineData("--effort cannot be 'none'", "accuracy", "C4", "--effort", "none")]
    [InlineData("no-such-folder", "accuracy", "C4", "--json", "no-such-folder/accuracy.json")]
    public void What_cannot_be_is_refused_with_a_message(string message, params string[] arguments)
    {
        (int status, _, string error) = Run(arguments);

        Assert.Equal(DemosCommand.BadInput, status);
        Assert.Contains(message, error, StringComparison.Ordinal);
    }

    [Fact]
    public void A_family_is_run_judged_and_written()
    {
        string json = Path.Combine(folder, "accuracy.json"), page = Path.Combine(folder, "Accuracy.md");

        (int status, string output, _) = Run("accuracy", "C4", "--effort", "accurate", "--json", json, "--page", page);

        Assert.Equal(DemosCommand.Finished, status);
        Assert.Contains("2 of 2 met, 0 known not to be, 0 failed", output, StringComparison.Ordinal);
        JsonElement root = JsonDocument.Parse(File.ReadAllBytes(json)).RootElement;
        Assert.Equal(["engine", "complete", "cases"], root.EnumerateObject().Select(member => member.Name));
        JsonElement first = root.GetProperty("cases")[0];
        Assert.Equal(["case", "scene", "effort", "settings", "met", "knownMiss", "figures"], first.EnumerateObject().Select(member => member.Name));
        Assert.Equal(.005, first.GetProperty("figures")[0].GetProperty("limit").GetDouble());
        Assert.Equal(JsonValueKind.Null, first.GetProperty("figures")[2].GetProperty("limit").ValueKind);
        Assert.Equal(2, File.ReadAllLines(page).Count(line => line.StartsWith("| C4 |", StringComparison.Ordinal)));
    }

    [Fact]
    public void A_page_keeps_the_rows_of_what_is_not_run()
    {
        string page = Path.Combine(folder, "Accuracy.md");
        static CaseResult Row(string id, string scene, string settings, double value) =>
            new CaseResult(id, scene, settings) { KnownMiss = null }.Note("way", value, "m");
        static string[] Rows(string path) => [.. File.ReadAllLines(path).Where(line => line.StartsWith("| Z", StringComparison.Ordinal))];

        AccuracyPage.Update(page, [Row("Z1", "b", "s4", 1), Row("Z1", "a", "s4", 2), Row("Z1", "a", "s16", 3), Row("Z2", "a", "s4", 4)], true);
        AccuracyPage.Update(page, [Row("Z1", "a", "s4", 5)], false);
        Assert.Equal(["a | s16 | way 3", "a | s4 | way 5", "b | s4 | way 1", "a | s4 | way 4"], Rows(page).Select(Short));

        // The whole family at one setting: a scene that is no more has no row.
        AccuracyPage.Update(page, [Row("Z1", "c", "s4", 6)], true);
        Assert.Equal(["a | s16 | way 3", "c | s4 | way 6", "a | s4 | way 4"], Rows(page).Select(Short));

        static string Short(string row) => row[7..row.IndexOf(" m ", StringComparison.Ordinal)];
    }

    static (int Status, string Output, string Error) Run(params string[] arguments)
    {
        using var output = new StringWriter();
        using var error = new StringWriter();
        int status = DemosCommand.Run(arguments, output, error);
        return (status, output.ToString(), error.ToString());
    }
}
