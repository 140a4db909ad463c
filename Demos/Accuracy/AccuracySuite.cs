using System;
using System.Collections.Generic;
using System.Linq;
using Demos.Accuracy.Cases;

namespace Demos.Accuracy;

/// <summary>The cases of the accuracy suite that a program can run; the tests judge the same ones.</summary>
static class AccuracySuite
{
    /// <summary>All cases at both efforts, family by family.</summary>
    public static IReadOnlyList<AccuracyCase> All { get; } =
    [
        .. FreeFlightCases.All,
        .. SlopeCases.All,
        .. RollingCases.All,
        .. CylinderRollingCases.All,
        .. TroughCases.All,
        .. LandingSpinCases.All,
        .. TurntableCases.All,
        .. GoingRoundCases.All,
        .. DeckCases.All,
        .. SlidingSpinCases.All,
        .. FeetCases.All,
        .. RestitutionCases.All,
        .. RestCases.All,
        .. StackCases.All,
        .. PendulumCases.All,
        .. ChainCases.All,
        .. RestingCases.All,
        .. CoinCases.All,
        .. FastTurnCases.All,
        .. HubCases.All,
        .. ScaleCases.All,
        .. FarFromOriginCases.All,
        .. StepCases.All,
        .. OverlapCases.All,
    ];

    /// <summary>A case at both efforts.</summary>
    /// <param name="id">The family.</param>
    /// <param name="scene">What is simulated.</param>
    /// <param name="run">Simulates it.</param>
    public static IEnumerable<AccuracyCase> AtBothEfforts(string id, string scene, Action<AccuracySettings, CaseResult> run) =>
        Enum.GetValues<Effort>().Select(effort => new AccuracyCase(id, scene, effort, run));
}
