using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>A body, for reading and changing it. Cheap to make; its refs are valid until bodies are added or removed.</summary>
/// <remarks>
/// Writing through the refs neither checks values nor moves bounds nor wakes the body: set <see cref="Awake"/>. <see cref="UpdateBounds"/> moves
/// bounds, and so does each step those of bodies that are awake. Impulses, and everything that changes what a body is, wake it. A step
/// stops bodies whose pose or velocity cannot be simulated, and lists them in the simulation's quarantine. Everything but
/// <see cref="Exists"/> throws an <see cref="ArgumentException"/> once the body was removed, and an
/// <see cref="InvalidOperationException"/> for the default value.
/// </remarks>
public struct BodyReference(BodyHandle handle, Bodies bodies)
{
    /// <summary>Handle of the body.</summary>
    public BodyHandle Handle = handle;
    /// <summary>The bodies among which it is.</summary>
    public Bodies Bodies = bodies;

    /// <summary>Whether there still is such a body.</summary>
    public readonly bool Exists => Bodies is not null && Bodies.BodyExists(Handle);
    /// <summary>Where the body is stored.</summary>
    public readonly ref BodyMemoryLocation MemoryLocation => ref Owner.GetLocation(Handle);
    /// <summary>Whether the body is simulated. Setting it wakes the body with its island, or stops both and puts them to sleep.</summary>
    /// <remarks>Set to true on a body that is awake, it begins anew to count its rest.</remarks>
    /// <exception cref="InvalidOperationException">A body of the island that is to sleep has a pose, a velocity or an inertia that is no
    /// number; nothing was changed.</exception>
    public readonly bool Awake
    {
        get => MemoryLocation.SetIndex == 0;
        set => Owner.SetAwake(Handle, value);
    }
    /// <summary>Pose and velocity.</summary>
    public readonly ref MotionState MotionState => ref Find(out var index).MotionStates[index];
    /// <summary>Where the body is. Writing it moves the body without a velocity: contacts take a kinematic that is moved so for one at rest.</summary>
    public readonly ref RigidPose Pose => ref MotionState.Pose;
    /// <summary>How the body moves.</summary>
    public readonly ref BodyVelocity Velocity => ref MotionState.Velocity;
    /// <summary>Inverse mass and inertia in the body's frame. To make the body kinematic or dynamic, use <see cref="SetLocalInertia"/>.</summary>
    public readonly ref BodyInertia LocalInertia => ref Find(out var index).LocalInertias[index];
    /// <summary>Motion and inertia in one view.</summary>
    public readonly BodyDynamicsReference Dynamics
    {
        get
        {
            ref var set = ref Find(out var index);
            return new(ref set.MotionStates[index], ref set.LocalInertias[index], ref set.WorldInertias[index]);
        }
    }
    /// <summary>Shape and collision state.</summary>
    public readonly ref Collidable Collidable => ref Find(out var index).Collidables[index];
    /// <summary>When the body may sleep, and its progress towards it.</summary>
    public readonly ref BodyActivity Activity => ref Find(out var index).Activity[index];
    /// <summary>Constraints of the body.</summary>
    public readonly BodyConstraints Constraints => Owner.GetConstraints(Handle);
    /// <summary>The body as the collision detection names it.</summary>
    public readonly CollidableReference CollidableReference => new(Kinematic ? CollidableMobility.Kinematic : CollidableMobility.Dynamic, Handle);
    /// <summary>Whether nothing moves the body.</summary>
    public readonly bool Kinematic => Bodies.IsKinematic(LocalInertia);
    /// <summary>Whether nothing turns the body.</summary>
    public readonly bool HasLockedInertia => Bodies.HasLockedInertia(LocalInertia.InverseInertiaTensor);
    /// <summary>Bounds of the body in the broad phase; those of the last step include its motion.</summary>
    public readonly unsafe BoundingBox BoundingBox
    {
        get
        {
            GetBoundsReferencesFromBroadPhase(out var min, out var max);
            return new(*min, *max);
        }
    }

    readonly Bodies Owner => Bodies ?? throw new InvalidOperationException("The default body reference refers to no body.");

    readonly ref BodySet Find(out int index)
    {
        ref var location = ref MemoryLocation;
        index = location.Index;
        return ref Bodies.Sets[location.SetIndex];
    }

    /// <summary>Makes the body kinematic: it keeps its velocity and nothing pushes it.</summary>
    public readonly void BecomeKinematic() => SetLocalInertia(default);
    /// <summary>Gives the body another inertia.</summary>
    public readonly void SetLocalInertia(in BodyInertia localInertia) => Owner.SetLocalInertia(Handle, localInertia);
    /// <summary>Gives the body another shape.</summary>
    public readonly void SetShape(TypedIndex newShape) => Owner.SetShape(Handle, newShape);
    /// <summary>Describes the body as it is now.</summary>
    public readonly void GetDescription(out BodyDescription description) => Owner.GetDescription(Handle, out description);
    /// <summary>Makes the body what a description says.</summary>
    public readonly void ApplyDescription(in BodyDescription description) => Owner.ApplyDescription(Handle, description);
    /// <summary>Moves the bounds of the body in the broad phase to where its pose says.</summary>
    public readonly void UpdateBounds() => Owner.UpdateBounds(Handle);
    /// <summary>Pointers to the bounds of the body in the broad phase; valid until collidables are added or removed.</summary>
    /// <exception cref="InvalidOperationException">The body has no shape, hence no bounds.</exception>
    public readonly unsafe void GetBoundsReferencesFromBroadPhase(out Vector3* min, out Vector3* max) =>
        Owner.GetBoundsPointers(ref Find(out var index), index, out min, out max);

