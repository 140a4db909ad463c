using System.Numerics;
using BepuUtilities;

namespace DemoTests.Constraints;

/// <summary>Moves the second of two bodies to where a joint has no error.</summary>
static class Rotations
{
    public static void JoinAnchors(SampleBody[] bodies, Vector3 localA, Vector3 localB) =>
        bodies[1].Position = bodies[0].Position + (Exact.Rotate(localA, bodies[0].Orientation) - Exact.Rotate(localB, bodies[1].Orientation));

    public static void Align(SampleBody[] bodies, Vector3 localA, Vector3 localB)
    {
        // Half way between the axes, twice: a rotation by the angle between them. Two rounds remove the rounding of the first.
        for (int i = 0; i < 2; ++i)
        {
            var a = Exact.Rotate(localA, bodies[0].Orientation);
            var b = Exact.Rotate(localB, bodies[1].Orientation);
            var turn = Exact.Normalize(new Quaternion(Exact.Cross(b, a), 1 + Exact.Dot(a, b)));
            bodies[1].Orientation = Exact.Normalize(Exact.Concatenate(bodies[1].Orientation, turn));
        }
    }
}
