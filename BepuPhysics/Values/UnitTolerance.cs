using System;

namespace BepuPhysics;

/// <summary>How far a squared length may be from one and still be that of a unit vector or quaternion, by who has written it.</summary>
/// <remarks>A length is off by half of these, relatively, and so is what is scaled by it. Rounding of a normalised float is 1e-7.</remarks>
static class UnitTolerance
{
    /// <summary>
    /// What a game describes. Wide enough for code that normalises in float and rounds on the way, narrow enough to find what was never
    /// normalised.
    /// </summary>
    public const float Described = 1e-2f;

    /// <summary>Orientations that the collision batcher is handed: those of bodies, which the integrator keeps normalised.</summary>
    public const float Tested = 1e-3f;

    /// <summary>Orientations that turn normals: those of children of compounds, of statics and of bodies that were just described.</summary>
    public const float Combined = 2e-5f;

    /// <summary>Orientations that a game has written into a body's memory: beyond, they are no rotations any more, and the body is stopped.</summary>
    public const float Sound = 0.5f;

    /// <summary>Whether a squared length is one, to within a tolerance; NaN is not.</summary>
    public static bool Holds(float lengthSquared, float tolerance) => MathF.Abs(lengthSquared - 1) <= tolerance;
}