    /// <summary>Inverse inertia tensor in world axes.</summary>
    public readonly void ComputeInverseInertia(out Symmetric3x3 inverseInertia) =>
        inverseInertia = Symmetric3x3.RotateInverseInertia(LocalInertia.InverseInertiaTensor, Pose.Orientation);

    /// <summary>Velocity of a point that moves with the body.</summary>
    /// <param name="offset">From the centre of mass, world axes.</param>
    /// <param name="velocity">Velocity of the point.</param>
    public readonly void GetVelocityForOffset(Vector3 offset, out Vector3 velocity) =>
        velocity = Velocity.Linear + Exact.Cross(Velocity.Angular, offset);

    /// <summary>Applies an impulse at a point. A kinematic body has no mass to be pushed by: nothing happens to it.</summary>
    /// <param name="impulse">N s, world axes.</param>
    /// <param name="impulseOffset">From the centre of mass, world axes.</param>
    /// <exception cref="ArgumentException">A value, or the velocity that results, is beyond <see cref="Limits"/>; nothing was changed.</exception>
    public readonly void ApplyImpulse(Vector3 impulse, Vector3 impulseOffset)
    {
        BodyChecks.Vector(impulse, nameof(impulse));
        BodyChecks.Vector(impulseOffset, nameof(impulseOffset));
        Owner.CheckWritable(nameof(ApplyImpulse));
        var velocity = Velocity;
        ApplyImpulse(impulse, impulseOffset, ref LocalInertia, ref Pose, ref velocity);
        BodyChecks.Velocity(velocity);
        Push(velocity);
    }

    // A velocity that an impulse has made.
    readonly void Push(in BodyVelocity velocity, [CallerMemberName] string operation = "")
    {
        if (Kinematic)
            return;
        Owner.WakeToPush(Handle, operation);
        Activity.Forget();
        Velocity = velocity;
    }

    /// <summary>Applies an impulse at the centre of mass, N s; to a kinematic body none.</summary>
    /// <exception cref="ArgumentException">The impulse, or the velocity that results, is beyond <see cref="Limits"/>; nothing was changed.</exception>
    public readonly void ApplyLinearImpulse(Vector3 impulse)
    {
        BodyChecks.Vector(impulse, nameof(impulse));
        Owner.CheckWritable(nameof(ApplyLinearImpulse));
        var velocity = Velocity;
        ApplyLinearImpulse(impulse, LocalInertia.InverseMass, ref velocity.Linear);
        BodyChecks.Velocity(velocity);
        Push(velocity);
    }

    /// <summary>Applies an angular impulse, N m s; to a kinematic body none.</summary>
    /// <exception cref="ArgumentException">The impulse, or the velocity that results, is beyond <see cref="Limits"/>; nothing was changed.</exception>
    public readonly void ApplyAngularImpulse(Vector3 angularImpulse)
    {
        BodyChecks.Vector(angularImpulse, nameof(angularImpulse));
        Owner.CheckWritable(nameof(ApplyAngularImpulse));
        ComputeInverseInertia(out var inverseInertia);
        var velocity = Velocity;
        ApplyAngularImpulse(angularImpulse, inverseInertia, ref velocity.Angular);
        BodyChecks.Velocity(velocity);
        Push(velocity);
    }

    /// <summary>Applies an impulse at a point to a body of a set. Values are not checked.</summary>
    /// <param name="set">The set.</param>
    /// <param name="index">Index of the body in the set.</param>
    /// <param name="impulse">N s, world axes.</param>
    /// <param name="impulseOffset">From the centre of mass, world axes.</param>
    public static void ApplyImpulse(in BodySet set, int index, Vector3 impulse, Vector3 impulseOffset)
    {
        ref var state = ref set.MotionStates[index];
        ApplyImpulse(impulse, impulseOffset, ref set.LocalInertias[index], ref state.Pose, ref state.Velocity);
    }

    /// <summary>Applies an impulse at a point to what may be no body at all. Values are not checked.</summary>
    /// <param name="impulse">N s, world axes.</param>
    /// <param name="impulseOffset">From the centre of mass, world axes.</param>
    /// <param name="localInertia">Inverse mass and inertia in the body's frame.</param>
    /// <param name="pose">Pose, for the orientation.</param>
    /// <param name="velocity">Velocity to change.</param>
    public static void ApplyImpulse(
        Vector3 impulse, Vector3 impulseOffset, ref BodyInertia localInertia, ref RigidPose pose, ref BodyVelocity velocity)
    {
        ApplyLinearImpulse(impulse, localInertia.InverseMass, ref velocity.Linear);
        var inverseInertia = Symmetric3x3.RotateInverseInertia(localInertia.InverseInertiaTensor, pose.Orientation);
        ApplyAngularImpulse(Exact.Cross(impulseOffset, impulse), inverseInertia, ref velocity.Angular);
    }

    /// <summary>Applies an impulse, N s, to a linear velocity. Values are not checked.</summary>
    public static void ApplyLinearImpulse(Vector3 impulse, float inverseMass, ref Vector3 linearVelocity) =>
        linearVelocity += impulse * inverseMass;

    /// <summary>Applies an angular impulse, N m s, to an angular velocity; all in world axes. Values are not checked.</summary>
    public static void ApplyAngularImpulse(Vector3 angularImpulse, in Symmetric3x3 inverseInertiaTensor, ref Vector3 angularVelocity) =>
        angularVelocity += inverseInertiaTensor * angularImpulse;

    /// <summary>Handle of the body.</summary>
    public static implicit operator BodyHandle(BodyReference reference) => reference.Handle;
}
