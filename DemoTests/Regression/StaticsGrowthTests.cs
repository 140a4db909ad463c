using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// More statics than were expected wrote behind the end of their list of handles: the pool had lent more room for the statics than for the
/// handles, and only the former was looked at.
/// </summary>
public class StaticsGrowthTests
{
    [Theory, InlineData(16), InlineData(100), InlineData(4096)]
    public void All_lists_of_statics_grow_together(int expectedCount)
    {
        using var pool = new BufferPool();
        var sizes = SimulationAllocationSizes.Default;
        sizes.Statics = expectedCount;
        using (var simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4), initialAllocationSizes: sizes))
        {
            var shape = simulation.Shapes.Add(new Sphere(0.4f));
            var statics = simulation.Statics;
            while (statics.Count < expectedCount * 5)
            {
                statics.Add(new StaticDescription(new Vector3(statics.Count, 0, 0), shape));
                Assert.True(statics.Count <= statics.IndexToHandle.Length && statics.Count <= statics.StaticsBuffer.Length);
            }
            for (int i = 0; i < statics.Count; ++i)
                Assert.Equal(i, statics[statics.IndexToHandle[i]].Pose.Position.X);
        }
        pool.AssertEmpty();
    }
}
