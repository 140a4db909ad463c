using System;
using System.Threading;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace Demos.Fuzz.Operations;

/// <summary>Steps, with callbacks that behave and callbacks that do not.</summary>
static class StepOperations
{
    public static FuzzOperation[] All { get; } =
    [
        new("Timestep", 60, w => Timestep(w, Dt(w), w.AnyDispatcher())),
        new("Timestep of bad length", 6, w => Timestep(w, w.Random.Spoil(Dt(w), 60), w.AnyDispatcher())),
        new("The stages of a step", 6, w =>
        {
            float dt = Dt(w);
            ThreadDispatcher? dispatcher = w.AnyDispatcher();
            w.Simulation.Sleep(dispatcher);
            w.Look(() => w.Simulation.PredictBoundingBoxes(dt, dispatcher), looksAtInertias: true);
            w.Look(() => w.Simulation.CollisionDetection(dt, dispatcher));
            w.Look(() => w.Simulation.Solve(dt, dispatcher));
        }),
        new("Sleep", 2, w => w.Simulation.Sleep(w.AnyDispatcher())),
        new("PredictBoundingBoxes", 1, w =>
        {
            w.Look(() => w.Simulation.PredictBoundingBoxes(w.Random.Spoil(Dt(w)), w.AnyDispatcher()), looksAtInertias: true);
            // The tree is fitted by the stage that follows.
            w.Simulation.BroadPhase.Update();
        }),
        new("CollisionDetection", 1, w => w.Look(() =>
            w.Simulation.CollisionDetection(w.Random.Spoil(Dt(w)), w.AnyDispatcher()))),
        new("Solve", 1, w => w.Look(() => w.Simulation.Solve(w.Random.Spoil(Dt(w)), w.AnyDispatcher()))),
        new("Timestep that refuses pairs", 2, w => Step(w, plan => plan.RefusesPairs = true)),
        new("Timestep with another material", 4, w => Step(w, plan => plan.Material = new(
            w.Random.Number(0, 2), w.Random.Number(0, 5), new SpringSettings(w.Random.Magnitude(1, 100), w.Random.Number(0, 2))))),
        new("Timestep with a margin", 2, w => Step(w, plan => plan.Margin = w.Random.Number(0, 2))),
        .. Bad("material", (w, plan) => plan.Material = w.Random.Spoil(plan.Material, 60)),
        .. Bad("margin", (w, plan) => plan.Margin = w.Random.Bad()),
        .. Bad("contact count", (w, plan) => plan.ContactCount = w.Random.Below(9)),
        .. Bad("velocity", (w, plan) => plan.Velocity = w.Has(FuzzScope.DirectWrites) ? w.Random.Bad() : w.Random.Number(-1000, 1000)),
        new("Timestep, a callback throws", 6, w =>
        {
            if (w.Has(FuzzScope.ThrowingCallbacks))
                Step(w, plan => plan.Do(w.Random.Below(30), () => throw new FuzzCallbackException()));
        }),
        new("Timestep, a callback calls", 8, w =>
        {
            if (w.Has(FuzzScope.CallsFromCallbacks))
                StepAndCall(w);
        }),
    ];

    static float Dt(FuzzWorld w)
    {
        float dt = w.Random.Percent(60) ? 1 / 60f : w.Random.Magnitude(1e-4f, 0.1f);
        w.Tell($"dt {dt}");
        return dt;
    }

    static void Timestep(FuzzWorld w, float dt, ThreadDispatcher? dispatcher)
    {
        w.Look(() => w.Simulation.Timestep(dt, dispatcher), looksAtInertias: true);
        w.StoppedCount += w.Simulation.Quarantine.Count;
    }

    static FuzzOperation[] Bad(string what, Action<FuzzWorld, FuzzPlan> change) =>
    [
        new($"Timestep with a bad {what}", 2, w =>
        {
            if (w.Has(FuzzScope.BadCallbacks))
                Step(w, plan => change(w, plan));
        }),
    ];

    static void Step(FuzzWorld w, Action<FuzzPlan> change)
    {
        float dt = Dt(w);
        ThreadDispatcher? dispatcher = w.AnyDispatcher();
        w.Plan.IsAlone = dispatcher is null;
        change(w.Plan);
        try
        {
            Timestep(w, dt, dispatcher);
        }
        finally
        {
            w.Plan.Reset();
        }
    }

    // Another call, drawn like all others, from inside of a callback or from a thread of its own meanwhile.
    static void StepAndCall(FuzzWorld w)
    {
        FuzzOperation inner = FuzzOperations.Draw(w.Random);
        bool isOnOtherThread = w.Random.Percent(30);
        ulong seed = w.Random.NextBits();
        Exception? failure = null;
        void Call()
        {
            FuzzRandom outer = w.Random;
            w.Random = new FuzzRandom(seed);
            // Where other threads work at the step, what they change meanwhile cannot be told from what the call changes.
            bool isAlone = w.Plan.IsAlone;
            ulong before = isAlone ? FuzzFingerprint.Of(w.Simulation) : 0;
            try
            {
                inner.Run(w);
            }
            catch (Exception error)
            {
                if (!FuzzRun.IsRefusal(error) && error is not FuzzCallbackException)
                    failure = error;
                else if (isAlone && FuzzFingerprint.Of(w.Simulation) != before)
                    failure = new FuzzFailure($"refused ({error.Message}), but changed something", error);
            }
            finally
            {
                w.Random = outer;
            }
        }
        w.Tell($"{inner.Name} after {seed % 20} {(isOnOtherThread ? "on another thread" : "")}");
        Step(w, plan => plan.Do((int)(seed % 20), () =>
        {
            if (!isOnOtherThread)
            {
                Call();
                return;
            }
            var thread = new Thread(Call);
            thread.Start();
            thread.Join();
        }));
        if (failure is not null)
            throw new FuzzFailure($"{inner.Name} from a callback: {failure.Message}", failure);
    }
}
