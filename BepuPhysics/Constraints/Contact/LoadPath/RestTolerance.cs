using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Velocity of a body's contacts after the warm start up to which the body is at rest and hands nothing down.</summary>
/// <param name="part">Part of it that is taken: zero where nothing is small enough.</param>
/// <param name="dt">Length of a substep, s.</param>
readonly struct RestTolerance(float part, float dt)
{
    // Velocity left after the warm start, per that from outside, from which on an island is worked on.
    const float LeastResidual = 0.02f;
    // The same, per that of a fall by the distance from a body's centre to its contacts, as strong gravity and small bodies make the first great for it:
    // the velocity that a fall of some twenty-millionth of the body's size would give.
    const float LeastFall = 3e-4f;

    /// <summary>The tolerance of a body.</summary>
    /// <param name="gain">Velocity that the integration has added, m/s.</param>
    /// <param name="radius">Greatest distance of a contact from the centre, m.</param>
    internal float Of(float gain, float radius) => part * MathHelper.Min(LeastResidual * gain, LeastFall * MathF.Sqrt(gain / dt * radius));

    /// <inheritdoc cref="Of(float, float)"/>
    internal Vector<float> Of(Vector<float> gain, Vector<float> radius) => new Vector<float>(part) * Wide.Min(
        new Vector<float>(LeastResidual) * gain, new Vector<float>(LeastFall) * Vector.SquareRoot(gain / new Vector<float>(dt) * radius));
}
