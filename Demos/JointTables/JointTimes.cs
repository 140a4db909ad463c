using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using System.Numerics;
using System.Reflection;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using Demos.Accuracy;
using Demos.Scenes;

namespace Demos.JointTables;

/// <summary>What a constraint costs in the engine that this program is compiled against, by what steps take with more substeps and more sweeps.</summary>
static class JointTimes
{
    // With their bodies few enough for the second-level cache, many enough for what a step costs by itself to be little.
    const int ConstraintCount = 1024;
    const int More = 16;
    const int Repetitions = 40;
    const float Dt = 1 / 60f;

    /// <summary>Types that both engines have.</summary>
    public static IReadOnlyList<string> Names { get; } =
    [
        "BallSocket", "Hinge", "SwivelHinge", "Weld", "AngularHinge", "AngularSwivelHinge", "SwingLimit", "TwistLimit", "DistanceLimit", "LinearAxisLimit",
        "CenterDistanceConstraint", "CenterDistanceLimit", "BallSocketServo", "DistanceServo", "PointOnLineServo", "LinearAxisServo", "AngularServo",
        "TwistServo", "BallSocketMotor", "LinearAxisMotor", "AngularMotor", "AngularAxisMotor", "AngularAxisGearMotor", "TwistMotor",
        "OneBodyLinearServo", "OneBodyAngularServo", "OneBodyLinearMotor", "OneBodyAngularMotor", "AreaConstraint", "VolumeConstraint",
    ];

    /// <summary>Measures a type.</summary>
    /// <exception cref="SceneException">There is no such type.</exception>
    public static JointTime Measure(string name)
    {
        Type type = typeof(BallSocket).Assembly.GetType($"{typeof(BallSocket).Namespace}.{name}")
            ?? throw new SceneException($"there is no constraint '{name}'");
        MethodInfo measure = typeof(JointTimes).GetMethod(nameof(MeasureType), BindingFlags.NonPublic | BindingFlags.Static)!.MakeGenericMethod(type);
        return (JointTime)measure.Invoke(null, BindingFlags.DoNotWrapExceptions, null, [name, BodyCount(type)], null)!;
    }

    static int BodyCount(Type type)
    {
        string[] numbers = ["One", "Two", "Three", "Four"];
        return 1 + Array.FindIndex(numbers, number => type.GetInterfaces().Any(known => known.Name.StartsWith($"I{number}Body", StringComparison.Ordinal)));
    }

    static JointTime MeasureType<TDescription>(string name, int bodyCount) where TDescription : unmanaged, IConstraintDescription<TDescription>
    {
        var settings = new AccuracySettings
        {
            Gravity = default,
            Contacts = ContactScope.None,
            SubstepCount = 1,
            AngularMode = AngularIntegrationMode.Nonconserving,
        };
        var pool = new BufferPool();
        Simulation simulation = Simulation.Create(pool, EngineTraits.Contacts(settings), new WorldGravity(settings), EngineTraits.Solve(settings));
        object description = default(TDescription);
        foreach (FieldInfo field in typeof(TDescription).GetFields(BindingFlags.Public | BindingFlags.Instance))
            field.SetValue(description, Value(field));
        var random = new SceneRandom(1);
        var handles = new BodyHandle[bodyCount];
        var inertia = new Box(1, .8f, .6f).ComputeInertia(1);
        for (int i = 0; i < ConstraintCount; ++i)
        {
            for (int k = 0; k < bodyCount; ++k)
            {
                var place = new Vector3(random.Next(-1, 1), random.Next(-1, 1), random.Next(-1, 1));
                handles[k] = simulation.Bodies.Add(BodyDescription.CreateDynamic(
                    new RigidPose(place), default, inertia, default(CollidableDescription), new BodyActivityDescription(-1)));
            }
            simulation.Solver.Add<TDescription>(handles, (TDescription)description);
        }
        // What is off at first has come to rest by then.
        for (int i = 0; i < 60; ++i)
            simulation.Timestep(Dt);
        double single = double.MaxValue, sweeps = double.MaxValue, substeps = double.MaxValue;
        for (int i = 0; i < Repetitions; ++i)
        {
            single = Math.Min(single, Time(1, 1));
            sweeps = Math.Min(sweeps, Time(1, 1 + More));
            substeps = Math.Min(substeps, Time(1 + More, 1));
        }
        simulation.Dispose();
        pool.Clear();
        return new JointTime(name, Vector<float>.Count, (sweeps - single) / (More * ConstraintCount), (substeps - single) / (More * ConstraintCount));

        double Time(int substepCount, int iterationCount)
        {
            simulation.Solver.SubstepCount = substepCount;
            simulation.Solver.VelocityIterationCount = iterationCount;
            // The step that follows a change may have more to do.
            simulation.Timestep(Dt);
            long start = Stopwatch.GetTimestamp();
            simulation.Timestep(Dt);
            return Stopwatch.GetElapsedTime(start).TotalNanoseconds;
        }
    }

    // Fields have the same names and types in both engines.
    static object Value(FieldInfo field) => field.Name switch
    {
        _ when field.FieldType == typeof(SpringSettings) => new SpringSettings(30, 1),
        _ when field.FieldType == typeof(ServoSettings) => new ServoSettings(float.MaxValue, 0, float.MaxValue),
        _ when field.FieldType == typeof(MotorSettings) => new MotorSettings(1e6f, .01f),
        _ when field.FieldType == typeof(Quaternion) => Quaternion.Identity,
        "LocalSwivelAxisA" => Vector3.UnitX,
        var name when name.Contains("Axis", StringComparison.Ordinal) || name.Contains("Direction", StringComparison.Ordinal)
            || name.Contains("Normal", StringComparison.Ordinal) => Vector3.UnitZ,
        var name when field.FieldType == typeof(Vector3) => name.StartsWith("Target", StringComparison.Ordinal) ? Vector3.Zero : new Vector3(.3f, .1f, -.2f),
        var name => name.StartsWith("Minimum", StringComparison.Ordinal) ? 0 : .5f,
    };
}

/// <summary>Nanoseconds of a constraint.</summary>
/// <param name="Name">Its type.</param>
/// <param name="Lanes">Floats of a vector.</param>
/// <param name="Solve">A velocity iteration.</param>
/// <param name="Substep">A substep: the iteration, the warm start, and its bodies' integration.</param>
sealed record JointTime(string Name, int Lanes, double Solve, double Substep);
