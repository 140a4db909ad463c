using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Numerics;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>What a constraint does depends on its own numbers alone: not on its lane, not on its neighbours, not on how full the bundle is.</summary>
public unsafe class KernelPurityTests
{
    const int ConstraintCount = 61;

    /// <summary>Every constraint type of the library, contacts included, by id.</summary>
    public static TheoryData<int> Types()
    {
        using var pool = new BufferPool();
        return new(CreateSolver(pool).TypeProcessors.Where(p => p is not null).Select(p => p!.TypeId));
    }

    [Theory]
    [MemberData(nameof(Types))]
    public void Order_and_neighbours_do_not_matter(int typeId)
    {
        var order = Enumerable.Range(0, ConstraintCount).ToArray();
        var expected = Run(typeId, order);
        Assert.Contains(expected.Values, outcome => outcome.Any(value => value != 0 && float.IsFinite(value)));

        var random = new Random(typeId);
        for (int shuffle = 0; shuffle < 3; ++shuffle)
        {
            random.Shuffle(order);
            Compare(expected, Run(typeId, order));
        }
        // Alone in a bundle, beside unused lanes.
        for (int i = 0; i < ConstraintCount; i += 7)
            Compare(expected, Run(typeId, [i]));
    }

    [Theory]
    [MemberData(nameof(Types))]
    public void Zeros_keep_their_signs_beside_others(int typeId)
    {
        // A warm start would have taken the signs from them.
        var expected = Run(typeId, [.. Enumerable.Range(0, ConstraintCount)], isSolveAlone: true);
        for (int i = 0; i < ConstraintCount; i += 5)
            Compare(expected, Run(typeId, [i], isSolveAlone: true));
    }

    static void Compare(Dictionary<int, float[]> expected, Dictionary<int, float[]> actual)
    {
        foreach (var (constraint, outcome) in actual)
        {
            for (int i = 0; i < outcome.Length; ++i)
            {
                var same = BitConverter.SingleToInt32Bits(outcome[i]) == BitConverter.SingleToInt32Bits(expected[constraint][i]) ||
                    (float.IsNaN(outcome[i]) && float.IsNaN(expected[constraint][i]));
                Assert.True(same, $"constraint {constraint}, number {i}: {outcome[i]:R} here, {expected[constraint][i]:R} there");
            }
        }
    }

