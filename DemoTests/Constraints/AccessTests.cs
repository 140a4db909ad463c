using System;
using System.Numerics;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Numerics;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>What a constraint does not say that it reads is not gathered, and what it does not say that it writes is not scattered.</summary>
public unsafe class AccessTests
{
    const int Samples = 6;

    /// <summary>Ids of all registered types, contacts included.</summary>
    public static TheoryData<int> Types => [.. RandomDescriptions.TypeIds];

    [Theory, MemberData(nameof(Types))]
    public void Nothing_else_is_read_or_written(int typeId)
    {
        using var pool = new BufferPool();
        var type = RandomDescriptions.CreateSolver(pool).Processor(typeId).GetType();
        typeof(AccessTests).GetMethod(nameof(Check), BindingFlags.NonPublic | BindingFlags.Static)!
            .MakeGenericMethod(type.GetGenericArguments()).Invoke(null, BindingFlags.DoNotWrapExceptions, null, [typeId], null);
    }

    static void Check<TBodies, TPrestep, TImpulses, TConstraint>(int typeId)
        where TBodies : unmanaged, IBodySlots where TPrestep : unmanaged where TImpulses : unmanaged
        where TConstraint : unmanaged, IConstraint<TBodies, TPrestep, TImpulses>
    {
        var samples = new WideSamples(typeId);
        var columns = new JointSamples(typeId);
        Substep[] substeps = [new(0, 1 / 240f, 0.8f), new(1, 1 / 240f), new(1, 1 / 240f, relaxations: 1, isRelaxation: true)];
        for (int i = 0; i < Samples; ++i)
        {
            TBodies bodies = default;
            for (int slot = 0; slot < TBodies.Count; ++slot)
                Fill(samples, ref BodySlots.At(ref bodies, slot));
            TPrestep prestep = default;
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                var column = RandomDescriptions.Column(typeId, columns);
                for (int k = 0; k < column.Length; ++k)
                    Unsafe.Add(ref Unsafe.As<TPrestep, float>(ref prestep), k * Vector<float>.Count + lane) = column[k];
            }
            TImpulses impulses = default;
            foreach (ref var impulse in Floats(ref impulses))
                impulse = i % 3 == 0 ? 0 : samples.Positive(0.1f, 1);
            foreach (var substep in substeps)
            {
                Compare(bodies, prestep, impulses, substep, TConstraint.WarmStartAccess, TConstraint.WarmStart);
                Compare(bodies, prestep, impulses, substep, TConstraint.SolveAccess, TConstraint.Solve);
                if (!TConstraint.CarriesPointLoad)
                    continue;
                TConstraint.TryGetGeometricStiffness(bodies, substep, prestep, impulses, out var a, out var b, out var turns);
                TConstraint.ReadArms(bodies, prestep, impulses, out var armA, out var armB);
                var poisoned = Poison(bodies, TConstraint.WarmStartAccess);
                TConstraint.TryGetGeometricStiffness(poisoned, substep, prestep, impulses, out var otherA, out var otherB, out var otherTurns);
                Assert.True(Bits(ref a).SequenceEqual(Bits(ref otherA)) && Bits(ref b).SequenceEqual(Bits(ref otherB)) && turns == otherTurns);
                TConstraint.ReadArms(poisoned, prestep, impulses, out var otherArmA, out var otherArmB);
                Assert.True(Bits(ref armA).SequenceEqual(Bits(ref otherArmA)) && Bits(ref armB).SequenceEqual(Bits(ref otherArmB)));
            }
        }
    }

    delegate void Act<TBodies, TPrestep, TImpulses>(ref TBodies bodies, in Substep substep, ref TPrestep prestep, ref TImpulses impulses);

    static void Compare<TBodies, TPrestep, TImpulses>(
        TBodies before, TPrestep prestep, TImpulses impulses, Substep substep, BodyAccess access, Act<TBodies, TPrestep, TImpulses> act)
        where TBodies : unmanaged, IBodySlots where TPrestep : unmanaged where TImpulses : unmanaged
    {
        var (bodies, poisoned) = (before, Poison(before, access));
        var (expected, actual) = (impulses, impulses);
        act(ref bodies, substep, ref prestep, ref expected);
        act(ref poisoned, substep, ref prestep, ref actual);
        foreach (var value in Floats(ref expected))
            Assert.True(float.IsFinite(value));
        Assert.True(Bits(ref expected).SequenceEqual(Bits(ref actual)), $"impulses depend on more than {access}");
        for (int slot = 0; slot < TBodies.Count; ++slot)
        {
            var (old, body, other) = (BodySlots.At(ref before, slot), BodySlots.At(ref bodies, slot), BodySlots.At(ref poisoned, slot));
            if ((access & BodyAccess.Linear) == 0)
                Assert.True(Bits(ref body.Linear).SequenceEqual(Bits(ref old.Linear)), "linear velocities are written");
            else
                Assert.True(Bits(ref body.Linear).SequenceEqual(Bits(ref other.Linear)), $"linear velocities depend on more than {access}");
            if ((access & BodyAccess.Angular) == 0)
                Assert.True(Bits(ref body.Angular).SequenceEqual(Bits(ref old.Angular)), "angular velocities are written");
            else
                Assert.True(Bits(ref body.Angular).SequenceEqual(Bits(ref other.Angular)), $"angular velocities depend on more than {access}");
        }
    }

    static void Fill(WideSamples samples, ref SolverBodyWide body)
    {
        body.Linear = samples.Vectors(2);
        body.Angular = samples.Vectors(2);
        body.Position = samples.Vectors(1);
        body.Orientation = samples.Rotations();
        body.Translation = samples.Vectors(0.01f);
        body.Rotation = samples.Vectors(0.01f);
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            // Some that nothing but rotations can move, some that are far easier to turn than others.
            body.InverseMass = body.InverseMass.WithElement(lane, samples.Integer(5) == 0 ? 0 : samples.Positive(0.2f, 2));
            Lanes.Write(samples.Definite(samples.Integer(4) == 0 ? 30 : 1), ref body.InverseInertia, lane);
            body.HubMask = body.HubMask.WithElement(lane, -samples.Integer(2));
            body.CorrectionFlags = body.CorrectionFlags.WithElement(lane, -samples.Integer(2));
        }
    }

    // NaN for all that is not asked for.
    static TBodies Poison<TBodies>(TBodies bodies, BodyAccess access) where TBodies : unmanaged, IBodySlots
    {
        for (int slot = 0; slot < TBodies.Count; ++slot)
        {
            ref var body = ref BodySlots.At(ref bodies, slot);
            PoisonUnless((access & BodyAccess.Linear) != 0, ref body.Linear);
            PoisonUnless((access & BodyAccess.Angular) != 0, ref body.Angular);
            PoisonUnless((access & BodyAccess.Position) != 0, ref body.Position);
            PoisonUnless((access & BodyAccess.Orientation) != 0, ref body.Orientation);
            PoisonUnless((access & BodyAccess.InverseMass) != 0, ref body.InverseMass);
            PoisonUnless((access & BodyAccess.InverseInertia) != 0, ref body.InverseInertia);
            PoisonUnless((access & BodyAccess.Displacement) != 0, ref body.Translation);
            PoisonUnless((access & BodyAccess.Displacement) != 0, ref body.Rotation);
        }
        return bodies;
    }

    static void PoisonUnless<T>(bool isAskedFor, ref T part) where T : unmanaged
    {
        if (!isAskedFor)
            Floats(ref part).Fill(float.NaN);
    }

    static Span<float> Floats<T>(ref T wide) where T : unmanaged => MemoryMarshal.CreateSpan(ref Unsafe.As<T, float>(ref wide), sizeof(T) / sizeof(float));

    static ReadOnlySpan<byte> Bits<T>(ref T wide) where T : unmanaged => MemoryMarshal.AsBytes(Floats(ref wide));
}
