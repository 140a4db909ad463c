using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>What stands on the supports of a body, with the body itself: its mass, where that is, how it moves and what pulls at it.</summary>
struct StandingLoad
{
    float mass;
    Vector3 moment, momentum, pull;

    /// <summary>Adds a body.</summary>
    internal void Add(float bodyMass, Vector3 position, Vector3 velocity, Vector3 acceleration)
    {
        mass += bodyMass;
        moment += position * bodyMass;
        momentum += velocity * bodyMass;
        pull += acceleration * bodyMass;
    }

    /// <summary>Adds what stands on the body.</summary>
    internal void Add(in StandingLoad other)
    {
        mass += other.mass;
        moment += other.moment;
        momentum += other.momentum;
        pull += other.pull;
    }

    /// <summary>
    /// Whether it would come to rest over the contacts of some supports if it turned about them as a pendulum that stands on its head: where it is, and the
    /// way that its velocity takes it until it is slowed down to nothing, are within their hull.
    /// </summary>
    /// <param name="supports">All that its body rests on.</param>
    /// <param name="upper">Centre of that body.</param>
    internal readonly bool IsOver(ReadOnlySpan<LoadSupport> supports, Vector3 upper)
    {
        var down = pull * (1 / mass);
        var strength = Exact.Length(down);
        if (!(strength > 0))
            return false;
        down *= 1 / strength;
        var goal = moment * (1 / mass) - upper;
        float height = 0;
        foreach (ref readonly var support in supports)
            height = MathHelper.Max(height, Exact.Dot(support.Center - goal, down));
        goal += momentum * (MathF.Sqrt(height / strength) / mass);
        // It is outside if some line through it, seen along what pulls, has all contacts on one side: if any has, one through a contact has.
        foreach (ref readonly var support in supports)
        {
            for (int i = 0; i < support.Count; ++i)
            {
                if (AreOnOneSide(supports, goal, Exact.Cross(down, support.Arms[i] - goal)))
                    return false;
            }
        }
        return true;
    }

    static bool AreOnOneSide(ReadOnlySpan<LoadSupport> supports, Vector3 goal, Vector3 across)
    {
        bool before = false, behind = false;
        foreach (ref readonly var support in supports)
        {
            for (int i = 0; i < support.Count; ++i)
            {
                var side = Exact.Dot(support.Arms[i] - goal, across);
                before |= side > 0;
                behind |= side < 0;
            }
        }
        return !(before && behind);
    }

    /// <summary>Shares it out among supports as they would bear it if it were at rest; each bears its part where its contacts bear it.</summary>
    /// <param name="supports">All that its body rests on; what they had is lost.</param>
    /// <param name="upper">Centre of that body.</param>
    /// <param name="radius">Greatest distance of a contact from it, m.</param>
    /// <param name="parts">As many, to which what each bears is written.</param>
    /// <returns>Whether anything bears it.</returns>
    internal readonly bool ShareOut(Span<LoadSupport> supports, Vector3 upper, float radius, Span<StandingLoad> parts)
    {
        foreach (ref var support in supports)
        {
            support.Before = default;
            support.FrictionBefore = default;
            support.TwistBefore = 0;
        }
        var center = moment * (1 / mass);
        LoadTransfer.Find(supports, pull, Exact.Cross(center - upper, pull), radius);
        float total = 0;
        foreach (ref var support in supports)
            total += Sum(support.After, support.Count);
        if (!(total > 0))
            return false;
        var down = Exact.Normalize(pull);
        for (int i = 0; i < supports.Length; ++i)
        {
            ref var support = ref supports[i];
            var load = Sum(support.After, support.Count);
            Vector3 point = default;
            for (int j = 0; j < support.Count; ++j)
                point += support.Arms[j] * support.After[j];
            point = upper + (load > 0 ? point * (1 / load) : support.Center);
            // As high as it is.
            point += down * Exact.Dot(center - point, down);
            var share = load / total;
            parts[i] = new() { mass = mass * share, moment = point * (mass * share), momentum = momentum * share, pull = pull * share };
        }
        return true;
    }

    static float Sum(FourFloats values, int count)
    {
        float sum = 0;
        for (int i = 0; i < count; ++i)
            sum += values[i];
        return sum;
    }
}