    // Warm starts and solves constraints that are stored in some order; impulses and velocities of each by its number.
    static Dictionary<int, float[]> Run(int typeId, int[] order, bool isSolveAlone = false)
    {
        using var pool = new BufferPool();
        var processor = CreateSolver(pool).Processor(typeId);
        var bodiesPerConstraint = processor.BodiesPerConstraint;
        pool.Take<MotionState>(ConstraintCount * bodiesPerConstraint, out var motions);
        pool.Take<BodyInertia>(motions.Length, out var inertias);
        pool.Take<BodyInertia>(motions.Length, out var stiffness);
        pool.Take<BodyVelocity>(motions.Length, out var displacements);
        stiffness.Clear(0, stiffness.Length);
        var batch = default(TypeBatch);
        for (int body = 0; body < motions.Length; ++body)
        {
            FillBody(new Random(1000 + body), out motions[body], out inertias[body], out displacements[body]);
            MakeUncommon(body / bodiesPerConstraint, body % bodiesPerConstraint, ref inertias[body]);
        }
        var references = new int[bodiesPerConstraint];
        foreach (var constraint in order)
        {
            for (int slot = 0; slot < references.Length; ++slot)
                references[slot] = constraint * bodiesPerConstraint + slot;
            var index = processor.Allocate(ref batch, new(constraint), references, 16, pool);
            var random = new Random(constraint);
            for (int i = 0; i < processor.PrestepFloats; ++i)
                processor.PrestepFloat(ref batch, index, i) = random.NextSingle() * 2 - 0.7f;
            for (int i = 0; i < processor.ImpulseFloats; ++i)
                processor.Impulse(ref batch, index, i) = random.NextSingle();
            MakeSpring(processor, ref batch, index);
            if (constraint % 3 == 0)
                MakeRigid(processor, ref batch, index);
            if (typeId < ConstraintTypeIds.ContactTwoBody && constraint % 2 == 0)
                MakeAlone(processor, ref batch, index);
            if (constraint % 5 == 0)
                MakeIdle(processor, ref batch, index, motions);
        }

        var bodies = new SolverBodies(motions.Memory, inertias.Memory, displacements.Memory, stiffness.Memory, inertias.Memory);
        Substep[] substeps = [new(0, 1 / 240f, 0.8f), new(1, 1 / 240f), new(1, 1 / 240f, relaxations: 1, isRelaxation: true)];
        foreach (var substep in isSolveAlone ? substeps[1..2] : substeps)
        {
            if (!isSolveAlone)
                processor.WarmStart(ref batch, bodies, substep, 0, batch.BundleCount);
            processor.Solve(ref batch, bodies, substep, 0, batch.BundleCount);
        }

        var isMotor = processor.CarriesPointLoad && JointTypes.All.Single(type => type.Id == typeId).Name.EndsWith("Motor");
        if (!isSolveAlone && order.Length == ConstraintCount && processor.CarriesPointLoad && !isMotor)
        {
            var marked = Enumerable.Range(0, ConstraintCount).Count(i => (processor.BodyReference(ref batch, i, 0) & EncodedBody.TurnFlag) != 0);
            Assert.InRange(marked, 1, ConstraintCount / 2);
        }
        var outcomes = new Dictionary<int, float[]>();
        for (int index = 0; index < batch.ConstraintCount; ++index)
        {
            var constraint = batch.IndexToHandle[index].Value;
            var outcome = new List<float>();
            for (int i = 0; i < processor.ImpulseFloats; ++i)
                outcome.Add(processor.Impulse(ref batch, index, i));
            for (int slot = 0; slot < bodiesPerConstraint; ++slot)
            {
                ref var velocity = ref motions[constraint * bodiesPerConstraint + slot].Velocity;
                outcome.AddRange([velocity.Linear.X, velocity.Linear.Y, velocity.Linear.Z, velocity.Angular.X, velocity.Angular.Y, velocity.Angular.Z]);
                var body = constraint * bodiesPerConstraint + slot;
                // With the heaviest neighbours, in what rows have left over.
                outcome.AddRange(Floats(ref stiffness[body]));
                outcome.AddRange([Floats(ref inertias[body])[7], Floats(ref displacements[body])[7], Floats(ref motions[body])[7]]);
            }
            outcomes.Add(constraint, [.. outcome]);
        }
        processor.Dispose(ref batch, pool);
        pool.Return(ref motions);
        pool.Return(ref inertias);
        pool.Return(ref stiffness);
        pool.Return(ref displacements);
        return outcomes;
    }

    static Span<float> Floats<T>(ref T row) where T : unmanaged => MemoryMarshal.Cast<T, float>(new Span<T>(ref row));

    // No description has a spring of a negative frequency or damping, which would pull at what it pushes: a limit with one would not be idle out of reach.
    static void MakeSpring(TypeProcessor processor, ref TypeBatch batch, int index)
    {
        if (JointTypes.All.SingleOrDefault(type => type.Id == processor.TypeId)?.PlaceOf<SpringSettings>() is not (int spring and >= 0))
            return;
        for (int i = 0; i < 2; ++i)
            processor.PrestepFloat(ref batch, index, spring + i) = MathF.Abs(processor.PrestepFloat(ref batch, index, spring + i));
    }

    // What is rigid is damped where its load turns a body far.
    static void MakeRigid(TypeProcessor processor, ref TypeBatch batch, int index)
    {
        if (JointTypes.All.SingleOrDefault(type => type.Id == processor.TypeId) is not { } joint)
            return;
        if (joint.PlaceOf<SpringSettings>() is var spring and >= 0)
            processor.PrestepFloat(ref batch, index, spring) = 0;
        // Its greatest speed comes first.
        if (joint.PlaceOf<ServoSettings>() is var servo and >= 0)
            processor.PrestepFloat(ref batch, index, servo) = float.MaxValue;
        for (int i = 0; i < processor.ImpulseFloats; ++i)
            processor.Impulse(ref batch, index, i) *= 20;
    }

    // A contact patch on one static, beside such as share their friction with others: its friction has no place of its own.
    static void MakeAlone(TypeProcessor processor, ref TypeBatch batch, int index)
    {
        var place = ContactPrestepLayout.OffsetB(ConstraintTypeIds.ContactCount(processor.TypeId));
        for (int i = 0; i < 3; ++i)
            processor.PrestepFloat(ref batch, index, place + i) = 0;
    }

