using System.Linq;
using Demos.Running;
using Demos.Scenes;
using Xunit;

namespace DemoTests.Runner;

/// <summary>The built-in scenes of joints show what they are there for, as a game gets them that asks for nothing.</summary>
public class JointSceneTests
{
    static RunResult Run(string name, int substeps = 4, int? steps = null)
    {
        using var run = new SceneRun(SceneLibrary.Load(name, 1), new RunSettings { Substeps = substeps, Steps = steps });
        RunResult result = run.Run();
        Assert.Equal(0, result.NotFinite);
        // Damping takes energy, and nothing in these scenes gives any.
        Assert.True(result.KineticEnergy + result.PotentialEnergy <= StartEnergy(name), $"{name}: {result.KineticEnergy} J + {result.PotentialEnergy} J");
        return result;
    }

    static double StartEnergy(string name) => SceneLibrary.Load(name, 1).Bodies.Where(body => body.Kind == SceneBodyKind.Dynamic)
        .Sum(body => body.Mass * (body.LinearVelocity.LengthSquared() / 2.0 - (double)SceneDescription.Gravity * body.Position.Y));

    [Fact]
    public void Ragdolls_come_to_lie_in_one_piece()
    {
        RunResult result = Run("ragdolls");
        Assert.Equal((0, 704), (result.Lost, result.Bodies));
        Assert.InRange(result.MaximumJointError!.Value, 0, .02);
        // Less than 2 J each: they lie, and hardly any limb still falls.
        Assert.InRange(result.KineticEnergy, 0, 128);
    }

    /// <summary>Parts of a link's 0.2 m. Four substeps are few for a hundredfold mass; at 32 a chain is one.</summary>
    [Theory]
    [InlineData("chain", 4, .5)]
    [InlineData("chain", 32, .01)]
    [InlineData("chain-1000", 32, .1)]
    public void A_chain_stretches_by_no_more(string name, int substeps, double stretch) =>
        Assert.InRange(Run(name, substeps, steps: 300).RmsJointError!.Value / .2, 0, stretch);

    [Fact]
    public void A_net_catches_a_ball()
    {
        RunResult result = Run("rope-net");
        Assert.Equal(0, result.Lost);
        // Of a rope's 0.4 m.
        Assert.InRange(result.RmsJointError!.Value / .4, 0, .05);
        // All of 50 kg that had fallen through would be 80 m lower.
        Assert.InRange(result.PotentialEnergy, -50 * 10 * 5, 50 * 10 * 2);
    }
}
