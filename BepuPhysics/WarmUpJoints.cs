using System.Numerics;
using System.Threading;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>A small world of its own in which joints are solved at once, so that the step in which the first of a game are finds its code compiled.</summary>
static class WarmUpJoints
{
    // One by itself, and as many alike as are solved in the lanes of a vector: two widths.
    const int AlikeCount = 1 + DirectPlan.FourLanes + DirectPlan.MostLanes;
    const float Spacing = 10;

    static int warmedUp;

    /// <summary>Runs the world, once in a process.</summary>
    internal static void Run()
    {
        if (Interlocked.Exchange(ref warmedUp, 1) != 0)
            return;
        using var pool = new BufferPool();
        using var simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(),
            new SolveDescription(1, 2) { DirectJoints = DirectJointsMode.Always });
        for (int i = 0; i < AlikeCount; ++i)
        {
            // Four of these are alike, then eight more: what hangs below them says which.
            var top = Hang(simulation, new Vector3(i * Spacing, 0, 0), i == 0 ? 3 : i <= DirectPlan.FourLanes ? 1 : 2);
            // What has bounds takes methods of its own.
            if (i == 0)
                simulation.Solver.Add(top, new OneBodyLinearServo
                {
                    Target = new Vector3(0, .5f, 0),
                    ServoSettings = ServoSettings.Default,
                });
        }
        simulation.Timestep(1 / 60f);
        simulation.Solver.DirectJoints = DirectJointsMode.WhereNeeded;
        for (int step = 0; step < 2 * Solver.NeedTurns; ++step)
            simulation.Timestep(1 / 60f);
    }

    // A chain that hangs from what does not move, with a loop at its top.
    static BodyHandle Hang(Simulation simulation, Vector3 place, int count)
    {
        var inertia = new Sphere(.5f).ComputeInertia(1);
        var fixture = simulation.Bodies.Add(BodyDescription.CreateKinematic(place, default, -1));
        var above = fixture;
        var top = fixture;
        for (int i = 1; i <= count; ++i)
        {
            var next = simulation.Bodies.Add(BodyDescription.CreateDynamic(new RigidPose(place - i * Vector3.UnitY), inertia, default, -1));
            simulation.Solver.Add(above, next, new BallSocket { LocalOffsetB = Vector3.UnitY });
            top = i == 1 ? next : top;
            above = next;
        }
        simulation.Solver.Add(fixture, top, new DistanceLimit { MinimumDistance = .1f, MaximumDistance = 2 });
        simulation.Solver.Add(fixture, top, new AngularHinge { LocalHingeAxisA = Vector3.UnitX, LocalHingeAxisB = Vector3.UnitZ });
        return top;
    }
}