    // At rest without an impulse: of a limit that is out of reach not even the signs of zeros change.
    static void MakeIdle(TypeProcessor processor, ref TypeBatch batch, int index, Buffer<MotionState> motions)
    {
        for (int i = 0; i < processor.ImpulseFloats; ++i)
            processor.Impulse(ref batch, index, i) = 0;
        var negative = new Vector3(-0f);
        for (int slot = 0; slot < processor.BodiesPerConstraint; ++slot)
            motions[processor.BodyReference(ref batch, index, slot) & Transpose.RowMask].Velocity = new(negative, negative);
    }

    static void FillBody(Random random, out MotionState motion, out BodyInertia inertia, out BodyVelocity displacement)
    {
        motion = default;
        motion.Pose = new(Vector(random, 2), Quaternion.Normalize(new(Vector(random, 1), random.NextSingle() + 0.1f)));
        motion.Velocity = new(Vector(random, 3), Vector(random, 3));
        inertia = default;
        inertia.InverseMass = random.NextSingle() + 0.1f;
        inertia.InverseInertiaTensor.XX = random.NextSingle() + 1;
        inertia.InverseInertiaTensor.YY = random.NextSingle() + 1;
        inertia.InverseInertiaTensor.ZZ = random.NextSingle() + 1;
        inertia.InverseInertiaTensor.YX = random.NextSingle() * 0.3f;
        displacement = new(Vector(random, 0.01f), Vector(random, 0.01f));
    }

    // What some lanes branch for: bodies that are by far easier to turn than what they are joined to, so that welds hold them by their centre and
    // point joints load them, and bodies that nothing but rotations can move.
    static void MakeUncommon(int constraint, int slot, ref BodyInertia inertia)
    {
        var tensor = inertia.InverseInertiaTensor;
        if (constraint % 4 == 1 && slot == 0)
            inertia.InverseInertiaTensor = tensor + tensor * 20;
        else if (constraint % 4 == 3)
            inertia = slot == 0 ? new() { InverseInertiaTensor = tensor } : default;
    }

    [Fact]
    public void A_load_that_stiffens_one_body_leaves_those_beside_it_alone()
    {
        var random = new Random(5);
        for (int trial = 0; trial < 50; ++trial)
        {
            var inertias = new Symmetric3x3Wide();
            var loads = new Symmetric3x3Wide();
            var velocities = new Vector3Wide();
            var onArms = new Vector<float>();
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                FillBody(random, out var motion, out var inertia, out _);
                Lanes.Write(inertia.InverseInertiaTensor, ref inertias, lane);
                Lanes.Write(motion.Velocity.Angular, ref velocities, lane);
                onArms = onArms.WithElement(lane, random.Next(3) * random.NextSingle());
                // Nothing, what a substep resolves, what it does not, and what has no bounds.
                var load = inertia.InverseInertiaTensor * (random.Next(4) switch { 0 => 0, 1 => 10, 2 => 1e7f, _ => 1e30f });
                Lanes.Write(load, ref loads, lane);
            }
            for (int lane = 0; lane < Vector<float>.Count; ++lane)
            {
                var (inertia, velocity) = (inertias, velocities);
                GeometricStiffness.Apply(loads, onArms, new Vector<float>(1 / 240f), ref inertia, ref velocity);
                var aloneInertia = Lanes.Broadcast<Symmetric3x3, Symmetric3x3Wide>(Lanes.Read<Symmetric3x3, Symmetric3x3Wide>(ref inertias, lane));
                var aloneVelocity = Lanes.Broadcast<Vector3, Vector3Wide>(Lanes.Read<Vector3, Vector3Wide>(ref velocities, lane));
                var aloneLoad = Lanes.Broadcast<Symmetric3x3, Symmetric3x3Wide>(Lanes.Read<Symmetric3x3, Symmetric3x3Wide>(ref loads, lane));
                GeometricStiffness.Apply(aloneLoad, new Vector<float>(onArms[lane]), new Vector<float>(1 / 240f), ref aloneInertia, ref aloneVelocity);
                Assert.Equal(Bits(aloneInertia, 0), Bits(inertia, lane));
                Assert.Equal(Bits(aloneVelocity, 0), Bits(velocity, lane));
            }
        }
    }

    static long[] Bits<T>(T wide, int lane) where T : unmanaged => [.. WideSamples.Lane(wide, lane).Select(BitConverter.DoubleToInt64Bits)];

    static Vector3 Vector(Random random, float size) => (new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle()) * 2 - Vector3.One) * size;

    static Solver CreateSolver(BufferPool pool)
    {
        // Only the list of types is wanted of it.
        var solver = new Solver(null!, pool, new SolveDescription(1, 1), 16);
        DefaultTypes.RegisterDefaults(solver);
        return solver;
    }
}
