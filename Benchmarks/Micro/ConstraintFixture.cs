using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
using BepuUtilities.Memory;

namespace Benchmarks.Micro;

/// <summary>Constraints of one type between bodies of their own, few enough to stay in the first-level cache.</summary>
public sealed unsafe class ConstraintFixture : IDisposable
{
    /// <summary>Bundles of constraints: with four contacts and two bodies, 26 KB at 8 lanes.</summary>
    public const int Bundles = 8;

    readonly BufferPool pool = new();
    readonly TypeProcessor processor;
    TypeBatch batch;
    Buffer<MotionState> motions;
    Buffer<BodyInertia> inertias;
    Buffer<BodyInertia> stiffness;
    Buffer<BodyVelocity> displacements;
    readonly Substep substep = new(1, 1 / 240f, 1, 1);

    /// <summary>Names of the constraint types, in the order of their ids.</summary>
    public static IEnumerable<string> Names
    {
        get
        {
            for (int bodies = 1; bodies <= 2; ++bodies)
            {
                for (int contacts = 1; contacts <= 4; ++contacts)
                    yield return $"Contact{contacts}{(bodies == 1 ? "OneBody" : "")}";
            }
            yield return nameof(BallSocket);
            yield return nameof(SwingLimit);
            yield return nameof(TwistLimit);
            yield return nameof(Weld);
            yield return nameof(DistanceLimit);
            yield return nameof(OneBodyLinearServo);
            yield return nameof(Hinge);
        }
    }

    /// <summary>Creates constraints of a type by its name.</summary>
    public ConstraintFixture(string name)
    {
        processor = Create(name);
        var count = Bundles * Vector<float>.Count;
        var random = new Random(1);
        float Next() => random.NextSingle() * 2 - 1;
        var bodyCount = count * processor.BodiesPerConstraint;
        pool.Take(bodyCount, out motions);
        pool.Take(bodyCount, out inertias);
        pool.Take(bodyCount, out stiffness);
        pool.Take(bodyCount, out displacements);
        stiffness.Clear(0, bodyCount);
        displacements.Clear(0, bodyCount);
        for (int i = 0; i < bodyCount; ++i)
        {
            motions[i] = new()
            {
                Pose = new(new(Next(), Next(), Next()), Exact.Normalize(new Quaternion(Next(), Next(), Next(), 2))),
                Velocity = new(new(Next(), Next(), Next()), new(Next(), Next(), Next())),
            };
            inertias[i] = new() { InverseMass = 1, InverseInertiaTensor = new() { XX = 2, YY = 3, ZZ = 4 } };
        }
        Span<int> references = stackalloc int[processor.BodiesPerConstraint];
        Span<float> column = stackalloc float[processor.PrestepFloats + processor.ImpulseFloats];
        for (int i = 0; i < count; ++i)
        {
            for (int slot = 0; slot < references.Length; ++slot)
                references[slot] = i * references.Length + slot;
            processor.Allocate(ref batch, new(i), references, count, pool);
            // No kernel takes another path for axes that are not unit vectors; only the normal of contacts has to be one, or they
            // would gain energy.
            for (int k = 0; k < processor.PrestepFloats; ++k)
                column[k] = 0.1f + 0.4f * random.NextSingle();
            column[processor.PrestepFloats..].Clear();
            if (processor.TypeId < ConstraintTypeIds.ContactTypeCount)
                Vector3.UnitY.CopyTo(column[ContactPrestepLayout.Normal(processor.TypeId % 4 + 1)..]);
            processor.WriteColumn(ref batch, i, column);
        }
    }

    static TypeProcessor Create(string name)
    {
        using var pool = new BufferPool();
        var solver = new Solver(null!, pool, new SolveDescription(1, 1), 16);
        DefaultTypes.RegisterDefaults(solver);
        pool.Clear();
        return solver.TypeProcessors[name switch
        {
            nameof(BallSocket) => BallSocket.ConstraintTypeId,
            nameof(SwingLimit) => SwingLimit.ConstraintTypeId,
            nameof(TwistLimit) => TwistLimit.ConstraintTypeId,
            nameof(Weld) => Weld.ConstraintTypeId,
            nameof(DistanceLimit) => DistanceLimit.ConstraintTypeId,
            nameof(OneBodyLinearServo) => OneBodyLinearServo.ConstraintTypeId,
            nameof(Hinge) => Hinge.ConstraintTypeId,
            _ => ConstraintTypeIds.ConvexContact(name["Contact".Length] - '0', name.EndsWith("OneBody", StringComparison.Ordinal) ? 1 : 2),
        }]!;
    }

    /// <summary>Lanes that one call goes through.</summary>
    public static int Lanes => Bundles * Vector<float>.Count;

    /// <summary>Warm starts all constraints.</summary>
    public void WarmStart() => processor.WarmStart(ref batch, NewBodies(), substep, 0, Bundles);

    /// <summary>Solves all constraints once.</summary>
    public void Solve() => processor.Solve(ref batch, NewBodies(), substep, 0, Bundles);

    SolverBodies NewBodies() => new(motions.Memory, inertias.Memory, displacements.Memory, stiffness.Memory, inertias.Memory);

    /// <inheritdoc/>
    public void Dispose()
    {
        processor.Dispose(ref batch, pool);
        pool.Return(ref motions);
        pool.Return(ref inertias);
        pool.Return(ref stiffness);
        pool.Return(ref displacements);
        pool.Dispose();
    }
}
