using System;
using System.IO;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Constraints;
using Demos.Pages;
using DemoTests.Constraints;
using Xunit;

namespace DemoTests.Quality;

/// <summary>The pages of the constraints say what the types say, and their examples hold.</summary>
public sealed class ConstraintPageTests
{
    const string Folder = "Docs/Constraints";

    public static TheoryData<string> Names => [.. JointTypes.All.Select(type => type.Name)];

    static JointFacts FactsOf(string name) => JointFacts.All.Single(facts => facts.Name == name);

    [Fact]
    public void Pages_and_pictures_are_those_that_the_command_writes()
    {
        var files = ConstraintPages.Write();
        Assert.Equal(files.Keys, Directory.GetFiles(RepositoryFiles.PathOf(Folder)).Select(Path.GetFileName).Order(StringComparer.Ordinal));
        Assert.All(files, file => Assert.Equal(file.Value, RepositoryFiles.Read($"{Folder}/{file.Key}").ReplaceLineEndings("\n")));
    }

    [Theory, MemberData(nameof(Names))]
    public void Each_type_has_a_page_with_all_that_a_game_sets(string name)
    {
        var type = JointTypes.All.Single(type => type.Name == name);
        var page = RepositoryFiles.Read($"{Folder}/{name}.md");
        Assert.Contains($"({name}.svg)", page, StringComparison.Ordinal);
        Assert.Contains($"[{name}]({name}.md) | {type.BodyCount} |", RepositoryFiles.Read($"{Folder}/{ConstraintPages.Index}"), StringComparison.Ordinal);
        Assert.Contains($"new {name}", DocPages.CodeBlocks($"{Folder}/{name}.md").Single(), StringComparison.Ordinal);
        var rows = DocPages.TableRows($"{Folder}/{name}.md").ToArray();
        Assert.All(type.Description.GetFields(), field => Assert.Contains(rows, row => row.Length == 3 && row[0] == field.Name && row[2].Length > 10));
    }

    /// <summary>A second after a throw, one way and the other: what is to be held is held, and bodies do not move as without the joint.</summary>
    [Theory, MemberData(nameof(Names))]
    public void Each_example_holds(string name)
    {
        var facts = FactsOf(name);
        var difference = 0f;
        foreach (var sign in new[] { 1, -1 })
        {
            using JointStage stage = new(facts), free = new(facts);
            Assert.IsType(facts.Description, stage.Describe(facts));
            free.Simulation.Solver.Remove(free.Joint);
            AssertSeparation(stage, facts, 1e-6f);
            Throw(stage, sign);
            Throw(free, sign);
            // Springs of five hertz give way by some millimetres: they are hit by less than 0.5 m/s, over 31 rad/s, and have a second to come to rest.
            AssertSeparation(stage, facts, 0.02f);
            var (held, alone) = (VelocityOfLast(stage), VelocityOfLast(free));
            difference += Vector3.Distance(held.Linear, alone.Linear) + Vector3.Distance(held.Angular, alone.Angular);
        }
        Assert.True(difference > 1e-2f, $"{name} did nothing.");
    }

    static void Throw(JointStage stage, int sign)
    {
        var body = stage.Simulation.Bodies[stage.Bodies[^1]];
        body.Velocity.Linear = sign * new Vector3(0.3f, 0.5f, 0.2f);
        body.Velocity.Angular = sign * new Vector3(0.2f, 0.1f, 0.4f);
        for (int i = 0; i < 60; ++i)
            stage.Simulation.Timestep(1 / 60f);
    }

    static BodyVelocity VelocityOfLast(JointStage stage) => stage.Simulation.Bodies[stage.Bodies[^1]].Velocity;

    // Motors have none.
    static void AssertSeparation(JointStage stage, JointFacts facts, float most)
    {
        if (facts.Kind == RowKind.Motor)
            return;
        var separation = stage.Simulation.Solver.GetSeparation(stage.Joint);
        Assert.InRange(separation.Linear, -most, most);
        Assert.InRange(separation.Angular, -most, most);
    }

    /// <summary>What mechanics says of the joints that everyone knows.</summary>
    [Theory]
    [InlineData("BallSocket", "turn about x, turn about y, turn about z")]
    [InlineData("Hinge", "turn about y")]
    [InlineData("SwivelHinge", "turn about y, turn about z")]
    [InlineData("Slider", "move along y")]
    [InlineData("Weld", "")]
    [InlineData("AngularHinge", "move along x, move along y, move along z, turn about y")]
    [InlineData("DistanceServo", "move along x")]
    [InlineData("TwistMotor", "turn about x")]
    [InlineData("AngularAxisMotor", "turn about x")]
    [InlineData("OneBodyLinearMotor", "move along x, move along y, move along z")]
    [InlineData("LinearAxisLimit", "move along y")]
    [InlineData("OneBodyAngularServo", "turn about x, turn about y, turn about z")]
    [InlineData("Pulley", "move along y")]
    [InlineData("CenterDistanceConstraint", "move along y, move along z, turn about x, turn about y, turn about z")]
    public void Pictures_show_the_motions_of_a_joint(string name, string motions) =>
        Assert.Equal(motions, string.Join(", ", new JointPicture(FactsOf(name)).Motions));
}
