using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>The normal rows of one contact constraint, one contact at a time: for stages that visit few constraints.</summary>
unsafe readonly ref struct ContactRows
{
    readonly ref TypeBatch batch;
    readonly TypeProcessor processor;
    readonly int index;
    readonly int contactCount;
    readonly ref BodySet set;
    readonly int a;
    readonly int b;
    readonly bool kinematicB;
    readonly Vector3 normal;
    readonly Vector3 offsetB;

    internal ContactRows(Solver solver, Bodies bodies, ConstraintHandle constraint, int contactCount)
    {
        ref var location = ref solver.HandleToConstraint[constraint.Value];
        batch = ref solver.TypeBatchAt(location);
        processor = solver.Processor(location.TypeId);
        index = location.IndexInTypeBatch;
        this.contactCount = contactCount;
        set = ref bodies.ActiveSet;
        a = processor.BodyReference(ref batch, index, 0) & EncodedBody.IndexMask;
        b = -1;
        if (processor.BodiesPerConstraint > 1)
        {
            var reference = processor.BodyReference(ref batch, index, 1);
            b = reference & EncodedBody.IndexMask;
            kinematicB = (reference & EncodedBody.KinematicFlag) != 0;
        }
        normal = Read(ContactPrestepLayout.Normal(contactCount));
        offsetB = Read(ContactPrestepLayout.OffsetB(contactCount));
    }

    /// <summary>Accumulated normal impulse of a contact.</summary>
    internal float NormalImpulse(int contact) => processor.Impulse(ref batch, index, contact);

    /// <summary>Speed at which the surfaces part; negative while they approach.</summary>
    internal float NormalVelocity(int contact) =>
        Along(contact, set.MotionStates[a].Velocity, b >= 0 ? set.MotionStates[b].Velocity : default);

    /// <summary>Distance between the surfaces; negative where they overlap.</summary>
    internal float Gap(int contact) =>
        Along(contact, set.Displacements[a], b >= 0 ? set.Displacements[b] : default) -
        processor.PrestepFloat(ref batch, index, contact * ContactPrestepLayout.FloatsPerContact + ContactPrestepLayout.Depth);

    /// <summary>Changes the normal velocity of a contact to a target, by an impulse whose sum over all calls is not negative.</summary>
    internal void Push(int contact, float targetVelocity, ref float impulse)
    {
        var arm = Arm(contact);
        var angularA = Exact.Cross(arm, normal);
        ref var inertiaA = ref set.WorldInertias[a];
        var inverseMass = inertiaA.InverseMass + Exact.Dot(inertiaA.InverseInertiaTensor * angularA, angularA);
        var angularB = Exact.Cross(normal, arm - offsetB);
        if (b >= 0)
        {
            ref var inertiaB = ref set.WorldInertias[b];
            inverseMass += inertiaB.InverseMass + Exact.Dot(inertiaB.InverseInertiaTensor * angularB, angularB);
        }
        var total = MathHelper.Max(0, impulse + (targetVelocity - NormalVelocity(contact)) / inverseMass);
        var change = total - impulse;
        impulse = total;
        ref var velocityA = ref set.MotionStates[a].Velocity;
        velocityA.Linear += normal * (change * inertiaA.InverseMass);
        velocityA.Angular += inertiaA.InverseInertiaTensor * (angularA * change);
        if (b < 0 || kinematicB)
            return;
        ref var other = ref set.WorldInertias[b];
        ref var velocityB = ref set.MotionStates[b].Velocity;
        velocityB.Linear -= normal * (change * other.InverseMass);
        velocityB.Angular += other.InverseInertiaTensor * (angularB * change);
    }

    /// <summary>Whether the contact is with a static.</summary>
    internal bool HasOneBody => b < 0;

    /// <summary>Kinetic energy of A, J; of its rotation only where it can turn about every axis.</summary>
    internal float KineticEnergyOfA() => EnergyProduct(set.MotionStates[a].Velocity, set.MotionStates[a].Velocity) * 0.5f;

    /// <summary>Takes back as much of the impulses that were just applied as leaves A with no more than a kinetic energy.</summary>
    // With the part x of the change of velocity d taken back, the energy is E(v) - x <v, d> + x^2 <d, d> / 2: the smaller root.
    internal void LimitEnergyOfA(float maximum, in FourFloats normalImpulses)
    {
        ref var inertia = ref set.WorldInertias[a];
        BodyVelocity change = default;
        for (int i = 0; i < contactCount; ++i)
        {
            change.Linear += normal * (normalImpulses[i] * inertia.InverseMass);
            change.Angular += inertia.InverseInertiaTensor * (Exact.Cross(Arm(i), normal) * normalImpulses[i]);
        }
        ref var velocity = ref set.MotionStates[a].Velocity;
        var excess = EnergyProduct(velocity, velocity) * 0.5f - maximum;
        var along = EnergyProduct(velocity, change);
        var square = EnergyProduct(change, change);
        if (!(excess > 0) || !(along > 0) || !(square > 0))
            return;
        var part = MathHelper.Min(1, (along - MathF.Sqrt(MathHelper.Max(0, along * along - 2 * square * excess))) / square);
        velocity.Linear -= change.Linear * part;
        velocity.Angular -= change.Angular * part;
    }

    // The product of two velocities with the mass of A between them: twice the kinetic energy, for one and the same.
    float EnergyProduct(in BodyVelocity x, in BodyVelocity y)
    {
        ref var inertia = ref set.WorldInertias[a];
        var linear = inertia.InverseMass > 0 ? Exact.Dot(x.Linear, y.Linear) / inertia.InverseMass : 0;
        return linear + Exact.Dot(x.Angular, Symmetric3x3.Invert(inertia.InverseInertiaTensor) * y.Angular);
    }

    float Along(int contact, in BodyVelocity motionA, in BodyVelocity motionB)
    {
        var arm = Arm(contact);
        var along = Exact.Dot(motionA.Linear, normal) + Exact.Dot(motionA.Angular, Exact.Cross(arm, normal));
        if (b >= 0)
            along += Exact.Dot(motionB.Angular, Exact.Cross(normal, arm - offsetB)) - Exact.Dot(motionB.Linear, normal);
        return along;
    }

    Vector3 Arm(int contact) => Read(contact * ContactPrestepLayout.FloatsPerContact);

    Vector3 Read(int field) => new(
        processor.PrestepFloat(ref batch, index, field), processor.PrestepFloat(ref batch, index, field + 1),
        processor.PrestepFloat(ref batch, index, field + 2));
}
