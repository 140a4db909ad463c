using System;
using System.Collections.Concurrent;
using System.Diagnostics.Tracing;
using System.Linq;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Threading;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Quality;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>Compiling ahead of the first step.</summary>
public class WarmUpTests
{
    [Fact]
    public void Nothing_is_compiled_for_the_callbacks_in_a_step_after_a_warm_up()
    {
        if (JitWatch.BuildIsUnoptimized)
            return;
        using var pool = new BufferPool();
        using var listener = new Listener();
        using var simulation = Simulation.Create(pool, new WarmContacts(), new WarmGravity(), new SolveDescription(1, 4));
        Fill(simulation);
        simulation.WarmUp();
        AfterWarmUp();
        listener.WaitFor(nameof(AfterWarmUp));
        var before = listener.CountOf(nameof(WarmContacts)) + listener.CountOf(nameof(WarmGravity));
        Assert.True(before > 100, $"{before} methods were compiled.");
        listener.Loaded.Clear();

        for (int i = 0; i < 120; ++i)
            simulation.Timestep(1 / 60f);

        AfterSteps();
        listener.WaitFor(nameof(AfterSteps));
        var late = listener.Loaded.Where(name => name.Contains(nameof(WarmContacts), StringComparison.Ordinal) ||
            name.Contains(nameof(WarmGravity), StringComparison.Ordinal)).ToArray();
        string[] large = ["TestPair", "Complete", "Execute", "Integrate", "Predict", "RunTraversal", "FindOverlaps", "Flush", "CollisionBatcher"];
        Assert.DoesNotContain(late, name => large.Any(part => name.Contains(part, StringComparison.Ordinal)));
        Assert.True(late.Length < 20, string.Join('\n', late));
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    public void A_warm_up_changes_nothing(int threads)
    {
        using var dispatcher = new ThreadDispatcher(threads);
        using var warm = new TestWorld();
        using var cold = new TestWorld();
        Fill(warm.Simulation);
        Fill(cold.Simulation);
        warm.Step(5);
        cold.Step(5);
        var bytes = warm.Pool.GetTotalAllocatedByteCount();

        warm.Simulation.WarmUp(threads > 1 ? dispatcher : null);

        Assert.Equal(bytes, warm.Pool.GetTotalAllocatedByteCount());
        warm.Simulation.Validate();
        warm.Step(20);
        cold.Step(20);
        Assert.Equal(cold.Simulation.StateHash(), warm.Simulation.StateHash());
    }

    [Fact]
    public void The_callbacks_are_not_called()
    {
        using var pool = new BufferPool();
        using var simulation = Simulation.Create(pool, new RefusingContacts(), new RefusingGravity(), new SolveDescription(1, 4));
        Fill(simulation);
        simulation.WarmUp();
        Assert.Throws<NotSupportedException>(() => simulation.Timestep(1 / 60f));
    }

    static void Fill(Simulation simulation)
    {
        var box = new Box(1, 1, 1);
        var boxes = simulation.Shapes.Add(box);
        var cylinder = new Cylinder(.5f, 1);
        var cylinders = simulation.Shapes.Add(cylinder);
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), simulation.Shapes.Add(new Box(20, 1, 20))));
        var previous = default(BodyHandle);
        for (int i = 0; i < 12; ++i)
        {
            var inertia = i % 2 == 0 ? box.ComputeInertia(1) : cylinder.ComputeInertia(1);
            var body = simulation.Bodies.Add(BodyDescription.CreateDynamic(
                new RigidPose(new Vector3(i % 3, .6f + i / 3 * 1.1f, 0)), inertia, i % 2 == 0 ? boxes : cylinders, .01f));
            if (i % 4 == 3)
                simulation.Solver.Add(previous, body, new BallSocket { LocalOffsetA = new(.5f, 0, 0), LocalOffsetB = new(-.5f, 0, 0) });
            previous = body;
        }
    }

    // Events come later than what they tell of, but in order: when these have been compiled, so has all before them.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void AfterWarmUp() { }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void AfterSteps() { }

    // Names of the methods that the runtime has compiled since, in the whole process.
    sealed class Listener : EventListener
    {
        const EventKeywords Jit = (EventKeywords)0x10;

        public ConcurrentQueue<string> Loaded { get; } = new();

        public int CountOf(string part) => Loaded.Count(name => name.Contains(part, StringComparison.Ordinal));

        public void WaitFor(string marker) => Assert.True(SpinWait.SpinUntil(
            () => Loaded.Any(name => name.EndsWith(nameof(WarmUpTests) + "." + marker, StringComparison.Ordinal)), TimeSpan.FromSeconds(60)));

        protected override void OnEventSourceCreated(EventSource eventSource)
        {
            if (eventSource.Name == "Microsoft-Windows-DotNETRuntime")
                EnableEvents(eventSource, EventLevel.Verbose, Jit);
        }

        protected override void OnEventWritten(EventWrittenEventArgs eventData)
        {
            if (eventData.EventName?.StartsWith("MethodLoadVerbose", StringComparison.Ordinal) == true && eventData.Payload is { } payload)
                Loaded.Enqueue($"{payload[6]}.{payload[7]}");
        }
    }

    struct WarmContacts : INarrowPhaseCallbacks
    {
        public readonly void Initialize(Simulation simulation) { }
        public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) => true;
        public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;
        public readonly bool ConfigureContactManifold<TManifold>(
            int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            pairMaterial = new(.5f, 2, default);
            return true;
        }
        public readonly bool ConfigureContactManifold(
            int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;
        public readonly void Dispose() { }
    }

    struct WarmGravity : IPoseIntegratorCallbacks
    {
        float change;

        public readonly AngularIntegrationMode AngularIntegrationMode => AngularIntegrationMode.Nonconserving;
        public readonly bool AllowSubstepsForUnconstrainedBodies => true;
        public readonly bool IntegrateVelocityForKinematics => false;
        public readonly void Initialize(Simulation simulation) { }
        public void PrepareForIntegration(float dt) => change = -10 * dt;
        public readonly void IntegrateVelocity(Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia,
            Vector<int> integrationMask, int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity) => velocity.Linear.Y += new Vector<float>(change);
    }

    struct RefusingContacts : INarrowPhaseCallbacks
    {
        public readonly void Initialize(Simulation simulation) { }
        public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) =>
            throw new NotSupportedException();
        public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) =>
            throw new NotSupportedException();
        public readonly bool ConfigureContactManifold<TManifold>(
            int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
            where TManifold : unmanaged, IContactManifold<TManifold> => throw new NotSupportedException();
        public readonly bool ConfigureContactManifold(
            int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) =>
            throw new NotSupportedException();
        public readonly void Dispose() { }
    }

    struct RefusingGravity : IPoseIntegratorCallbacks
    {
        // A game may have declared what its machine does not have.
        [DllImport("no-such-library")]
        static extern void Missing();

        public readonly AngularIntegrationMode AngularIntegrationMode => throw new NotSupportedException();
        public readonly bool AllowSubstepsForUnconstrainedBodies => throw new NotSupportedException();
        public readonly bool IntegrateVelocityForKinematics => throw new NotSupportedException();
        public readonly void Initialize(Simulation simulation) { }
        public readonly void PrepareForIntegration(float dt) => throw new NotSupportedException();
        public readonly void IntegrateVelocity(Vector<int> bodyIndices, Vector3Wide position, QuaternionWide orientation, BodyInertiaWide localInertia,
            Vector<int> integrationMask, int workerIndex, Vector<float> dt, ref BodyVelocityWide velocity) => throw new NotSupportedException();
    }
}
