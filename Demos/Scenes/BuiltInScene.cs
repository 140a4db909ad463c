using System;

namespace Demos.Scenes;

/// <summary>A scene that is known by name.</summary>
/// <param name="Name">What it is called on the command line and in results.</param>
/// <param name="Summary">One line for the list.</param>
/// <param name="Create">Makes its initial state from a seed; most scenes have no use for it.</param>
public sealed record BuiltInScene(string Name, string Summary, Func<int, SceneDescription> Create);
