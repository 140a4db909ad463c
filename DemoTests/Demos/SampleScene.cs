using System;
using System.Text;
using Demos.Scenes;

namespace DemoTests.Runner;

/// <summary>A scene file that has one of everything, and ways to damage it.</summary>
static class SampleScene
{
    public const string Text = """
        scene 1
        name sample
        steps 10
        friction 0.5
        damping 0.05
        sleep 1
        shapes 6
        box 0.5 1 1.5
        sphere 0.25
        capsule 0.25 0.5
        cylinder 0.5 0.75
        hull 4 0 0 0 1 0 0 0 1 0 0 0 1
        mesh 3 1 0 0 0 1 0 0 0 0 1 0 1 2
        bodies 4
        0 1 5 0 0 0 0 0 0 1 0 0 -1 0 0 0 0 1 0 0 0 0 0 0 0
        1 0 0 0 4 0 0 0 0 1 0 0 0 0 0 0.5 0
        2 1 0 0 0 0 0 0 0 1 2.5 1 2 3 0 0 0 2 4 5 6 7 8 9 3
        2 2 1 0 1 0 0 0 0 1 2 0 -1 0 0 1 0 0 1e1 1 6 3 0 0 0 1 0 0 0 0 0 0 -1
        joints 2
        ball 1 2 1 2 3 4 5 6
        rag 3 2 1 2 3 4 5 6 0.5 -0.25 0.75

        """;

    /// <summary>Reads a scene from a string.</summary>
    public static SceneDescription Parse(string text) => SceneFile.Parse(Encoding.UTF8.GetBytes(text));

    /// <summary>The sample with one token replaced.</summary>
    /// <param name="line">Line, from 1.</param>
    /// <param name="token">Token on the line, from 0.</param>
    /// <param name="replacement">What stands there instead; it may hold several tokens or none.</param>
    public static string Replace(int line, int token, string replacement)
    {
        string[] lines = Text.Split('\n');
        string[] tokens = lines[line - 1].Split(' ');
        tokens[token] = replacement;
        lines[line - 1] = string.Join(' ', tokens);
        return string.Join('\n', lines);
    }

    /// <summary>Where each token of the sample begins and ends.</summary>
    public static Range[] Tokens()
    {
        var ranges = new System.Collections.Generic.List<Range>();
        int start = 0;
        for (int i = 0; i < Text.Length; ++i)
        {
            if (!char.IsWhiteSpace(Text[i]))
                continue;
            if (i > start)
                ranges.Add(start..i);
            start = i + 1;
        }
        return [.. ranges];
    }
}
