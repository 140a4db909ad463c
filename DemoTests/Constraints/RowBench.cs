using System;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;

namespace DemoTests.Constraints;

/// <summary>One constraint of any registered type with bodies of its own, read and solved through its processor alone.</summary>
sealed unsafe class RowBench : IDisposable
{
    readonly BufferPool pool = new();
    readonly Buffer<MotionState> motions;
    readonly Buffer<BodyInertia> inertias;
    readonly Buffer<BodyInertia> stiffness;
    readonly Buffer<BodyVelocity> displacements;
    TypeBatch batch;
    readonly int index;

    public RowBench(int typeId, float[] column, ReadOnlySpan<SampleBody> samples, int lane = 0, bool hasHub = false)
    {
        Processor = RandomDescriptions.CreateSolver(pool).Processor(typeId);
        pool.Take(BodyCount, out motions);
        pool.Take(BodyCount, out inertias);
        pool.Take(BodyCount, out stiffness);
        pool.Take(BodyCount, out displacements);
        stiffness.Clear(0, stiffness.Length);
        displacements.Clear(0, displacements.Length);
        var references = new int[BodyCount];
        Array.Fill(references, EncodedBody.Empty);
        // Beside others without bodies, which write nothing.
        for (int i = 0; i < lane; ++i)
            Processor.Allocate(ref batch, new(i), references, 1, pool);
        for (int i = 0; i < BodyCount; ++i)
        {
            references[i] = i;
            motions[i] = default;
            motions[i].Pose = new(samples[i].Position, samples[i].Orientation);
            motions[i].Velocity = new(samples[i].Linear, samples[i].Angular);
            inertias[i] = new() { InverseInertiaTensor = samples[i].InverseInertia, InverseMass = samples[i].InverseMass };
        }
        if (hasHub && Processor.MakesHubs)
            references[^1] |= EncodedBody.HubFlag;
        index = Processor.Allocate(ref batch, new(lane), references, 1, pool);
        for (int i = 0; i < column.Length; ++i)
            Processor.PrestepFloat(ref batch, index, i) = column[i];
    }

    /// <summary>A random one.</summary>
    public static RowBench New(int typeId, JointSamples samples, int lane = 0)
    {
        // As many bodies as any type has.
        SampleBody[] bodies = [samples.Body(), samples.Body(), samples.Body(), samples.Body()];
        return new(typeId, RandomDescriptions.Column(typeId, samples), bodies, lane, samples.Coin());
    }

    public TypeProcessor Processor { get; }

    public int BodyCount => Processor.BodiesPerConstraint;

    public int RowCount => Processor.RowCount;

    SolverBodies SolverBodies => new(motions.Memory, inertias.Memory, displacements.Memory, stiffness.Memory, inertias.Memory);

    /// <summary>How far a body has moved since collision detection.</summary>
    public ref BodyVelocity Displacement(int body) => ref displacements[body];

    public ref float Prestep(int field) => ref Processor.PrestepFloat(ref batch, index, field);

    public ConstraintRow[] Rows(in Substep substep)
    {
        var rows = new ConstraintRow[RowCount];
        Processor.ReadRows(ref batch, SolverBodies, substep, index, rows);
        return rows;
    }

    public void WriteImpulses(float[] impulses) => Processor.WriteImpulses(ref batch, index, impulses);

    /// <summary>All impulses of the bundle as they are stored, those of other lanes included.</summary>
    public float[] StoredImpulses => batch.AccumulatedImpulses.AsSpan()[..(Vector<float>.Count * Processor.ImpulseFloats)].ToArray();

    /// <summary>What of it belongs to this constraint.</summary>
    public float[] OwnImpulses => [.. Enumerable.Range(0, Processor.ImpulseFloats).Select(i => Processor.Impulse(ref batch, index, i))];

    public void WarmStart(in Substep substep) => Processor.WarmStart(ref batch, SolverBodies, substep, 0, batch.BundleCount);

    public void Solve(in Substep substep) => Processor.Solve(ref batch, SolverBodies, substep, 0, batch.BundleCount);

    /// <summary>Moves the poses by coordinates of translation and rotation, six per body.</summary>
    public void Move(double[] coordinates)
    {
        for (int i = 0; i < BodyCount; ++i)
        {
            ref var pose = ref motions[i].Pose;
            pose.Position += Part(coordinates, i * 6);
            var rotation = Part(coordinates, i * 6 + 3);
            var angle = rotation.Length();
            if (angle > 0)
                pose.Orientation = Exact.Normalize(Exact.Concatenate(
                    pose.Orientation, new Quaternion(rotation * (MathF.Sin(angle / 2) / angle), MathF.Cos(angle / 2))));
        }
    }

    public RigidPose[] Poses
    {
        get => [.. motions.AsSpan()[..BodyCount].ToArray().Select(motion => motion.Pose)];
        set
        {
            for (int i = 0; i < BodyCount; ++i)
                motions[i].Pose = value[i];
        }
    }

    /// <summary>Adds to what bodies have travelled since collision detection, six coordinates per body.</summary>
    public void Displace(double[] coordinates)
    {
        for (int i = 0; i < BodyCount; ++i)
        {
            displacements[i].Linear += Part(coordinates, i * 6);
            displacements[i].Angular += Part(coordinates, i * 6 + 3);
        }
    }

    /// <summary>Linear and angular velocity of each body.</summary>
    public double[] Velocities
    {
        get => [.. Enumerable.Range(0, BodyCount).SelectMany(i => Coordinates(motions[i].Velocity.Linear, motions[i].Velocity.Angular))];
        set
        {
            for (int i = 0; i < BodyCount; ++i)
                motions[i].Velocity = new(Part(value, i * 6), Part(value, i * 6 + 3));
        }
    }

    public void Dispose() => pool.Dispose();

    /// <summary>Inverse mass times a row or a sum of rows, body by body.</summary>
    public double[] Response(double[] row)
    {
        var result = new double[row.Length];
        for (int i = 0; i < BodyCount; ++i)
        {
            for (int k = 0; k < 3; ++k)
                result[i * 6 + k] = inertias[i].InverseMass * row[i * 6 + k];
            var m = inertias[i].InverseInertiaTensor;
            double x = row[i * 6 + 3], y = row[i * 6 + 4], z = row[i * 6 + 5];
            result[i * 6 + 3] = m.XX * x + m.YX * y + m.ZX * z;
            result[i * 6 + 4] = m.YX * x + m.YY * y + m.ZY * z;
            result[i * 6 + 5] = m.ZX * x + m.ZY * y + m.ZZ * z;
        }
        return result;
    }

    /// <summary>The Jacobian of a row, six numbers per body.</summary>
    public double[] Jacobian(in ConstraintRow row)
    {
        RowJacobian[] parts = [row.A, row.B, row.C, row.D];
        return [.. parts.Take(BodyCount).SelectMany(part => Coordinates(part.Linear, part.Angular))];
    }

    static Vector3 Part(double[] v, int start) => new((float)v[start], (float)v[start + 1], (float)v[start + 2]);

    static double[] Coordinates(Vector3 linear, Vector3 angular) => [linear.X, linear.Y, linear.Z, angular.X, angular.Y, angular.Z];
}
