using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>A collidable that never moves by itself.</summary>
public struct Static
{
    /// <summary>Where it is.</summary>
    public RigidPose Pose;
    /// <summary>Continuous detection of bodies against it.</summary>
    public ContinuousDetection Continuity;
    /// <summary>Its shape. To be changed by <see cref="StaticReference.SetShape"/>.</summary>
    public TypedIndex Shape { readonly get; internal set; }
    /// <summary>Index of its leaf in the broad phase.</summary>
    public int BroadPhaseIndex;
}

/// <summary>Everything about a static when it is added.</summary>
/// <param name="pose">Where it is.</param>
/// <param name="shape">Its shape.</param>
/// <param name="continuity">Continuous detection of bodies against it.</param>
public struct StaticDescription(RigidPose pose, TypedIndex shape, ContinuousDetection continuity)
{
    /// <summary>Where it is.</summary>
    public RigidPose Pose = pose;
    /// <summary>Its shape.</summary>
    public TypedIndex Shape = shape;
    /// <summary>Continuous detection of bodies against it.</summary>
    public ContinuousDetection Continuity = continuity;

    /// <summary>With discrete detection.</summary>
    public StaticDescription(RigidPose pose, TypedIndex shape) : this(pose, shape, ContinuousDetection.Discrete) { }
    /// <summary>With position and orientation apart.</summary>
    public StaticDescription(Vector3 position, Quaternion orientation, TypedIndex shape, ContinuousDetection continuity)
        : this(new RigidPose(position, orientation), shape, continuity) { }
    /// <summary>With position and orientation apart, and discrete detection.</summary>
    public StaticDescription(Vector3 position, Quaternion orientation, TypedIndex shape)
        : this(new RigidPose(position, orientation), shape, ContinuousDetection.Discrete) { }
}

/// <summary>A static, for reading and changing it. Cheap to make; its refs are valid until statics are added or removed.</summary>
/// <remarks>
/// Everything but <see cref="Exists"/> throws an <see cref="ArgumentException"/> once the static was removed, and an
/// <see cref="InvalidOperationException"/> for the default value.
/// </remarks>
public struct StaticReference(StaticHandle handle, Statics statics)
{
    /// <summary>Handle of the static.</summary>
    public StaticHandle Handle = handle;
    /// <summary>The statics among which it is.</summary>
    public Statics Statics = statics;

    /// <summary>Whether there still is such a static.</summary>
    public readonly bool Exists => Statics is not null && Statics.StaticExists(Handle);
    /// <summary>Index of the static.</summary>
    public readonly int Index => Owner.GetIndex(Handle);
    /// <summary>The static in place.</summary>
    public readonly ref Static Static => ref Owner.GetDirectReference(Handle);
    /// <summary>Where it is; call <see cref="UpdateBounds"/> after writing.</summary>
    public readonly ref RigidPose Pose => ref Static.Pose;
    /// <summary>Continuous detection of bodies against it.</summary>
    public readonly ref ContinuousDetection Continuity => ref Static.Continuity;
    /// <summary>Its shape.</summary>
    public readonly TypedIndex Shape => Static.Shape;
    /// <summary>The static as the collision detection names it.</summary>
    public readonly CollidableReference CollidableReference => new(Handle);
    /// <summary>Bounds of the static in the broad phase.</summary>
    public readonly unsafe BoundingBox BoundingBox
    {
        get
        {
            Owner.GetBoundsPointers(Handle, out var min, out var max);
            return new(*min, *max);
        }
    }

    readonly Statics Owner => Statics ?? throw new InvalidOperationException("The default static reference refers to no static.");

    /// <summary>Gives the static another shape.</summary>
    public readonly void SetShape(TypedIndex newShape) => Owner.SetShape(Handle, newShape);
    /// <summary>Describes the static as it is now.</summary>
    public readonly void GetDescription(out StaticDescription description) => Owner.GetDescription(Handle, out description);
    /// <summary>Everything about the static, to be changed and given to <see cref="ApplyDescription"/>.</summary>
    public readonly StaticDescription GetDescription() => Owner.GetDescription(Handle);
    /// <summary>Makes the static what a description says.</summary>
    public readonly void ApplyDescription(in StaticDescription description) => Owner.ApplyDescription(Handle, description);
    /// <summary>Moves the bounds of the static to where its pose says.</summary>
    public readonly void UpdateBounds() => Owner.UpdateBounds(Handle);
}
