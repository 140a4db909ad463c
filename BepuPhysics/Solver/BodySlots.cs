using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>One bundle of bodies as constraints see them.</summary>
public struct SolverBodyWide
{
    /// <summary>Velocity of the centre of mass.</summary>
    public Vector3Wide Linear;
    /// <summary>Angular velocity in world axes.</summary>
    public Vector3Wide Angular;
    /// <summary>Inverse inertia tensor in world axes; zero for kinematics.</summary>
    public Symmetric3x3Wide InverseInertia;
    /// <summary>Inverse mass; zero for kinematics.</summary>
    public Vector<float> InverseMass;
    /// <summary>Position of the centre of mass.</summary>
    public Vector3Wide Position;
    /// <summary>Rotation from the body's frame to the world.</summary>
    public QuaternionWide Orientation;
    /// <summary>How far the centre of mass has moved since collision detection.</summary>
    public Vector3Wide Translation;
    /// <summary>Rotation since collision detection, as the sum of angular velocity times time.</summary>
    public Vector3Wide Rotation;
    /// <summary>Lanes in which the body is a hub: constraints that move it at the same time are many, or do not see each other's impulses.</summary>
    public Vector<int> HubMask;
    /// <summary>Both masks of a joint that holds points, as they are in its reference to its first body. Zero in nearly all lanes.</summary>
    internal Vector<int> CorrectionFlags;

    /// <summary>Lanes in which a joint that holds points may turn a body far by correcting its error; of a constraint's first body.</summary>
    public readonly Vector<int> TurnMask => ~Vector.Equals(CorrectionFlags & new Vector<int>(EncodedBody.TurnFlag), Vector<int>.Zero);

    /// <summary>Lanes in which a joint closes, slowly, a gap that it was added with; of a constraint's first body.</summary>
    public readonly Vector<int> GapMask => ~Vector.Equals(CorrectionFlags & new Vector<int>(EncodedBody.GapMask), Vector<int>.Zero);
}

/// <summary>Parts of a body that a constraint reads, and of its velocities those that it writes. Folded away by the JIT.</summary>
[Flags]
public enum BodyAccess
{
    /// <summary>Nothing.</summary>
    None = 0,
    /// <summary>Position.</summary>
    Position = 1,
    /// <summary>Orientation.</summary>
    Orientation = 2,
    /// <summary>Position and orientation.</summary>
    Pose = Position | Orientation,
    /// <summary>Linear velocity; read and written.</summary>
    Linear = 4,
    /// <summary>Angular velocity; read and written.</summary>
    Angular = 8,
    /// <summary>Velocities.</summary>
    Velocity = Linear | Angular,
    /// <summary>Inverse mass.</summary>
    InverseMass = 16,
    /// <summary>Inverse inertia.</summary>
    InverseInertia = 32,
    /// <summary>Inverse mass and inertia.</summary>
    Mass = InverseMass | InverseInertia,
    /// <summary>Translation and rotation since collision detection; read only where there can be any.</summary>
    Displacement = 64,
    /// <summary>Whether the body is a hub of joints.</summary>
    Hub = 128,
}

/// <summary>The one to four bodies that a constraint connects.</summary>
public interface IBodySlots
{
    /// <summary>Number of bodies; a JIT constant.</summary>
    static abstract int Count { get; }
}

/// <summary>One body against the world.</summary>
public struct OneBody : IBodySlots
{
    /// <summary>The body.</summary>
    public SolverBodyWide A;
    /// <inheritdoc/>
    public static int Count => 1;
}

/// <summary>Two bodies.</summary>
public struct TwoBodies : IBodySlots
{
    /// <summary>The connected bodies.</summary>
    public SolverBodyWide A, B;
    /// <inheritdoc/>
    public static int Count => 2;
}

/// <summary>Three bodies.</summary>
public struct ThreeBodies : IBodySlots
{
    /// <summary>The connected bodies.</summary>
    public SolverBodyWide A, B, C;
    /// <inheritdoc/>
    public static int Count => 3;
}

/// <summary>Four bodies.</summary>
public struct FourBodies : IBodySlots
{
    /// <summary>The connected bodies.</summary>
    public SolverBodyWide A, B, C, D;
    /// <inheritdoc/>
    public static int Count => 4;
}

/// <summary>Access to the bodies of a constraint by slot.</summary>
public static class BodySlots
{
    /// <summary>Body in a slot. Use constant slots: a loop would take addresses and keep the bodies out of registers.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static ref SolverBodyWide At<TBodies>(ref TBodies bodies, int slot) where TBodies : unmanaged, IBodySlots =>
        ref Unsafe.Add(ref Unsafe.As<TBodies, SolverBodyWide>(ref bodies), slot);
}
