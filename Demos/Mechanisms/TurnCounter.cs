using System;
using BepuPhysics;

namespace Demos.Mechanisms;

/// <summary>The angle of a body about Z, which goes on from one turn to the next.</summary>
sealed class TurnCounter(BodyReference body)
{
    double last = Now(body);

    /// <summary>Radians since the beginning.</summary>
    public double Angle { get; private set; }

    public void Observe()
    {
        double now = Now(body);
        Angle += Math.IEEERemainder(now - last, 2 * Math.PI);
        last = now;
    }

    static double Now(BodyReference body) => 2 * Math.Atan2(body.Pose.Orientation.Z, body.Pose.Orientation.W);
}
