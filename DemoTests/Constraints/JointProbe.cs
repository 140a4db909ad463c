using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints;
using BepuUtilities;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>Runs the parts of one type of joint for a sample in one lane, beside other samples in the other lanes.</summary>
/// <remarks>Written against the description alone: the types of the rows are found in the processor that it creates.</remarks>
abstract class JointProbe<TDescription> where TDescription : unmanaged
{
    public abstract RowKind Kind { get; }
    public abstract int BodyCount { get; }
    public abstract int RowCount { get; }
    public abstract void Set(int lane, TDescription description, ReadOnlySpan<SampleBody> samples);
    public abstract void SetImpulse(int lane, ReadOnlySpan<double> values);
    /// <summary>Copies a lane with everything in it.</summary>
    public abstract void CopyLane(int lane, JointProbe<TDescription> target, int targetLane);
    /// <summary>Bits of all that a sweep can change in a lane.</summary>
    public abstract int[] LaneBits(int lane);
    public abstract double[] Impulse(int lane);
    /// <summary>Linear and angular velocity of each body.</summary>
    public abstract double[] Velocity(int lane);
    public abstract double[] PositionError(int lane);
    public abstract double[] TargetVelocity(int lane);
    public abstract double[] RelativeVelocity(int lane);
    public abstract double[] Geometry(int lane);
    public abstract void ApplyImpulse();
    /// <summary>Inverse effective mass as a dense matrix.</summary>
    public abstract double[,] InverseEffectiveMass(int lane);
    public abstract void WarmStart(in Substep substep);
    public abstract void Solve(in Substep substep);
}

/// <summary>Makes probes of joint types.</summary>
static class JointProbes
{
    public static JointProbe<TDescription> New<TDescription>() where TDescription : unmanaged, IConstraintDescription<TDescription> =>
        (JointProbe<TDescription>)Activator.CreateInstance(TypeOf<TDescription>())!;

    /// <summary>Asserts that a lane has the same bits whichever lane it is and whatever its neighbours are, after a warm start and a sweep.</summary>
    /// <param name="samples">What samples are taken from.</param>
    /// <param name="substep">The substep of both.</param>
    /// <param name="fill">Puts a sample into a lane.</param>
    public static void AssertLanesAreAlone<TDescription>(JointSamples samples, in Substep substep, Action<JointProbe<TDescription>, int, JointSamples> fill)
        where TDescription : unmanaged, IConstraintDescription<TDescription>
    {
        var lanes = Vector<float>.Count;
        for (int trial = 0; trial < 20; ++trial)
        {
            JointProbe<TDescription> first = New<TDescription>(), second = New<TDescription>();
            for (int lane = 0; lane < lanes; ++lane)
                fill(first, lane, samples);
            // Half of the lanes get other company, all change places.
            var shift = 1 + trial % (lanes - 1);
            for (int lane = 0; lane < lanes; ++lane)
            {
                if (lane % 2 == 0)
                    first.CopyLane(lane, second, (lane + shift) % lanes);
                else
                    fill(second, (lane + shift) % lanes, samples);
            }
            foreach (var probe in new[] { first, second })
            {
                probe.WarmStart(substep);
                probe.Solve(substep);
            }
            for (int lane = 0; lane < lanes; lane += 2)
                Assert.Equal(first.LaneBits(lane), second.LaneBits((lane + shift) % lanes));
        }
    }

    // TypeProcessor<TBodies, TWide, TRows, JointConstraint<TBodies, TWide, TGeometry, TRows, TMass, TJoint>>
    static Type TypeOf<TDescription>() where TDescription : unmanaged, IConstraintDescription<TDescription>
    {
        var constraint = TDescription.CreateTypeProcessor().GetType().GetGenericArguments()[3];
        var parts = constraint.GetGenericArguments();
        return typeof(JointProbe<,,,,,,>).MakeGenericType(typeof(TDescription), parts[1], parts[0], parts[2], parts[3], parts[4], parts[5]);
    }
}

