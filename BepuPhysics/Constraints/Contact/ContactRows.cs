using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>The rows of one contact constraint and the bodies that it connects, one contact at a time: for stages that visit few constraints.</summary>
readonly unsafe ref struct ContactRows
{
    // The first float of the description and of the impulses; what follows lies a vector apart.
    readonly ref float prestep;
    readonly ref float impulses;
    readonly int contactCount;
    readonly ref BodySet set;

    /// <summary>Index of A in the active set.</summary>
    internal readonly int A;
    /// <summary>Index of B; -1 for a static.</summary>
    internal readonly int B;
    /// <summary>Whether nothing moves B.</summary>
    internal readonly bool IsFixedB;
    /// <summary>Unit normal from B to A.</summary>
    internal Vector3 Normal => Read(ContactPrestepLayout.Normal(contactCount));
    /// <summary>Position of B relative to A.</summary>
    internal Vector3 OffsetB => Read(ContactPrestepLayout.OffsetB(contactCount));

    internal ContactRows(Solver solver, Bodies bodies, ConstraintHandle constraint, int contactCount)
        : this(bodies, new ContactPlace(solver, constraint), contactCount)
    { }

    internal ContactRows(Bodies bodies, scoped in ContactPlace place, int contactCount)
    {
        prestep = ref *place.Prestep;
        impulses = ref *place.Impulses;
        this.contactCount = contactCount;
        set = ref bodies.ActiveSet;
        (A, B, IsFixedB) = (place.A, place.B, place.IsFixedB);
    }

    /// <summary>Velocity of A.</summary>
    internal BodyVelocity VelocityA => set.MotionStates[A].Velocity;

    /// <summary>Velocity of B; zero for a static.</summary>
    internal BodyVelocity VelocityB => B >= 0 ? set.MotionStates[B].Velocity : default;

    /// <summary>Position of A.</summary>
    internal Vector3 PositionOfA => set.MotionStates[A].Pose.Position;

    /// <summary>Position of B relative to A as the bodies are; zero for a static, whose place nobody asks.</summary>
    // In the description there may be the place of friction.
    internal Vector3 PositionOfBFromA => B >= 0 ? set.MotionStates[B].Pose.Position - PositionOfA : default;

    /// <summary>Inverse inertia of A in world axes.</summary>
    internal BodyInertia InertiaA => set.WorldInertias[A];

    /// <summary>Inverse inertia of B in world axes; zero where nothing moves it.</summary>
    internal BodyInertia InertiaB => IsFixedB ? default : set.WorldInertias[B];

    /// <summary>Coulomb coefficient of the patch.</summary>
    internal float Friction => MathF.Abs(SignedFriction);

    float SignedFriction => Field(ContactPrestepLayout.Friction(contactCount));

    /// <summary>Whether the place of B is that of friction; see <see cref="ContactMaterialWide.SharesFriction"/>.</summary>
    bool SharesFriction => B >= 0 && float.IsNegative(SignedFriction);

    /// <summary>Greatest speed at which penetration is corrected.</summary>
    internal float MaximumRecoveryVelocity => Field(ContactPrestepLayout.MaximumRecovery(contactCount));

    /// <summary>Sum of the accumulated normal impulses.</summary>
    internal float Load
    {
        get
        {
            float load = 0;
            for (int i = 0; i < contactCount; ++i)
                load += Impulse(i);
            return load;
        }
    }

    /// <summary>Position of a contact relative to the centre of A, world axes.</summary>
    internal Vector3 Arm(int contact) => Read(contact * ContactPrestepLayout.FloatsPerContact);

    /// <summary>The row at an arm about A in a direction.</summary>
    internal ContactRow Row(Vector3 arm, Vector3 direction) => ContactRow.At(arm, direction, OffsetB);

    /// <summary>The row that keeps the surfaces apart at a contact.</summary>
    internal ContactRow NormalRow(int contact) => Row(Arm(contact), Normal);

    /// <summary>How A moved since the beginning of the step, as a twist.</summary>
    internal BodyVelocity MotionOfA => set.Displacements[A];

    /// <summary>How B moved since the beginning of the step, as a twist.</summary>
    internal BodyVelocity MotionOfB => B >= 0 ? set.Displacements[B] : default;

    /// <summary>Distance between the surfaces; negative where they overlap.</summary>
    internal float Gap(int contact, in ContactRow normalRow) =>
        normalRow.Along(MotionOfA, MotionOfB) - Depth(contact);

    /// <summary>Changes the velocity of a body.</summary>
    internal void Push(int body, in BodyVelocity change)
    {
        ref var velocity = ref set.MotionStates[body].Velocity;
        velocity.Linear += change.Linear;
        velocity.Angular += change.Angular;
    }

    /// <summary>Moves a body.</summary>
    internal void Move(int body, Vector3 way) => set.Move(body, way);

    /// <summary>Turns a body.</summary>
    internal void Turn(int body, Vector3 way) => set.Turn(body, way);

    /// <summary>Takes note of how a body was moved and turned.</summary>
    internal void NoteMove(int contact, float apart) => Depth(contact) -= apart;

    /// <summary>Takes note that A was moved against B.</summary>
    internal void NoteMove(Vector3 way)
    {
        var apart = Exact.Dot(way, Normal);
        for (int i = 0; i < contactCount; ++i)
            Depth(i) -= apart;
    }

    /// <summary>Takes the overlap beyond a depth out of the rows.</summary>
    internal void Hide(ref FourFloats hidden, float depth)
    {
        for (int i = 0; i < contactCount; ++i)
        {
            hidden[i] = MathHelper.Max(0, -Gap(i, NormalRow(i)) - depth);
            Depth(i) -= hidden[i];
        }
    }

    /// <summary>Puts back what was taken out.</summary>
    internal void Show(ref FourFloats hidden)
    {
        for (int i = 0; i < contactCount; ++i)
            Depth(i) += hidden[i];
        hidden = default;
    }

    /// <summary>An accumulated impulse: those along the normal, contact by contact, then friction and twist.</summary>
    internal ref float Impulse(int row) => ref Unsafe.Add(ref impulses, row * Vector<float>.Count);

    /// <summary>Angular frequency of the contacts' spring; see <see cref="ContactMaterialWide.IsHeld"/>.</summary>
    internal ref float Spring => ref Field(ContactPrestepLayout.Spring(contactCount));

    /// <summary>Impulse against turning about the normal.</summary>
    internal ref float Twist => ref Impulse(ContactPrestepLayout.FrictionImpulse(contactCount) + 3);

    /// <summary>Whether <see cref="Twist"/> means anything: a contact that is alone has no lever, but where it shares the friction of several.</summary>
    internal bool HasTwist => contactCount > 1 || SharesFriction || (B < 0 && OffsetB != default);

    /// <summary>Whether the load path held the patch in the last step.</summary>
    internal bool IsHeld => float.IsNegative(Spring);

    /// <summary>Depth of a contact at detection; negative where the surfaces were apart.</summary>
    internal ref float Depth(int contact) =>
        ref Field(contact * ContactPrestepLayout.FloatsPerContact + ContactPrestepLayout.Depth);

    ref float Field(int field) => ref Unsafe.Add(ref prestep, field * Vector<float>.Count);

    Vector3 Read(int field) => new(Field(field), Field(field + 1), Field(field + 2));
}
