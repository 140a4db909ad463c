using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The way of a body in a substep: from where it was at its beginning, or at its last impact, to where it is at its end.</summary>
struct FastBody
{
    /// <summary>Time from which on the way is known, s from the beginning of the substep.</summary>
    public double Time;
    /// <summary>Where the body is at that time.</summary>
    public DoubleVector3 Position;
    /// <summary>
    /// Constant velocities that take it from there to its end, m/s and rad/s. What turns otherwise comes to the same end. That of a ball's turn is not known
    /// before its first impact: nothing asks for it until then.
    /// </summary>
    public DoubleVector3 Linear, Angular;
    /// <summary>Velocity that its bounds contain, m/s, and how fast it may turn about any axis, rad/s.</summary>
    public DoubleVector3 ForeseenLinear;
    /// <summary>See <see cref="ForeseenLinear"/>.</summary>
    public double ForeseenSpin;
    /// <summary>By which the velocity changes in a substep where nothing is met, m/s.</summary>
    public DoubleVector3 FreeChange;
    /// <summary>Greatest speed by which it may move otherwise than its bounds have foreseen, m/s.</summary>
    public double UnforeseenSpeed;
    /// <summary>Radius of a ball about the centre that is in its shape, m, or what stands for one (<see cref="NarrowPhase.RadiiOf"/>).</summary>
    public float Inner;
    /// <summary>Radius around the centre that its shape does not leave, m; that of the shape's farthest turning point, 0 for a ball.</summary>
    public double Radius, TurningRadius;
    /// <summary>Index in the active set.</summary>
    public int Index;
    /// <summary>Which of those it is whom the solver has thrown aside in the substep, or -1.</summary>
    public int Look;
    /// <summary>Whether its shape is a ball.</summary>
    public bool IsBall;
    /// <summary>Whether it may have neighbours whom nobody watches: it looks for them even where it has not left its bounds.</summary>
    public bool MayHaveOthers;
    /// <summary>Whether it has looked around in this step.</summary>
    public bool HasLooked;
    /// <summary>Whether an impact has changed its way.</summary>
    public bool HasChanged;
    /// <summary>
    /// Whether what does not give way holds it for the rest of the substep, as impacts with that did not end: it goes with that, whatever else pushes it.
    /// </summary>
    public bool IsHeld;
    /// <summary>Where it has looked around last.</summary>
    public BoundingBox Searched;
    /// <summary>Where the body was at the end of the last substep, of which it is known that nothing was passed: from there it is swept.</summary>
    public Vector3 CheckedPosition;
    /// <summary>See <see cref="CheckedPosition"/>.</summary>
    public Quaternion CheckedOrientation;
    /// <summary>Its orientation at the time from which on the way is known.</summary>
    public Quaternion Orientation;
    /// <summary>Orientation and velocity at the end of the substep.</summary>
    public Quaternion EndOrientation;
    /// <summary>See <see cref="EndOrientation"/>.</summary>
    public BodyVelocity Velocity;
    /// <summary>Inverse inertia in the frame of the body.</summary>
    public BodyInertia Inertia;

    /// <summary>Begins with the way from where the body was to where it is.</summary>
    public void Begin(in MotionState end, double dt)
    {
        Time = 0;
        Position = new(CheckedPosition);
        Orientation = CheckedOrientation;
        EndOrientation = end.Pose.Orientation;
        Velocity = end.Velocity;
        Linear = (new DoubleVector3(end.Pose.Position) - Position) * (1 / dt);
        Angular = IsBall ? default : WholeTurn(dt);
        HasChanged = IsHeld = false;
        (CheckedPosition, CheckedOrientation) = (end.Pose.Position, end.Pose.Orientation);
    }

    readonly DoubleVector3 WholeTurn(double dt) => BodyTurn.Between(Orientation, EndOrientation, new DoubleVector3(Velocity.Angular) * dt) * (1 / dt);

    /// <summary>Whether it may come to what is not in its bounds.</summary>
    public readonly bool IsUnforeseen =>
        (Linear - ForeseenLinear).Length + (TurningRadius > 0 ? Math.Max(0, Angular.Length - ForeseenSpin) * TurningRadius : 0) > UnforeseenSpeed;

    /// <summary>Where the body is at a time.</summary>
    public readonly DoubleVector3 PositionAt(double time) => Position + Linear * (time - Time);

    /// <summary>Its axes at a time.</summary>
    public readonly DoubleMatrix3x3 AxesAt(double time) =>
        BodyTurn.Of(Angular, time - Time).After(DoubleMatrix3x3.FromQuaternion(Orientation));

    /// <summary>Brings the body to a time, with the velocity that it has there: in its own frame that of the end, which is that of its energy.</summary>
    /// <param name="time">The time, s.</param>
    /// <param name="dt">Length of the substep, s.</param>
    // Angular momentum that is kept would give a thin body a great spin about its length where the way is not quite that of free rotation.
    public void GoTo(double time, double dt)
    {
        if (IsBall && !HasChanged)
            Angular = WholeTurn(dt);
        Position = PositionAt(time);
        Orientation = BodyTurn.Turn(Orientation, Angular, time - Time);
        Time = time;
        Velocity.Angular = Exact.Rotate(Exact.RotateByInverse(Velocity.Angular, EndOrientation), Orientation);
        EndOrientation = Orientation;
    }

    /// <summary>Inverse inertia in world axes at the time to which the body was brought; none while it is held.</summary>
    public readonly BodyInertia WorldInertia => IsHeld ? default : new()
    {
        InverseInertiaTensor = Symmetric3x3.RotateInverseInertia(Inertia.InverseInertiaTensor, Orientation),
        InverseMass = Inertia.InverseMass,
    };

    /// <summary>Inverse mass; zero while it is held.</summary>
    public readonly float InverseMass => IsHeld ? 0 : Inertia.InverseMass;

    /// <summary>Goes on from the time to which the body was brought, with its velocity as it is now.</summary>
    /// <param name="dt">End of the substep, s.</param>
    public void GoOn(double dt)
    {
        Linear = new(Velocity.Linear);
        Angular = new(Velocity.Angular);
        EndOrientation = BodyTurn.Turn(Orientation, Angular, dt - Time);
        HasChanged = true;
    }

    /// <summary>Goes on from the time to which the body was brought as a part of a rigid body, that turns as this one does.</summary>
    /// <param name="offset">Where the body is from the centre of the rigid one, m.</param>
    /// <param name="velocity">Velocity of that centre, m/s.</param>
    /// <param name="dt">End of the substep, s.</param>
    public void GoOnAbout(in DoubleVector3 offset, in DoubleVector3 velocity, double dt)
    {
        var rest = dt - Time;
        if (!(rest > 0))
            return;
        var end = BodyTurn.Of(Angular, rest).Turn(offset);
        Linear = velocity + (end - offset) * (1 / rest);
        Velocity.Linear = (velocity + DoubleVector3.Cross(Angular, end)).ToSingle();
    }
}
