using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>The named settings of the solver keep what their comments say of them.</summary>
public class NamedSettingsTests
{
    [Fact]
    public void The_default_is_what_one_iteration_and_four_substeps_give()
    {
        Assert.Equal(new SolveDescription(1, 4), SolveDescription.Default);
        Assert.Equal(LoadPathMode.WhereNeeded, new SolveDescription(8, 1).LoadPath);
        Assert.Equal(LoadPathMode.WhereNeeded, new SolveDescription([1, 2]).LoadPath);
        Assert.Equal(LoadPathMode.WhereNeeded, ((SolveDescription)(1, 4)).LoadPath);
    }

    /// <summary>The gap of a joint that bears a load goes with the square of the length of a substep, and a relaxation halves that length.</summary>
    [Fact]
    public void Joints_give_way_as_far_as_is_said()
    {
        float usual = Gap(SolveDescription.Default);
        Assert.InRange(Gap(SolveDescription.Fast) / usual, 3, 5);
        Assert.InRange(usual / Gap(SolveDescription.Accurate), 12, 20);
    }

    /// <summary>A stack of thirty stands at all of them as it was built.</summary>
    [Fact]
    public void Stacks_stand_at_all_of_them()
    {
        foreach (var solve in new[] { SolveDescription.Fast, SolveDescription.Default, SolveDescription.Accurate })
        {
            using var pool = new BufferPool();
            using (var simulation = Create(pool, solve))
            {
                simulation.Statics.Add(new StaticDescription(new Vector3(0, -5, 0), simulation.Shapes.Add(new Box(100, 10, 100))));
                BodyHandle top = default;
                for (int i = 0; i < 30; ++i)
                    top = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(new Vector3(0, i + .5f, 0), 1, simulation.Shapes, new Box(1, 1, 1)));
                for (int i = 0; i < 1200; ++i)
                    simulation.Timestep(1 / 60f);
                Assert.InRange(Vector3.Distance(simulation.Bodies[top].Pose.Position, new Vector3(0, 29.5f, 0)), 0, 2e-3f);
            }
            pool.AssertEmpty();
        }
    }

    // A kilogram hangs from a ball socket under a kinematic body.
    static float Gap(SolveDescription solve)
    {
        using var pool = new BufferPool();
        using var simulation = Create(pool, solve);
        var hook = simulation.Bodies.Add(BodyDescription.CreateKinematic(new Vector3(0, 1, 0), simulation.Shapes.Add(new Sphere(.1f)), -1));
        var body = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(default(Vector3), 1, simulation.Shapes, new Sphere(.1f)));
        simulation.Solver.Add(hook, body, new BallSocket { LocalOffsetA = new Vector3(0, -.5f, 0), LocalOffsetB = new Vector3(0, .5f, 0) });
        for (int i = 0; i < 600; ++i)
            simulation.Timestep(1 / 60f);
        return MathF.Abs(simulation.Bodies[body].Pose.Position.Y);
    }

    static Simulation Create(BufferPool pool, SolveDescription solve) =>
        Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), solve);
}
