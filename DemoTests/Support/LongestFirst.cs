using System;
using System.Collections.Generic;
using System.Linq;
using DemoTests.Accuracy;
using DemoTests.CollisionDetection.Children;
using DemoTests.CollisionDetection.Seams;
using DemoTests.Constraints;
using DemoTests.Locking;
using DemoTests.Quality;
using DemoTests.Robustness;
using DemoTests.Scenes;
using DemoTests.Snapshots;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

[assembly: TestCollectionOrderer($"DemoTests.Support.{nameof(LongestFirst)}", "DemoTests")]

namespace DemoTests.Support;

/// <summary>
/// Classes whose tests take long come first, so that no processor waits for the last of them. The others come in the order of their names: the same in every
/// run, so that what one test leaves to the next is the same too.
/// </summary>
public sealed class LongestFirst : ITestCollectionOrderer
{
    // Those of more than some ten seconds, measured with the report of a run ("trx"), longest first.
    static readonly Type[] longest =
    [
        typeof(DeterminismTests), typeof(PackageTests), typeof(LockMatrixTests), typeof(MemoryOfOneThreadTests), typeof(SnapshotTests), typeof(JointTreeTests),
        typeof(HubScanTests), typeof(SeparateFloorTests), typeof(ImpactTests), typeof(ChildPairTests), typeof(QuarantineTests),
    ];

    // A class makes a collection of this name.
    static readonly string[] names = [.. longest.Select(type => $"Test collection for {type.FullName}")];

    public IEnumerable<ITestCollection> OrderTestCollections(IEnumerable<ITestCollection> testCollections) => testCollections
        .OrderBy(collection => Array.IndexOf(names, collection.DisplayName) is var place and >= 0 ? place : names.Length)
        .ThenBy(collection => collection.DisplayName, StringComparer.Ordinal);
}
