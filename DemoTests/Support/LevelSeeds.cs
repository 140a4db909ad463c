using System;
using System.Globalization;

namespace DemoTests.Support;

/// <summary>Seeds of the tests of shapes that levels are made of, and of what moves over them.</summary>
/// <remarks>PHYSICS_LEVEL_SEED is added to each, so that all of them can be run on cases that nobody has seen.</remarks>
static class LevelSeeds
{
    static readonly int added = int.Parse(Environment.GetEnvironmentVariable("PHYSICS_LEVEL_SEED") ?? "0", CultureInfo.InvariantCulture);

    /// <summary>The seed that takes the place of another.</summary>
    public static int Of(int seed) => seed + added;
}
