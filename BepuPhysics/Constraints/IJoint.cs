using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>How the rows of a joint are held.</summary>
public enum RowKind
{
    /// <summary>C = 0; impulses of either sign.</summary>
    Equality,
    /// <summary>C &gt;= 0; impulses are not negative, and a row with slack left may use it up within the substep.</summary>
    Inequality,
    /// <summary>C = 0, approached no faster and pushed no harder than the joint's <see cref="ServoSettings"/> say.</summary>
    Servo,
    /// <summary>J v = target velocity, whatever the position; pushed no harder than the joint's <see cref="MotorSettings"/> say.</summary>
    Motor,
}

/// <summary>The mathematics of one type of joint, in the parts that every solver needs.</summary>
/// <typeparam name="TBodies">Bodies that the joint connects.</typeparam>
/// <typeparam name="TPrestep">Wide form of the joint's description.</typeparam>
/// <typeparam name="TGeometry">Lever arms and axes: what the Jacobian is made of.</typeparam>
/// <typeparam name="TRows">One number per row.</typeparam>
/// <typeparam name="TMass">Symmetric matrix over the rows.</typeparam>
/// <remarks>
/// The parts are kept apart on purpose. The sequential solver (<see cref="JointConstraint{TBodies, TPrestep, TGeometry, TRows, TMass, TJoint}"/>)
/// composes them; a direct solver gets the blocks of its matrix from the same source, column by column, as the relative velocity
/// along one joint's rows of bodies at rest to which a unit impulse of another joint was applied. So nothing here may fold softness
/// into the mass, or signs into the impulses.
/// <para>C is the position error, J its derivative by the bodies' velocities, K = J M^-1 J^T, lambda the impulses; M v+ = M v + J^T lambda.</para>
/// </remarks>
public interface IJoint<TBodies, TPrestep, TGeometry, TRows, TMass>
    where TBodies : unmanaged, IBodySlots where TPrestep : unmanaged where TGeometry : unmanaged
    where TRows : unmanaged, IRows<TRows> where TMass : unmanaged, IRowMatrix<TMass, TRows>
{
    /// <summary>How the rows are held.</summary>
    static virtual RowKind Kind => RowKind.Equality;

    /// <summary>Whether a row is along a direction; it is about an axis otherwise. All are, unless a joint says otherwise.</summary>
    /// <param name="row">Number of the row.</param>
    static virtual bool IsLinear(int row) => true;

    /// <summary>
    /// What is read of the bodies by all parts but <see cref="PositionError"/> and <see cref="TargetVelocity"/>; of velocities, what is written too.
    /// </summary>
    static virtual BodyAccess Access => BodyAccess.Pose | BodyAccess.Velocity | BodyAccess.Mass;

    /// <summary>What <see cref="PositionError"/> and <see cref="TargetVelocity"/> read besides.</summary>
    static virtual BodyAccess ErrorAccess => BodyAccess.None;

    /// <summary>What <see cref="Prepare"/> and <see cref="PositionError"/> read besides poses: whoever asks only for these gathers no more.</summary>
    static virtual BodyAccess ArmAccess => BodyAccess.None;

    /// <summary>Lever arms and axes for the current poses.</summary>
    static abstract void Prepare(in TBodies bodies, in TPrestep prestep, out TGeometry geometry);

    /// <summary>C for the current poses. For inequalities: negative where violated, otherwise the slack.</summary>
    static abstract void PositionError(in TBodies bodies, in TPrestep prestep, in TGeometry geometry, out TRows error);

    /// <summary>Whether <see cref="LeastSlack"/> is less to work out than <see cref="PositionError"/>; of one row that is an inequality only.</summary>
    static virtual bool BoundsSlack => false;

    /// <summary>A value that C is not below, to be asked before it; asked for only where <see cref="BoundsSlack"/>.</summary>
    static virtual void LeastSlack(in TPrestep prestep, in TGeometry geometry, out TRows slack) => slack = default;

    /// <summary>Turns the rows, whose error is that of where <see cref="Prepare"/> has put them, to where they act.</summary>
    static virtual void LeanRows(in TBodies bodies, in TPrestep prestep, ref TGeometry geometry) { }

    /// <summary>J v that a motor is to bring about; asked for only where <see cref="Kind"/> is <see cref="RowKind.Motor"/>.</summary>
    static virtual void TargetVelocity(in TBodies bodies, in TPrestep prestep, in TGeometry geometry, out TRows velocity) => velocity = default;

    /// <summary>J v.</summary>
    static abstract void RelativeVelocity(in TGeometry geometry, in TBodies bodies, out TRows velocity);

    /// <summary>v += M^-1 J^T lambda.</summary>
    static abstract void ApplyImpulse(in TGeometry geometry, ref TBodies bodies, in TRows impulse);

    /// <summary>K, neither inverted nor softened.</summary>
    static abstract void InverseEffectiveMass(in TGeometry geometry, in TBodies bodies, out TMass inverseMass);

    /// <summary>Whether the joint holds a point of A to a point of B.</summary>
    static virtual bool HoldsPoints => false;

    /// <summary>
    /// Whether the joint hands the weight of one body to another, so that several of them on one body make it a hub, whose joints may be less stiff
    /// than those of a chain.
    /// </summary>
    /// <remarks>Joints that hold points do so, whatever they say.</remarks>
    static virtual bool CarriesBodies => false;

    /// <summary>
    /// Whether the joint pulls at a point of A and a point of B without holding them to each other in all directions: its load stiffens their rotation too.
    /// </summary>
    /// <remarks>The load of joints that hold points does so, whatever they say.</remarks>
    static virtual bool PullsAtPoints => false;

    /// <summary>Whether it is the error that tells how far correcting it turns the bodies, and not the impulse alone.</summary>
    /// <remarks>Of rows at arms that bear next to nothing at moments when they are far off. Only where joints hold points or hand weight on.</remarks>
    static virtual bool TurnsByError => false;

    /// <summary>Arms and impulse (on A) of the point rows; asked for only where <see cref="HoldsPoints"/> or <see cref="PullsAtPoints"/>.</summary>
    static virtual void PointLoad(in TGeometry geometry, in TRows impulses, out Vector3Wide impulse, out Vector3Wide offsetA, out Vector3Wide offsetB)
    {
        impulse = default;
        offsetA = default;
        offsetB = default;
    }

    /// <summary>Whether the description holds places of the world, which <see cref="ShiftOrigin"/> moves.</summary>
    static virtual bool HasPlaces => false;

    /// <summary>Moves the places of the world that the description holds, if <see cref="HasPlaces"/>, to where they are seen from a new origin.</summary>
    /// <param name="prestep">The description.</param>
    /// <param name="shift">Where the new origin is, m: taken from each place. Zero in lanes that are not in use.</param>
    static virtual void ShiftOrigin(ref TPrestep prestep, in Vector3Wide shift) { }

    /// <summary>Stiffness of the joint.</summary>
    static abstract SpringSettingsWide Spring(in TPrestep prestep);

    /// <summary>Limits of a servo; asked for only where <see cref="Kind"/> is <see cref="RowKind.Servo"/>.</summary>
    static virtual ServoSettingsWide Servo(in TPrestep prestep) => default;

    /// <summary>Limit and softness of a motor; asked for only where <see cref="Kind"/> is <see cref="RowKind.Motor"/>.</summary>
    static virtual MotorSettingsWide Motor(in TPrestep prestep) => default;
}
