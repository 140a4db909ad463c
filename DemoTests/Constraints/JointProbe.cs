using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace DemoTests.Constraints;

/// <summary>Runs the parts of one type of joint for a sample in one lane, beside other samples in the other lanes.</summary>
sealed class JointProbe<TDescription, TWide, TBodies, TGeometry, TRows, TMass, TJoint>
    where TDescription : unmanaged where TWide : unmanaged, IWide<TDescription>
    where TBodies : unmanaged, IBodySlots where TGeometry : unmanaged
    where TRows : unmanaged, IRows<TRows> where TMass : unmanaged, IRowMatrix<TMass, TRows>
    where TJoint : unmanaged, IJoint<TBodies, TWide, TGeometry, TRows, TMass>
{
    public static readonly int RowCount = Unsafe.SizeOf<TRows>() / Unsafe.SizeOf<Vector<float>>();
    public static readonly int Coordinates = TBodies.Count * 6;

    TBodies bodies;
    TWide prestep;
    TRows impulses;

    public void Set(int lane, TDescription description, ReadOnlySpan<SampleBody> samples)
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

    public void SetImpulse(int lane, ReadOnlySpan<double> values)
    {
        for (int i = 0; i < RowCount; ++i)
            Row(ref impulses, i) = Row(ref impulses, i).WithElement(lane, (float)values[i]);
    }

    /// <summary>Copies a lane with everything in it.</summary>
    public void CopyLane(int lane, JointProbe<TDescription, TWide, TBodies, TGeometry, TRows, TMass, TJoint> target, int targetLane)
    {
        Lanes.Copy(ref bodies, lane, ref target.bodies, targetLane);
        Lanes.Copy(ref prestep, lane, ref target.prestep, targetLane);
        Lanes.Copy(ref impulses, lane, ref target.impulses, targetLane);
    }

    /// <summary>Bits of all that a sweep can change in a lane.</summary>
    public int[] LaneBits(int lane)
    {
        var bits = new int[RowCount + Coordinates];
        for (int i = 0; i < RowCount; ++i)
            bits[i] = BitConverter.SingleToInt32Bits(Row(ref impulses, i)[lane]);
        var velocity = Velocity(lane);
        for (int i = 0; i < Coordinates; ++i)
            bits[RowCount + i] = BitConverter.SingleToInt32Bits((float)velocity[i]);
        return bits;
    }

    public double[] Impulse(int lane) => Read(ref impulses, RowCount, lane);

    /// <summary>Linear and angular velocity of each body.</summary>
    public double[] Velocity(int lane)
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

    public double[] PositionError(int lane)
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.PositionError(bodies, prestep, geometry, out var error);
        return Read(ref error, RowCount, lane);
    }

    public double[] RelativeVelocity(int lane)
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.RelativeVelocity(geometry, bodies, out var velocity);
        return Read(ref velocity, RowCount, lane);
    }

    public double[] Geometry(int lane)
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        return Read(ref geometry, Unsafe.SizeOf<TGeometry>() / Unsafe.SizeOf<Vector<float>>(), lane);
    }

    public void ApplyImpulse()
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.ApplyImpulse(geometry, ref bodies, impulses);
    }

    /// <summary>Inverse effective mass as a dense matrix.</summary>
    public double[,] InverseEffectiveMass(int lane)
    {
        TJoint.Prepare(bodies, prestep, out var geometry);
        TJoint.InverseEffectiveMass(geometry, bodies, out var mass);
        return RowMatrices.Dense(mass, lane);
    }

    public void WarmStart(in Substep substep) =>
        JointConstraint<TBodies, TWide, TGeometry, TRows, TMass, TJoint>.WarmStart(ref bodies, substep, ref prestep, ref impulses);

    public void Solve(in Substep substep) =>
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
