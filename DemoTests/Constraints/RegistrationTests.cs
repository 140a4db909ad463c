using System;
using System.Collections.Generic;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>Constraint types that contradict themselves or others are refused before they can write where they must not.</summary>
public class RegistrationTests
{
    [InlineArray(130)]
    public struct Vectors130
    {
        public Vector<float> Element;
    }

    [InlineArray(130)]
    public struct Floats130
    {
        public float Element;
    }

    // Does nothing to its body, whatever its description is.
    public readonly struct Idle<TPrestep> : IConstraint<OneBody, TPrestep, Rows1> where TPrestep : unmanaged
    {
        public static BodyAccess WarmStartAccess => BodyAccess.Velocity;
        public static BodyAccess SolveAccess => BodyAccess.Velocity;
        public static void WarmStart(ref OneBody bodies, in Substep substep, ref TPrestep prestep, ref Rows1 impulses) { }
        public static void Solve(ref OneBody bodies, in Substep substep, ref TPrestep prestep, ref Rows1 impulses) { }
    }

    static TypeProcessor<OneBody, TPrestep, Rows1, Idle<TPrestep>> IdleProcessor<TPrestep>() where TPrestep : unmanaged => new();

    public struct TooLarge : IOneBodyConstraintDescription<TooLarge>
    {
        public Floats130 Numbers;
        public static int ConstraintTypeId => 100;
        public static TypeProcessor CreateTypeProcessor() => IdleProcessor<Vectors130>();
    }

    // One float, and the id of a type whose column has more: reading it would write beyond the caller's variable.
    public struct Impostor : IOneBodyConstraintDescription<Impostor>
    {
        public float Number;
        public static int ConstraintTypeId => ConstraintTypeIds.OneBodyLinearServo;
        public static TypeProcessor CreateTypeProcessor() => OneBodyLinearServo.CreateTypeProcessor();
    }

    public struct ContactImpostor : IOneBodyConstraintDescription<ContactImpostor>
    {
        public float Number;
        public static int ConstraintTypeId => 0;
        public static TypeProcessor CreateTypeProcessor() => IdleProcessor<Vector<float>>();
    }

    public struct Misshapen : IOneBodyConstraintDescription<Misshapen>
    {
        public float First, Second;
        public static int ConstraintTypeId => 101;
        public static TypeProcessor CreateTypeProcessor() => IdleProcessor<Vector<float>>();
    }

    public struct Miscounted : ITwoBodyConstraintDescription<Miscounted>
    {
        public float Number;
        public static int ConstraintTypeId => 102;
        public static TypeProcessor CreateTypeProcessor() => IdleProcessor<Vector<float>>();
    }

    public struct Unmade : IOneBodyConstraintDescription<Unmade>
    {
        public float Number;
        public static int ConstraintTypeId => 103;
        public static TypeProcessor CreateTypeProcessor() => null!;
    }

    public struct OutOfRange : IOneBodyConstraintDescription<OutOfRange>
    {
        public float Number;
        public static int ConstraintTypeId => 128;
        public static TypeProcessor CreateTypeProcessor() => IdleProcessor<Vector<float>>();
    }

    [Fact]
    public void Types_that_contradict_themselves_or_others_are_refused()
    {
        using var world = new TestWorld();
        var a = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        var b = world.AddDynamic(new Sphere(1), 1, new RigidPose(new Vector3(5, 0, 0)));
        var before = new List<TypeProcessor?>(world.Solver.TypeProcessors);
        Refuses("128", () => world.Solver.Add(a, default(TooLarge)));
        Refuses(nameof(OneBodyLinearServo), () => world.Solver.Add(a, default(Impostor)));
        Refuses("contacts", () => world.Solver.Add(a, default(ContactImpostor)));
        Refuses("8 bytes", () => world.Solver.Add(a, default(Misshapen)));
        Refuses("2 bodies", () => world.Solver.Add(a, b, default(Miscounted)));
        Refuses("no processor", () => world.Solver.Add(a, default(Unmade)));
        Refuses("127", () => world.Solver.Add(a, default(OutOfRange)));
        Assert.Equal(before, world.Solver.TypeProcessors);
        Assert.Equal(0, world.Solver.CountConstraints());
        world.Simulation.Validate();
        world.Step();
    }

    [Fact]
    public void Another_types_description_is_neither_read_nor_written()
    {
        using var world = new TestWorld();
        var body = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        var handle = world.Solver.Add(body, new OneBodyLinearServo
        {
            Target = new Vector3(1, 2, 3),
            ServoSettings = new ServoSettings(2, 0, 50),
            SpringSettings = new SpringSettings(5, 1),
        });
        Refuses(nameof(Impostor), () => world.Solver.GetDescription<Impostor>(handle, out _));
        Refuses(nameof(Impostor), () => world.Solver.ApplyDescription(handle, default(Impostor)));
        world.Solver.GetDescription<OneBodyLinearServo>(handle, out var servo);
        Assert.Equal(new Vector3(1, 2, 3), servo.Target);
    }

    [Fact]
    public void Adding_and_removing_a_joint_takes_no_managed_memory()
    {
        using var world = new TestWorld();
        var a = world.AddDynamic(new Sphere(1), 1, RigidPose.Identity);
        var b = world.AddDynamic(new Sphere(1), 1, new RigidPose(new Vector3(5, 0, 0)));
        for (int i = 0; i < 3; ++i)
            AddAndRemove();
        long before = GC.GetAllocatedBytesForCurrentThread();
        for (int i = 0; i < 100; ++i)
            AddAndRemove();
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);

        void AddAndRemove()
        {
            var ball = world.Solver.Add(a, b, new BallSocket { LocalOffsetA = Vector3.UnitX });
            var servo = world.Solver.Add(a, new OneBodyLinearServo { ServoSettings = new ServoSettings(2, 0, 50), SpringSettings = new SpringSettings(5, 1) });
            world.Solver.ApplyDescription(ball, new BallSocket { LocalOffsetA = Vector3.UnitY });
            world.Solver.Remove(ball);
            world.Solver.Remove(servo);
        }
    }

    static void Refuses(string word, Action call) => Assert.Contains(word, Assert.ThrowsAny<ArgumentException>(call).Message);
}
