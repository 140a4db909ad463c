using System;
using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuPhysics.CollisionDetection;

/// <summary>A convex shape that turns about the centre of its body, of which it may be a part.</summary>
/// <remarks>
/// Where the centre is, and how it moves, is said of the pair (<see cref="ImpactPair"/>). Everything is in the axes of the world.
/// </remarks>
struct ImpactBody
{
    /// <summary>The shape.</summary>
    public ImpactCore Core;
    // Of the shape at the time zero.
    DoubleMatrix3x3 firstAxes;
    DoubleVector3 firstArm;
    // Unit axis and speed of the turn, rad/s.
    DoubleVector3 axis;
    double speed;
    DoubleVector3 angular;
    // How far the core reaches along the axis and against it, and its distance from it, m: no turn changes these.
    double alongAxis, againstAxis, aroundAxis;
    // Part of the turn along the axis about which the shape is round, rad/s: it moves no surface.
    double ownSpin;

    /// <summary>Axes of the shape at the present time.</summary>
    public DoubleMatrix3x3 Axes;
    /// <summary>From the centre of the body to the origin of the shape at the present time, m.</summary>
    public DoubleVector3 Arm;
    /// <summary>Distance of the farthest point of the core from the centre of the body, m.</summary>
    public double Reach;

    /// <summary>Whether turning moves the core at all.</summary>
    public readonly bool Turns
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => speed > 0;
    }

    /// <summary>From the centre of the body to that of a ball that always holds the shape, m.</summary>
    public readonly DoubleVector3 BallCenter => speed > 0 ? default : Arm;

    /// <summary>Radius of that ball, m.</summary>
    public readonly double BallRadius => Core.Margin + (speed > 0 ? Reach : Core.Reach);

    /// <summary>Speed of the turn, rad/s; zero where it moves nothing.</summary>
    public readonly double Speed => speed;

    /// <summary>Angular velocity, rad/s; it moves nothing where <see cref="Speed"/> is zero.</summary>
    public readonly DoubleVector3 Angular => angular;

    /// <summary>What is left of it, without the spin about an axis about which the shape is round, rad/s.</summary>
    public readonly DoubleVector3 Moving => ownSpin == 0 ? angular : angular - Axes.Y * ownSpin;

    /// <summary>Greatest speed that turning gives a point of the core, m/s.</summary>
    public readonly double SurfaceSpeed => speed > 0 ? speed * aroundAxis : 0;

    /// <summary>Creates a shape at the time zero.</summary>
    /// <param name="core">The shape.</param>
    /// <param name="local">Pose of the shape in its body.</param>
    /// <param name="orientation">Orientation of the body.</param>
    /// <param name="angularVelocity">Angular velocity of the body, rad/s.</param>
    public ImpactBody(in ImpactCore core, in RigidPose local, in DoubleMatrix3x3 orientation, in DoubleVector3 angularVelocity)
    {
        Unsafe.SkipInit(out this);
        Core = core;
        // Triangles of surfaces are never turned in them.
        firstAxes = local.Orientation == Quaternion.Identity ? orientation
            : orientation.After(DoubleMatrix3x3.FromQuaternion(local.Orientation));
        firstArm = orientation.Turn(new(local.Position));
        Begin(angularVelocity);
    }

    /// <summary>Creates a shape that is a body of its own, at the time zero.</summary>
    public ImpactBody(in ImpactCore core, in DoubleMatrix3x3 orientation, in DoubleVector3 angularVelocity)
    {
        Unsafe.SkipInit(out this);
        Core = core;
        firstAxes = orientation;
        firstArm = default;
        Begin(angularVelocity);
    }

    void Begin(in DoubleVector3 angularVelocity)
    {
        Axes = firstAxes;
        Arm = firstArm;
        var distance = firstArm.Length;
        Reach = distance + Core.Reach;
        angular = angularVelocity;
        speed = angularVelocity.Length;
        ownSpin = 0;
        // A point at the centre of its body goes nowhere.
        if (speed == 0 || Reach == 0)
        {
            speed = 0;
            return;
        }
        axis = angularVelocity * (1 / speed);
        alongAxis = Extent(axis);
        againstAxis = Extent(-axis);
        aroundAxis = DoubleVector3.Cross(axis, firstArm).Length + Core.RadiusAbout(firstAxes.TurnBack(axis));
        if (distance != 0 || !Core.IsRoundAboutY)
            return;
        ownSpin = DoubleVector3.Dot(angularVelocity, firstAxes.Y);
        var rest = angularVelocity - firstAxes.Y * ownSpin;
        // The rounding of a spin about its own axis is no turn: over a time in which it made a difference, the orientation is unknown.
        if (DoubleVector3.Dot(rest, rest) < 1e-28 * speed * speed)
            speed = 0;
    }

    /// <summary>Goes back to the time zero.</summary>
    public void Restart()
    {
        Axes = firstAxes;
        Arm = firstArm;
    }

    /// <summary>A box about the whole shape from the time zero on, in the axes of a frame, from the centre of the body.</summary>
    /// <param name="frame">The frame.</param>
    /// <param name="maximumT">Length of the time; may be infinite.</param>
    /// <param name="min">Lower corner, m.</param>
    /// <param name="max">Upper corner, m.</param>
    public readonly void GetBounds(in DoubleMatrix3x3 frame, double maximumT, out DoubleVector3 min, out DoubleVector3 max)
    {
        max = new(Bound(frame.X, maximumT), Bound(frame.Y, maximumT), Bound(frame.Z, maximumT));
        min = -new DoubleVector3(Bound(-frame.X, maximumT), Bound(-frame.Y, maximumT), Bound(-frame.Z, maximumT));
    }

    readonly double Bound(in DoubleVector3 direction, double maximumT)
    {
        var extent = Extent(direction);
        return Core.Margin + (speed > 0 ? Math.Min(GreatestExtent(direction), extent + SurfaceSpeed * maximumT) : extent);
    }

    /// <summary>Goes to a time.</summary>
    public void Place(double t)
    {
        if (speed == 0)
            return;
        var turn = Turn(t);
        Axes = turn.After(firstAxes);
        Arm = turn.Turn(firstArm);
    }

    readonly DoubleMatrix3x3 Turn(double t)
    {
        DoubleMatrix3x3.SineAndCosine(speed * t, out var sine, out var cosine);
        return DoubleMatrix3x3.FromAxis(axis, sine, cosine);
    }

    /// <summary>Farthest point of the core along a direction, from its shape's origin, in the frame of the shape.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly DoubleVector3 Support(in DoubleVector3 direction) => Core.IsPoint ? default : Core.Support(Axes.TurnBack(direction));

    /// <summary>A point of the core, from the centre of the body, in world axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly DoubleVector3 Point(in DoubleVector3 local) => Core.IsPoint ? Arm : Arm + Axes.Turn(local);

    /// <summary>How far the core reaches along a direction, from the centre of the body, m.</summary>
    public readonly double Extent(in DoubleVector3 direction) => DoubleVector3.Dot(direction, Point(Support(direction)));

    /// <summary>How far the core will reach along a unit direction at another time.</summary>
    /// <param name="direction">The direction.</param>
    /// <param name="dt">That time less the present one, s.</param>
    public readonly double ExtentAfter(in DoubleVector3 direction, double dt) => Extent(Turn(dt).TurnBack(direction));

    /// <summary>How much farther the core may reach along a unit direction within a time, by the speeds of its points.</summary>
    /// <remarks>
    /// A point r of the body moves along n with r . m, m = n x w. That is at most what the core reaches along m; as it turns on, m does
    /// so in its frame, by the angle w t, and the reach changes by no more than that angle times |m| and the radius about the axis. Of a
    /// shape that is round about its own axis a, only the rest of w moves the surface, w - (w . a) a, which changes with the axis as this
    /// turns.
    /// </remarks>
    /// <param name="n">The direction.</param>
    /// <param name="linear">Metres per second at first.</param>
    /// <param name="quadratic">Metres per squared second besides.</param>
    /// <param name="greatest">Metres per second at most, at any time.</param>
    public readonly void BoundApproach(in DoubleVector3 n, out double linear, out double quadratic, out double greatest)
    {
        if (ownSpin == 0)
        {
            var m = DoubleVector3.Cross(n, angular);
            var size = m.Length;
            greatest = size * aroundAxis;
            linear = size > 0 ? Extent(m * (1 / size)) * size : 0;
            quadratic = 0.5 * greatest * speed;
            return;
        }
        var moving = Moving;
        var across = DoubleVector3.Cross(n, moving);
        var acrossSize = across.Length;
        var movingSpeed = moving.Length;
        greatest = movingSpeed * Reach;
        linear = acrossSize > 0 ? Extent(across * (1 / acrossSize)) * acrossSize : 0;
        quadratic = 0.5 * Reach * (speed * acrossSize + Math.Abs(ownSpin) * movingSpeed);
    }

    /// <summary>
    /// How far the core reaches against the part of a unit direction that is along the axis: what a bound between two times goes by.
    /// </summary>
    /// <param name="n">The direction.</param>
    public readonly double ExtentAlongAxis(in DoubleVector3 n)
    {
        var along = DoubleVector3.Dot(n, axis);
        return along > 0 ? along * againstAxis : -along * alongAxis;
    }

    /// <summary>How far the core reaches along a unit direction at most, at any time: as what its turn makes of it.</summary>
    /// <param name="n">The direction.</param>
    public readonly double GreatestExtent(in DoubleVector3 n)
    {
        var along = DoubleVector3.Dot(n, axis);
        var across = Math.Sqrt(Math.Max(0, 1 - along * along));
        return (along > 0 ? along * alongAxis : -along * againstAxis) + across * aroundAxis;
    }
}
