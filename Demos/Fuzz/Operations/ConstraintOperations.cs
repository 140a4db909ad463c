using System;
using BepuPhysics;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace Demos.Fuzz.Operations;

/// <summary>Calls to constraints of all types.</summary>
static class ConstraintOperations
{
    public static FuzzOperation[] All { get; } =
    [
        .. Of(w => new BallSocket { LocalOffsetA = w.Random.Vector(1), LocalOffsetB = w.Random.Vector(1), SpringSettings = Spring(w) }),
        .. Of(w => new Weld { LocalOffset = w.Random.Vector(1), LocalOrientation = w.Random.Turn(), SpringSettings = Spring(w) }),
        .. Of(w => new Hinge
        {
            LocalOffsetA = w.Random.Vector(1), LocalHingeAxisA = w.Random.Direction(), LocalOffsetB = w.Random.Vector(1),
            LocalHingeAxisB = w.Random.Direction(), SpringSettings = Spring(w),
        }),
        .. Of(w => new SwingLimit
        {
            AxisLocalA = w.Random.Direction(), AxisLocalB = w.Random.Direction(), MinimumDot = w.Random.Number(-1, 1), SpringSettings = Spring(w),
        }),
        .. Of(w => new TwistLimit
        {
            LocalBasisA = w.Random.Turn(), LocalBasisB = w.Random.Turn(), MinimumAngle = w.Random.Number(-3, 0),
            MaximumAngle = w.Random.Number(0, 3), SpringSettings = Spring(w),
        }),
        .. Of(w => new DistanceLimit(w.Random.Vector(1), w.Random.Vector(1), w.Random.Number(0, 1), w.Random.Number(1, 3), Spring(w))),
        .. OfOneBody(w => new OneBodyLinearServo
        {
            LocalOffset = w.Random.Vector(1), Target = w.Random.Vector(3), SpringSettings = Spring(w),
            ServoSettings = w.Random.Percent(50) ? ServoSettings.Default : new(w.Random.Number(0, 5), w.Random.Number(0, 1), w.Random.Number(0, 100)),
        }),
        new("Solver.Remove", 14, w => w.Simulation.Solver.Remove(w.AnyConstraint())),
        new("Solver.ConstraintExists", 1, w => w.Simulation.Solver.ConstraintExists(w.AnyConstraint())),
        new("Solver.GetAccumulatedImpulseMagnitude", 2, w => w.Simulation.Solver.GetAccumulatedImpulseMagnitude(w.AnyConstraint())),
        new("Solver.GetAccumulatedImpulseMagnitudeSquared", 1, w => w.Simulation.Solver.GetAccumulatedImpulseMagnitudeSquared(w.AnyConstraint())),
        new("Solver.EnumerateAccumulatedImpulses", 2, w =>
        {
            var sum = new Sum();
            w.Simulation.Solver.EnumerateAccumulatedImpulses(w.AnyConstraint(), ref sum);
        }),
        new("Solver.GetConstraintReference", 2, w => w.Simulation.Solver.GetConstraintReference(w.AnyConstraint())),
        new("Solver.CountConstraints", 1, w => w.Simulation.Solver.CountConstraints()),
    ];

    struct Sum : IForEach<float>
    {
        float sum;

        public void LoopBody(float i) => sum += i;
    }

    static SpringSettings Spring(FuzzWorld w) =>
        w.Random.Percent(50) ? default : new SpringSettings(w.Random.Magnitude(0.1f, 1000), w.Random.Number(0, 3));

    // What can be called with every type of constraint. Handles of other types are among those that are drawn.
    static FuzzOperation[] Any<T>(Func<FuzzWorld, T> describe) where T : unmanaged, IConstraintDescription<T> =>
    [
        new($"Solver.ApplyDescription<{typeof(T).Name}>", 2, w => w.Simulation.Solver.ApplyDescription(w.AnyConstraint(), Spoiled(w, describe))),
        new($"Solver.ApplyDescriptionWithoutWaking<{typeof(T).Name}>", 1,
            w => w.Simulation.Solver.ApplyDescriptionWithoutWaking(w.AnyConstraint(), Spoiled(w, describe))),
        new($"Solver.GetDescription<{typeof(T).Name}>", 2, w => w.Simulation.Solver.GetDescription(w.AnyConstraint(), out T _)),
        new($"Solver.Add<{typeof(T).Name}> to a list", 2, w =>
        {
            var bodies = new BodyHandle[w.Random.Percent(80) ? T.BodyCount : w.Random.Below(5)];
            for (int i = 0; i < bodies.Length; ++i)
                bodies[i] = w.AnyBody();
            T description = Spoiled(w, describe);
            w.Constraints.Live.Add(w.Simulation.Solver.Add(bodies.AsSpan(), description));
        }),
        new($"Solver.Register<{typeof(T).Name}>", 1, w => w.Simulation.Solver.Register<T>()),
    ];

    static FuzzOperation[] Of<T>(Func<FuzzWorld, T> describe) where T : unmanaged, ITwoBodyConstraintDescription<T> =>
    [
        new($"Solver.Add<{typeof(T).Name}>", 7, w =>
        {
            BodyHandle a = w.AnyBody(), b = w.AnyBody();
            w.Constraints.Live.Add(w.Simulation.Solver.Add(a, b, Spoiled(w, describe)));
        }),
        .. Any(describe),
    ];

    static FuzzOperation[] OfOneBody<T>(Func<FuzzWorld, T> describe) where T : unmanaged, IOneBodyConstraintDescription<T> =>
    [
        new($"Solver.Add<{typeof(T).Name}>", 7, w => w.Constraints.Live.Add(w.Simulation.Solver.Add(w.AnyBody(), Spoiled(w, describe)))),
        .. Any(describe),
    ];

    static unsafe T Spoiled<T>(FuzzWorld w, Func<FuzzWorld, T> describe) where T : unmanaged
    {
        T description = w.Random.Spoil(describe(w), 10);
        if (w.IsVerbose)
        {
            foreach (float field in new ReadOnlySpan<float>(&description, sizeof(T) / sizeof(float)))
                w.Tell($"{field}");
        }
        return description;
    }
}
