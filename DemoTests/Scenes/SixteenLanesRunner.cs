using System;
using System.Reflection;
using DemoTests.Quality;

namespace DemoTests.Scenes;

/// <summary>The runner, compiled with the stand-in of DemoTests/SixteenLanes in the place of Vector&lt;T&gt;.</summary>
static class SixteenLanesRunner
{
    static readonly Lazy<string> path = new(Build);

    /// <summary>Path of its assembly, which is built when it is first asked for.</summary>
    public static string Path => path.Value;

    static string Build()
    {
        var configuration = typeof(SixteenLanesRunner).Assembly.GetCustomAttribute<AssemblyConfigurationAttribute>()!.Configuration;
        Packages.Dotnet($"build Demos -c {configuration} --no-restore -p:SixteenLanes=true", RepositoryFiles.Root);
        return RepositoryFiles.PathOf($"artifacts/bin/Demos/{configuration.ToLowerInvariant()}_sixteen-lanes/Demos.dll");
    }
}
