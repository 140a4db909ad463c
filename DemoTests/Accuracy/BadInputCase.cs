using System;
using System.Collections.Generic;
using System.Linq;

namespace DemoTests.Accuracy;

/// <summary>One thing that a game must not be able to do.</summary>
/// <param name="Name">What is wrong, and where it is handed in.</param>
/// <param name="Words">The refusal's message must hold one of these: it names the argument.</param>
/// <param name="Attempt">Does it.</param>
sealed record BadInputCase(string Name, string[] Words, Action<BadInputWorld> Attempt)
{
    /// <summary>Tries it on a world with healthy bodies; says what is wrong with the engine's answer, or null.</summary>
    public string? Judge()
    {
        using var world = new BadInputWorld();
        return Try(world) ?? (world.Future().SequenceEqual(BadInputWorld.UndisturbedFuture)
            ? null
            : "the steps after the refused call differ from those without it");
    }

    /// <summary>As <see cref="Judge"/>, but without looking at the steps after it.</summary>
    public string? Try(BadInputWorld world)
    {
        ulong before = world.Hash();
        try
        {
            Attempt(world);
        }
        catch (ArgumentException refusal)
        {
            if (!Words.Any(word => refusal.Message.Contains(word, StringComparison.OrdinalIgnoreCase)))
                return $"the message names none of [{string.Join(", ", Words)}]: {refusal.Message}";
            return world.Hash() == before ? null : "the refused call has changed the world";
        }
#pragma warning disable CA1031 // Whatever else is thrown is a finding.
        catch (Exception other)
        {
            return $"threw {other.GetType().Name} instead of an ArgumentException: {other.Message}";
        }
#pragma warning restore CA1031
        return "was accepted";
    }
}

/// <summary>Collects cases: every bad value of every argument at every entry that takes it.</summary>
sealed class BadInputList
{
    /// <summary>Never a number of anything.</summary>
    public static readonly float[] NotFinite = [float.NaN, float.PositiveInfinity, float.NegativeInfinity];

    /// <summary>Finite, but its square is not.</summary>
    public const float Huge = 1e30f;

    /// <summary>Bad for a quantity that may have any sign and may be zero.</summary>
    public static readonly float[] NotReasonable = [.. NotFinite, Huge, -Huge];

    /// <summary>Bad for a quantity that must be above zero.</summary>
    public static readonly float[] NotPositive = [.. NotFinite, Huge, 0, -1];

    readonly Dictionary<string, BadInputCase> cases = [];

    public IReadOnlyDictionary<string, BadInputCase> Cases => cases;

    public void Add(string name, string[] words, Action<BadInputWorld> attempt) => cases.Add(name, new(name, words, attempt));

    public void Add(string name, string[] words, float[] values, Action<BadInputWorld, float> attempt)
    {
        foreach (float value in values)
            Add(FormattableString.Invariant($"{name} = {value}"), words, world => attempt(world, value));
    }
}
