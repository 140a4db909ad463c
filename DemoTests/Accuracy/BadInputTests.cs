using System;
using System.Linq;
using Xunit;

namespace DemoTests.Accuracy;

/// <summary>
/// Bad input (X13): each attempt is refused with an exception that names the argument, changes nothing that a game can see, and the next
/// ten steps
/// are those of a world in which nobody tried.
/// </summary>
public class BadInputTests
{
    static readonly BadInputList list = All();

    public static TheoryData<string> Names => [.. list.Cases.Keys];

    [Theory]
    [MemberData(nameof(Names))]
    public void X13_IsRefused(string name)
    {
        string? finding = list.Cases[name].Judge();
        Assert.True(finding is null, finding);
    }

    /// <summary>Small leaks of single refusals add up here: capacities, pool memory, indices.</summary>
    [Fact]
    public void X13_AllRefusalsTogetherLeaveTheWorldAsItWas()
    {
        using var world = new BadInputWorld();
        foreach (var attempt in list.Cases.Values)
            Assert.True(attempt.Try(world) is null, attempt.Name);
        Assert.Equal(BadInputWorld.UndisturbedFuture, world.Future());
    }

    [Fact]
    public void TheWorldOfTheCasesRepeatsItself()
    {
        using var world = new BadInputWorld();
        Assert.Equal(BadInputWorld.UndisturbedFuture, world.Future());
        Assert.Equal(BadInputWorld.UndisturbedFuture.Length, BadInputWorld.UndisturbedFuture.Distinct().Count());
    }

    /// <summary>The judge must see each way in which an engine can fail, or its silence means nothing.</summary>
    [Fact]
    public void TheJudgeFindsEachKindOfFailure()
    {
        Assert.Null(Judge(static _ => throw new ArgumentException("Bad radius.", "radius")));
        Assert.Null(Judge(static _ => throw new ArgumentOutOfRangeException("radius", -1f, "Must be positive.")));
        Assert.Contains("was accepted", Judge(static _ => { }));
        Assert.Contains("names none", Judge(static _ => throw new ArgumentException("No.")));
        Assert.Contains("instead of", Judge(static _ => throw new InvalidOperationException("radius")));
        Assert.Contains("has changed", Judge(static w =>
        {
            w.Bodies[w.FreeBody].Velocity.Linear.X = MathF.BitIncrement(w.Bodies[w.FreeBody].Velocity.Linear.X);
            throw new ArgumentException("radius");
        }));
        // Adds and takes away a shape and keeps its slot: only the future shows it.
        Assert.Contains("differ", Judge(static w =>
        {
            w.Simulation.Shapes.Add(new BepuPhysics.Collidables.Sphere(1));
            throw new ArgumentException("radius");
        }));

        static string? Judge(Action<BadInputWorld> attempt) => new BadInputCase("", ["radius"], attempt).Judge();
    }

    static BadInputList All()
    {
        var all = new BadInputList();
        BadBodyInput.AddTo(all);
        BadShapeInput.AddTo(all);
        BadSolverInput.AddTo(all);
        BadFieldInput.AddTo(all);
        return all;
    }
}
