using System;
using BepuUtilities;

namespace BepuPhysics.Characters;

/// <summary>What a game has set of a character, before a step uses it.</summary>
static class CharacterChecks
{
    /// <summary>Throws where a character cannot be moved as it says.</summary>
    public static void Refuse(in CharacterController character)
    {
        Refuse(!(MathF.Abs(Exact.LengthSquared(character.LocalUp) - 1) < 1e-3f), character, "LocalUp must have unit length, not", character.LocalUp);
        Refuse(!float.IsFinite(Exact.LengthSquared(character.ViewDirection)), character, "ViewDirection must be finite, not", character.ViewDirection);
        Refuse(!float.IsFinite(Exact.Dot(character.TargetVelocity, character.TargetVelocity)), character, "TargetVelocity must be finite, not",
            character.TargetVelocity);
        RefuseNegative(character.JumpVelocity, character, nameof(character.JumpVelocity));
        RefuseNegative(character.MaximumHorizontalForce, character, nameof(character.MaximumHorizontalForce));
        RefuseNegative(character.MaximumVerticalForce, character, nameof(character.MaximumVerticalForce));
        RefuseNegative(character.MaximumAirForce, character, nameof(character.MaximumAirForce));
        RefuseNegative(character.MaximumStepHeight, character, nameof(character.MaximumStepHeight));
        Refuse(!(character.CosMaximumSlope is > 0 and <= 1), character, "CosMaximumSlope must be above 0 and at most 1, not", character.CosMaximumSlope);
        Refuse(!float.IsFinite(character.MinimumSupportDepth), character, "MinimumSupportDepth must be finite, not", character.MinimumSupportDepth);
        Refuse(!float.IsFinite(character.MinimumSupportContinuationDepth), character, "MinimumSupportContinuationDepth must be finite, not",
            character.MinimumSupportContinuationDepth);
    }

    static void RefuseNegative(float value, in CharacterController character, string name)
    {
        if (!(value >= 0 && float.IsFinite(value)))
            throw new InvalidOperationException($"The character of {character.BodyHandle}: {name} must be finite and not negative, not {value}.");
    }

    // Text is only made where it is needed.
    static void Refuse<T>(bool isWrong, in CharacterController character, string what, T value)
    {
        if (isWrong)
            throw new InvalidOperationException($"The character of {character.BodyHandle}: {what} {value}.");
    }
}
