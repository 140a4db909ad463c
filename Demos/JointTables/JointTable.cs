using System;
using System.Collections.Generic;
using System.Linq;
using Demos.Accuracy;

namespace Demos.JointTables;

/// <summary>A scene of joints and what is measured of it over substeps and sweeps.</summary>
/// <param name="Name">As it is asked for.</param>
/// <param name="Summary">What it is, in a line.</param>
/// <param name="Figures">Names of the figures, with their units.</param>
/// <param name="Sweeps">Velocity iterations and relaxations that are tried at each number of substeps.</param>
/// <param name="Measure">Runs it.</param>
sealed record JointTable(
    string Name, string Summary, string[] Figures, (int Iterations, int Relaxations)[] Sweeps, Func<AccuracySettings, double[]> Measure)
{
    const int LinkCount = 100;

    /// <summary>Substeps that are tried.</summary>
    public static IReadOnlyList<int> Substeps { get; } = [1, 2, 4, 8, 16, 32];

    /// <summary>All tables.</summary>
    public static IReadOnlyList<JointTable> All { get; } =
    [
        .. LinkageLibrary.All.Select(linkage => new JointTable(linkage.Name, linkage.Summary,
            [
                linkage.IsPeriodic ? "period, %" : "", $"place after {LinkageRun.PlaceTime} s, mm",
                "most energy gained, %", "energy after a minute, %", "gap, mm",
            ],
            [(1, 0), (1, 1), (4, 0)], settings => Shown(LinkageRun.Measure(linkage, settings)))),
        Chain(100),
        Chain(1000),
    ];

    /// <summary>What differs from setting to setting.</summary>
    /// <param name="substeps">Per step.</param>
    /// <param name="sweeps">Per substep.</param>
    /// <param name="spring">One of those that the engine tries.</param>
    public static AccuracySettings Settings(int substeps, (int Iterations, int Relaxations) sweeps, string spring) => new()
    {
        SubstepCount = substeps,
        VelocityIterationCount = sweeps.Iterations,
        RelaxationCount = sweeps.Relaxations,
        Contacts = ContactScope.None,
        Stiff = spring != "default",
        SpringFollowsSweeps = spring == "swept",
    };

    static double[] Shown(LinkageRun run) =>
        [100 * run.PeriodError, 1000 * run.PlaceError, 100 * run.EnergyGain, 100 * run.EnergyLeft, 1000 * run.Gap];

    static JointTable Chain(int load) => new(
        $"chain-{load}", FormattableString.Invariant($"{LinkCount} links of 1 kg that hang, and {load} kg at the end, kicked"),
        ["mean stretch of a link, %"], [(1, 0), (2, 0), (4, 0), (8, 0), (16, 0), (1, 1)], settings =>
        {
            const double halfTime = 5;
            using var world = new AccuracyWorld(settings);
            var chain = new LoadedChain(world, ChainStart.HangingKicked, LinkCount, load);
            double sum = 0, worst = 0;
            int count = 0;
            world.Run(halfTime);
            world.Run(halfTime, () =>
            {
                chain.Gaps(out double stretch, ref worst);
                sum += stretch;
                ++count;
            });
            return [100 * sum / count];
        });
}