/// <summary>The same for the types that the rows consist of.</summary>
sealed class JointProbe<TDescription, TWide, TBodies, TGeometry, TRows, TMass, TJoint> : JointProbe<TDescription>
    where TDescription : unmanaged where TWide : unmanaged, IWide<TDescription>
    where TBodies : unmanaged, IBodySlots where TGeometry : unmanaged
    where TRows : unmanaged, IRows<TRows> where TMass : unmanaged, IRowMatrix<TMass, TRows>
    where TJoint : unmanaged, IJoint<TBodies, TWide, TGeometry, TRows, TMass>
{
    static readonly int Coordinates = TBodies.Count * 6;

    public override RowKind Kind => TJoint.Kind;
    public override int BodyCount => TBodies.Count;
    public override int RowCount => Unsafe.SizeOf<TRows>() / Unsafe.SizeOf<Vector<float>>();

    TBodies bodies;
    TWide prestep;
    TRows impulses;

    public override void Set(int lane, TDescription description, ReadOnlySpan<SampleBody> samples)
    {
        Lanes.Write(description, ref prestep, lane);
        for (int i = 0; i < TBodies.Count; ++i)
        {
            ref var body = ref BodySlots.At(ref bodies, i);
            ref readonly var sample = ref samples[i];
            Lanes.Write(sample.Position, ref body.Position, lane);
            Lanes.Write(sample.Orientation, ref body.Orientation, lane);
            Lanes.Write(sample.Linear, ref body.Linear, lane);
            Lanes.Write(sample.Angular, ref body.Angular, lane);
            Lanes.Write(sample.InverseInertia, ref body.InverseInertia, lane);
            body.InverseMass = body.InverseMass.WithElement(lane, sample.InverseMass);
        }
    }

    public override void SetImpulse(int lane, ReadOnlySpan<double> values)
    {
        for (int i = 0; i < RowCount; ++i)
            Row(ref impulses, i) = Row(ref impulses, i).WithElement(lane, (float)values[i]);
    }

    public override void CopyLane(int lane, JointProbe<TDescription> target, int targetLane)
    {
        var other = (JointProbe<TDescription, TWide, TBodies, TGeometry, TRows, TMass, TJoint>)target;
        Lanes.Copy(ref bodies, lane, ref other.bodies, targetLane);
        Lanes.Copy(ref prestep, lane, ref other.prestep, targetLane);
        Lanes.Copy(ref impulses, lane, ref other.impulses, targetLane);
    }

    public override int[] LaneBits(int lane)
    {
        var bits = new int[RowCount + Coordinates];
        for (int i = 0; i < RowCount; ++i)
            bits[i] = BitConverter.SingleToInt32Bits(Row(ref impulses, i)[lane]);
        var velocity = Velocity(lane);
        for (int i = 0; i < Coordinates; ++i)
            bits[RowCount + i] = BitConverter.SingleToInt32Bits((float)velocity[i]);
        return bits;
    }

    public override double[] Impulse(int lane) => Read(ref impulses, RowCount, lane);

    public override double[] Velocity(int lane)
    {
        var result = new double[Coordinates];
        for (int i = 0; i < TBodies.Count; ++i)
        {
            ref var body = ref BodySlots.At(ref bodies, i);
            Read(ref body.Linear, 3, lane).CopyTo(result, i * 6);
            Read(ref body.Angular, 3, lane).CopyTo(result, i * 6 + 3);
        }
        return result;
    }

    public override double[] PositionError(int lane)
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.PositionError(bodies, prestep, geometry, out var error);
        return Read(ref error, RowCount, lane);
    }

    public override double[] TargetVelocity(int lane)
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.TargetVelocity(bodies, prestep, geometry, out var velocity);
        return Read(ref velocity, RowCount, lane);
    }

    public override double[] RelativeVelocity(int lane)
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.LeanRows(bodies, prestep, ref geometry);
        TJoint.RelativeVelocity(geometry, bodies, out var velocity);
        return Read(ref velocity, RowCount, lane);
    }

    public override double[] Geometry(int lane)
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        return Read(ref geometry, Unsafe.SizeOf<TGeometry>() / Unsafe.SizeOf<Vector<float>>(), lane);
    }

    public override void ApplyImpulse()
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.LeanRows(bodies, prestep, ref geometry);
        TJoint.ApplyImpulse(geometry, ref bodies, impulses);
    }

    public override double[,] InverseEffectiveMass(int lane)
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.LeanRows(bodies, prestep, ref geometry);
        TJoint.InverseEffectiveMass(geometry, bodies, out var mass);
        return RowMatrices.Dense(mass, lane);
    }

    public override void WarmStart(in Substep substep) =>
        JointConstraint<TBodies, TWide, TGeometry, TRows, TMass, TJoint>.WarmStart(ref bodies, substep, ref prestep, ref impulses);

    public override void Solve(in Substep substep) =>
        JointConstraint<TBodies, TWide, TGeometry, TRows, TMass, TJoint>.Solve(ref bodies, substep, ref prestep, ref impulses);

    static ref Vector<float> Row<T>(ref T rows, int index) where T : unmanaged => ref Unsafe.Add(ref Unsafe.As<T, Vector<float>>(ref rows), index);

    static double[] Read<T>(ref T rows, int count, int lane) where T : unmanaged
    {
        var result = new double[count];
        for (int i = 0; i < count; ++i)
            result[i] = Row(ref rows, i)[lane];
        return result;
    }
}
