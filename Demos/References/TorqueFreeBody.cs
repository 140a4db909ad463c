using System;

namespace Demos.References;

/// <summary>
/// Euler's equations of a rigid body without torque, integrated by the classical Runge-Kutta scheme in double precision.
/// State: attitude q (body to world) and angular velocity w in body axes.
/// I dw/dt = (I w) x w;  dq/dt = q (w, 0) / 2.
/// </summary>
public sealed class TorqueFreeBody(Double3 principalInertia, DoubleQuaternion orientation, Double3 bodyAngularVelocity)
{
    public Double3 PrincipalInertia { get; } = principalInertia;

    public DoubleQuaternion Orientation { get; private set; } = orientation;

    /// <summary>Radians per second about the body's own axes.</summary>
    public Double3 BodyAngularVelocity { get; private set; } = bodyAngularVelocity;

    public double Energy => Double3.Dot(Double3.Scale(PrincipalInertia, BodyAngularVelocity), BodyAngularVelocity) / 2;

    /// <summary>Angular momentum in world axes.</summary>
    public Double3 Momentum => Orientation.Rotate(Double3.Scale(PrincipalInertia, BodyAngularVelocity));

    /// <summary>How often the rotation about the middle axis (body Y) has reversed since the start.</summary>
    public int FlipCount => flips.Count;

    FlipCounter flips = new(bodyAngularVelocity.Y);

    /// <summary>A box's principal moments from its full extents.</summary>
    public static Double3 BoxInertia(double mass, double width, double height, double length) => new Double3(
        height * height + length * length, width * width + length * length, width * width + height * height) * (mass / 12);

    public void Advance(double duration, double step)
    {
        long count = (long)Math.Round(duration / step);
        for (long i = 0; i < count; ++i)
            Step(step);
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
        flips.Observe(BodyAngularVelocity.Y);
    }

    (DoubleQuaternion, Double3) Derivative(DoubleQuaternion q, Double3 w)
    {
        var torque = Double3.Cross(Double3.Scale(PrincipalInertia, w), w);
        return (q * new DoubleQuaternion(w.X, w.Y, w.Z, 0) * .5,
            new Double3(torque.X / PrincipalInertia.X, torque.Y / PrincipalInertia.Y, torque.Z / PrincipalInertia.Z));
    }
}
