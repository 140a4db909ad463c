using System;

namespace Demos.References;

/// <summary>
/// A symmetric top held in a point of its axis, under gravity along -y: Euler's equations about that point, integrated by the classical Runge-Kutta
/// scheme in double precision. Body axes: y along the axis, from the point to the centre of mass.
/// I dw/dt = (I w) x w + q^-1 (r x m g);  dq/dt = q (w, 0) / 2.
/// </summary>
/// <param name="principalInertia">About the point, kg m2.</param>
/// <param name="orientation">Body to world.</param>
/// <param name="bodyAngularVelocity">About the body's own axes, rad/s.</param>
/// <param name="weightTimesArm">Weight times the distance of the centre of mass from the point, N m.</param>
public sealed class HeavyTop(Double3 principalInertia, DoubleQuaternion orientation, Double3 bodyAngularVelocity, double weightTimesArm)
{
    public DoubleQuaternion Orientation { get; private set; } = orientation;

    /// <summary>About the body's own axes, rad/s.</summary>
    public Double3 BodyAngularVelocity { get; private set; } = bodyAngularVelocity;

    /// <summary>Where the axis points, in world axes.</summary>
    public Double3 Axis => Orientation.Rotate(new Double3(0, 1, 0));

    /// <summary>Kinetic energy, and potential energy that is zero where the axis is level, J.</summary>
    public double Energy =>
        Double3.Dot(Double3.Scale(principalInertia, BodyAngularVelocity), BodyAngularVelocity) / 2 + weightTimesArm * Axis.Y;

    /// <summary>A disc spun about its axis, which is tilted from +y towards +z and is let go with no velocity of its own.</summary>
    /// <param name="radius">Of the disc, m.</param>
    /// <param name="thickness">Of the disc, m.</param>
    /// <param name="mass">Of the disc, kg.</param>
    /// <param name="arm">From the point to its centre, m.</param>
    /// <param name="spin">About its axis, rad/s.</param>
    /// <param name="tilt">Of its axis from the vertical, rad.</param>
    /// <param name="gravity">Downwards, m/s2.</param>
    public static HeavyTop OfDisc(double radius, double thickness, double mass, double arm, double spin, double tilt, double gravity)
    {
        double across = mass * (3 * radius * radius + thickness * thickness) / 12 + mass * arm * arm;
        return new HeavyTop(new Double3(across, mass * radius * radius / 2, across),
            DoubleQuaternion.FromAxisAngle(new Double3(1, 0, 0), tilt), new Double3(0, spin, 0), mass * gravity * arm);
    }

    /// <summary>
    /// Mean rate of precession of a fast top that is let go, rad/s about +y: the faster it spins the more exactly weight times arm over its angular momentum.
    /// </summary>
    public static double FastPrecession(double weightTimesArm, double axialMoment, double spin) => weightTimesArm / (axialMoment * spin);

    /// <summary>Goes on by a duration, in seconds, in steps of at most another.</summary>
    public void Advance(double duration, double step)
    {
        int count = (int)Math.Ceiling(duration / step - 1e-9);
        for (int i = 0; i < count; ++i)
            Step(duration / count);
    }

    void Step(double h)
    {
        var (q, w) = (Orientation, BodyAngularVelocity);
        var (q1, w1) = Derivative(q, w);
        var (q2, w2) = Derivative(q + q1 * (h / 2), w + w1 * (h / 2));
        var (q3, w3) = Derivative(q + q2 * (h / 2), w + w2 * (h / 2));
        var (q4, w4) = Derivative(q + q3 * h, w + w3 * h);
        Orientation = DoubleQuaternion.Normalize(q + (q1 + q2 * 2 + q3 * 2 + q4) * (h / 6));
        BodyAngularVelocity = w + (w1 + w2 * 2 + w3 * 2 + w4) * (h / 6);
    }

    (DoubleQuaternion, Double3) Derivative(DoubleQuaternion q, Double3 w)
    {
        // The arm is +y of the body, and the weight -y of the world as the body sees it.
        Double3 down = q.RotateBack(new Double3(0, -weightTimesArm, 0));
        var torque = Double3.Cross(Double3.Scale(principalInertia, w), w) + new Double3(down.Z, 0, -down.X);
        return (q * new DoubleQuaternion(w.X, w.Y, w.Z, 0) * .5,
            new Double3(torque.X / principalInertia.X, torque.Y / principalInertia.Y, torque.Z / principalInertia.Z));
    }
}
