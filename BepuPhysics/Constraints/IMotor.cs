namespace BepuPhysics.Constraints;

/// <summary>A joint that holds a velocity instead of a position: it has a target velocity and no position error.</summary>
/// <typeparam name="TBodies">Bodies that the motor connects.</typeparam>
/// <typeparam name="TPrestep">Wide form of the motor's description.</typeparam>
/// <typeparam name="TGeometry">Lever arms and axes: what the Jacobian is made of.</typeparam>
/// <typeparam name="TRows">One number per row.</typeparam>
/// <typeparam name="TMass">Symmetric matrix over the rows.</typeparam>
/// <remarks>The other parts are those of every joint; what a motor does not have is answered here.</remarks>
public interface IMotor<TBodies, TPrestep, TGeometry, TRows, TMass> : IJoint<TBodies, TPrestep, TGeometry, TRows, TMass>
    where TBodies : unmanaged, IBodySlots where TPrestep : unmanaged where TGeometry : unmanaged
    where TRows : unmanaged, IRows<TRows> where TMass : unmanaged, IRowMatrix<TMass, TRows>
{
    static RowKind IJoint<TBodies, TPrestep, TGeometry, TRows, TMass>.Kind => RowKind.Motor;

    static void IJoint<TBodies, TPrestep, TGeometry, TRows, TMass>.PositionError(
        in TBodies bodies, in TPrestep prestep, in TGeometry geometry, out TRows error) => error = default;

    static SpringSettingsWide IJoint<TBodies, TPrestep, TGeometry, TRows, TMass>.Spring(in TPrestep prestep) => default;

    // Abstract again, so that a motor which forgets them does not compile.
    static abstract void IJoint<TBodies, TPrestep, TGeometry, TRows, TMass>.TargetVelocity(
        in TBodies bodies, in TPrestep prestep, in TGeometry geometry, out TRows velocity);

    static abstract MotorSettingsWide IJoint<TBodies, TPrestep, TGeometry, TRows, TMass>.Motor(in TPrestep prestep);
}
