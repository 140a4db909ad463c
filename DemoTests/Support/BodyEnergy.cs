using System.Numerics;
using BepuPhysics;
using BepuUtilities;

namespace DemoTests.Support;

/// <summary>Energy of bodies, J.</summary>
static class BodyEnergy
{
    /// <summary>Of motion and height of a body that is moved and turned.</summary>
    /// <param name="body">The body.</param>
    /// <param name="gravity">How fast it would fall, m/s2.</param>
    public static double Of(BodyReference body, double gravity)
    {
        body.ComputeInverseInertia(out var inverse);
        var momentum = Symmetric3x3.Invert(inverse) * body.Velocity.Angular;
        return (.5 * body.Velocity.Linear.LengthSquared() + gravity * body.Pose.Position.Y) / body.LocalInertia.InverseMass +
            .5 * Vector3.Dot(momentum, body.Velocity.Angular);
    }
}
