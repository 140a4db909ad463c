using System;
using System.Text;
using Demos.Running;
using Demos.Scenes;
using Xunit;

namespace DemoTests.Runner;

/// <summary>
/// Numbers that a file may hold and nobody expects. Each is refused, or run to the end; that bodies were lost or are no longer finite
/// is then told. Nothing hangs, nothing takes the process down.
/// </summary>
public class HostileSceneTests
{
    const string Text = """
        scene 1 name hostile steps 3 friction 0.5 damping 0.05 sleep 1
        shapes 3
        box 2 0.5 2
        sphere 0.5
        capsule 0.25 0.5
        bodies 4
        0 1 0 0 0 0 0 0 0 1 0 0 -0.5 0 0 0 0 1 0 0 0 0 0 0 0
        2 1 1 0 0 0 0 0 0 1 1 0 0.5 0 0 0 0 1 0 0 0 0 0 0 0
        2 1 2 0 0 0 0 0 0 1 2 0.6 0.9 0 0 0 0 1 1 2 3 4 5 6 0
        1 1 0 0 0 0 0 0 0 1 0 0 3 0 0 0 0 1 0 -1 0 0 1 0 0
        joints 1
        rag 1 2 0.3 0 0 -0.3 0 0 0.5 -0.1 0.2

        """;

    [Theory]
    [InlineData("0")]
    [InlineData("1e-45")]
    [InlineData("1e-20")]
    [InlineData("1e20")]
    [InlineData("3e38")]
    [InlineData("-3e38")]
    public void Every_number_of_a_scene_may_be_hostile(string number)
    {
        string[] tokens = Text.Split([' ', '\n'], StringSplitOptions.RemoveEmptyEntries);
        for (int i = 1; i < tokens.Length; ++i)
        {
            if (!char.IsAsciiDigit(tokens[i][^1]))
                continue;
            string before = tokens[i];
            tokens[i] = number;
            RefuseOrRun(string.Join(' ', tokens));
            tokens[i] = before;
        }
    }

    static void RefuseOrRun(string text)
    {
        try
        {
            using var run = new SceneRun(SceneFile.Parse(Encoding.UTF8.GetBytes(text)), new RunSettings { Steps = 3 });
            RunResult result = run.Run();
            Assert.Equal(3, result.Steps);
        }
        catch (SceneException error)
        {
            Assert.NotEmpty(error.Message);
        }
    }
}
