using System;

namespace Demos.Scenes;

/// <summary>Says what is wrong with a scene and where, before anything is simulated.</summary>
public sealed class SceneException : Exception
{
    /// <summary>A scene that cannot be used for a reason that belongs to no line of a file.</summary>
    public SceneException(string message) : base(message)
    {
    }

    /// <summary>A scene whose file is wrong at the given line.</summary>
    /// <param name="line">Line of the file, from 1; 0 when the scene did not come from a file.</param>
    /// <param name="token">The token that is wrong; empty at the end of the file.</param>
    /// <param name="problem">What is wrong, without the line.</param>
    public SceneException(int line, string token, string problem) : base(line > 0 ? $"line {line}: {problem}" : problem)
    {
        Line = line;
        Token = token;
    }

    /// <summary>Line of the file, from 1, or 0 when there is none.</summary>
    public int Line { get; }

    /// <summary>The token that is wrong; empty at the end of a file or when there is none.</summary>
    public string Token { get; } = "";
}
