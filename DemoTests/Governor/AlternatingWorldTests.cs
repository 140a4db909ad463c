using BepuPhysics;
using Demos.Governing;
using Xunit;

namespace DemoTests.Governor;

/// <summary>The worlds of the command that measures what a governor saves.</summary>
public class AlternatingWorldTests
{
    /// <summary>Twice the target needs fewer substeps than the target, and both are held.</summary>
    [Theory, InlineData(.001f, 10, 17), InlineData(.002f, 7, 12)]
    public void A_chain_takes_the_substeps_that_its_target_needs(float target, double least, double most)
    {
        using var world = new AlternatingWorld(AlternatingKind.Chain, 2, 2, new SubstepGovernor(target, 2, 32));
        world.Run();
        Assert.InRange(world.Error, 0, target);
        Assert.InRange(world.Substeps, least, most);
        Assert.True(world.Milliseconds > 0);
    }
}
