using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>A kind of rows that many joints have: what they see of velocities, and what impulses along them do.</summary>
/// <typeparam name="TJacobian">The type itself: lever arms and axes for the current poses.</typeparam>
/// <typeparam name="TBodies">Bodies that the rows connect.</typeparam>
/// <typeparam name="TRows">One number per row.</typeparam>
/// <typeparam name="TMass">Symmetric matrix over the rows.</typeparam>
interface IJacobian<TJacobian, TBodies, TRows, TMass>
    where TJacobian : unmanaged, IJacobian<TJacobian, TBodies, TRows, TMass> where TBodies : unmanaged, IBodySlots
    where TRows : unmanaged, IRows<TRows> where TMass : unmanaged, IRowMatrix<TMass, TRows>
{
    /// <summary>Whether a row is along a direction; it is about an axis otherwise.</summary>
    static virtual bool IsLinear(int row) => true;

    /// <summary>What rows of this kind read of bodies, their joint's preparation included; of velocities, what they write too.</summary>
    static virtual BodyAccess Access => BodyAccess.Pose | BodyAccess.Velocity | BodyAccess.Mass;

    /// <summary>J v.</summary>
    static abstract void RelativeVelocity(in TJacobian jacobian, in TBodies bodies, out TRows velocity);

    /// <summary>v += M^-1 J^T lambda.</summary>
    static abstract void ApplyImpulse(in TJacobian jacobian, ref TBodies bodies, in TRows impulse);

    /// <summary>K = J M^-1 J^T.</summary>
    static abstract void InverseEffectiveMass(in TJacobian jacobian, in TBodies bodies, out TMass inverseMass);
}

/// <summary>Rows three of which hold a point of A to a point of B.</summary>
/// <inheritdoc cref="IJacobian{TJacobian, TBodies, TRows, TMass}"/>
interface IPointJacobian<TJacobian, TBodies, TRows, TMass> : IJacobian<TJacobian, TBodies, TRows, TMass>
    where TJacobian : unmanaged, IPointJacobian<TJacobian, TBodies, TRows, TMass> where TBodies : unmanaged, IBodySlots
    where TRows : unmanaged, IRows<TRows> where TMass : unmanaged, IRowMatrix<TMass, TRows>
{
    /// <summary>Lever arms of the points, and the part of the rows' numbers that is theirs.</summary>
    static abstract void PointLoad(in TJacobian jacobian, in TRows rows, out Vector3Wide point, out Vector3Wide offsetA, out Vector3Wide offsetB);
}

/// <summary>A joint whose rows are of a kind that others have as well: it says where they are and what their error is.</summary>
/// <inheritdoc cref="IJoint{TBodies, TPrestep, TGeometry, TRows, TMass}"/>
interface IJacobianJoint<TBodies, TPrestep, TJacobian, TRows, TMass> : IJoint<TBodies, TPrestep, TJacobian, TRows, TMass>
    where TBodies : unmanaged, IBodySlots where TPrestep : unmanaged where TJacobian : unmanaged, IJacobian<TJacobian, TBodies, TRows, TMass>
    where TRows : unmanaged, IRows<TRows> where TMass : unmanaged, IRowMatrix<TMass, TRows>
{
    static bool IJoint<TBodies, TPrestep, TJacobian, TRows, TMass>.IsLinear(int row) => TJacobian.IsLinear(row);

    static BodyAccess IJoint<TBodies, TPrestep, TJacobian, TRows, TMass>.Access
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => TJacobian.Access;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void IJoint<TBodies, TPrestep, TJacobian, TRows, TMass>.RelativeVelocity(in TJacobian geometry, in TBodies bodies, out TRows velocity) =>
        TJacobian.RelativeVelocity(geometry, bodies, out velocity);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void IJoint<TBodies, TPrestep, TJacobian, TRows, TMass>.ApplyImpulse(in TJacobian geometry, ref TBodies bodies, in TRows impulse) =>
        TJacobian.ApplyImpulse(geometry, ref bodies, impulse);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void IJoint<TBodies, TPrestep, TJacobian, TRows, TMass>.InverseEffectiveMass(
        in TJacobian geometry, in TBodies bodies, out TMass inverseMass) => TJacobian.InverseEffectiveMass(geometry, bodies, out inverseMass);
}

/// <summary>A joint with rows that hold a point of A to a point of B, besides others or alone.</summary>
/// <inheritdoc cref="IJoint{TBodies, TPrestep, TGeometry, TRows, TMass}"/>
interface IPointJoint<TBodies, TPrestep, TJacobian, TRows, TMass> : IJacobianJoint<TBodies, TPrestep, TJacobian, TRows, TMass>
    where TBodies : unmanaged, IBodySlots where TPrestep : unmanaged where TJacobian : unmanaged, IPointJacobian<TJacobian, TBodies, TRows, TMass>
    where TRows : unmanaged, IRows<TRows> where TMass : unmanaged, IRowMatrix<TMass, TRows>
{
    static bool IJoint<TBodies, TPrestep, TJacobian, TRows, TMass>.HoldsPoints => true;

    static BodyAccess IJoint<TBodies, TPrestep, TJacobian, TRows, TMass>.ErrorAccess
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => BodyAccess.Position;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void IJoint<TBodies, TPrestep, TJacobian, TRows, TMass>.PointLoad(
        in TJacobian geometry, in TRows impulses, out Vector3Wide impulse, out Vector3Wide offsetA, out Vector3Wide offsetB) =>
        TJacobian.PointLoad(geometry, impulses, out impulse, out offsetA, out offsetB);
}
