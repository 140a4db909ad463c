using System;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>What is remembered of a joint to choose how it is solved. All zeros of one that never needed anything.</summary>
// A joint asks to be solved at once when it is off by more than a part of its size while it is swept over; and goes on asking as long as the load that it bears
// would bring it there. By sweeps it is a spring of angular frequency w, which under a force F gives way by K F / w^2, with K one over its effective mass:
// what it would be off by is known without trying. So what bears a load is not let down time and again to see whether sweeps can hold it.
struct JointNeed
{
    /// <summary>What a joint may be off by, as a part of its size, or in radians.</summary>
    // A body that hangs in a hinge by itself is off by half a thousandth at the default setting, ragdolls in a heap by a hundredth. A double pendulum that is
    // off by half a hundredth at times loses 61 % of its energy in a minute where a hundredth is allowed, and 3 % so.
    internal const float Tolerance = 0.005f;
    /// <summary>The same of a joint whose bodies rest, so that it takes no energy from anything.</summary>
    // Ragdolls that lie in a heap are off by half a hundredth in the median, and by a twentieth at most.
    internal const float TolerantAtRest = 0.05f;
    /// <summary>Part of a tolerance that the load of a joint may be worth for it to be left to the sweeps.</summary>
    internal const float QuietPart = 0.5f;
    // Part of its energy that a joint may take from what turns, in a second: 6 % in a minute.
    const float GreatestLoss = 1e-3f;
    /// <summary>For how long a joint asks after the last reason for it, s; twice as long each time that it asks again soon.</summary>
    internal const float LeastPeriod = 1;
    /// <summary>The longest such time, s.</summary>
    internal const float GreatestPeriod = 16;
    // Time constant of the error with which a joint comes from the sweeps, s. To take it back lifts a load; and small errors of many joints are a long way for
    // what hangs between them: at .15 s a heavy ball is thrown off a bridge.
    const float EaseTime = 0.5f;
    // Time constant of what is beyond that error, s: about that of the sweeps at the default setting.
    const float BeyondTime = 0.02f;
    // What an error is at most that goes in that time, as a part of the size of the bodies or in radians; one of four times that takes twice as long.
    const double LargeError = 0.02;
    // Part of the size of bodies that is no way for them to go within a radian of their turn.
    const float SmallError = 0.01f;
    // After which a five hundredth is left of it: exp(-2.5^2).
    const float EaseEnd = 2.5f * EaseTime;

    /// <summary>Speed with which the gap of a joint that is swept over may turn, as a part of that of its bodies about it.</summary>
    /// <param name="frequencyDt">Angular frequency of the joint, times the length of the substep.</param>
    /// <param name="dt">Length of the substep, s.</param>
    // With w the frequency and b = w / (w h + 2) the rate at which it corrects, a joint of effective mass M that is off by C pulls with M w^2 C along C. Where
    // its gap turns at u it pulls against that as well, with u / b as much, and takes the energy M w^2 (C u)^2 / b in a second. Of what the bodies have,
    // M v^2 / 2, that is 2 w (w h + 2) (C u)^2 / v^2.
    internal static float GreatestSlip(float frequencyDt, float dt) => MathF.Sqrt(GreatestLoss * dt / (2 * frequencyDt * (frequencyDt + 2)));

    /// <summary>Place of the joint in the order in which joints were added, from 1; 0 where there is none.</summary>
    public long Number;
    /// <summary>Time for which it asks yet, s; 0 where it does not.</summary>
    public float Asks;
    /// <summary>Time for which it asked the last time, s; 0 where it never did.</summary>
    public float Period;
    /// <summary>Time since it asked, s.</summary>
    public float Calm;
    /// <summary>Time for which it may not ask, s: its structure cannot be solved at once.</summary>
    public float Refused;
    /// <summary>Time for which it is on its way from the sweeps yet, s.</summary>
    public float Eases;
    /// <summary>Time since it began that way, s: longer, where it goes slowly.</summary>
    public float Underway;
    /// <summary>What is to be left on the way of the error along directions with which it came, m.</summary>
    public float Gap;
    /// <summary>The same about axes, rad.</summary>
    public float Turn;

    /// <summary>Least way yet of a gap that it was added with, and closes as sweeps would (JointGap.cs); infinite of a new one, zero of none.</summary>
    public float Closing;

    /// <summary>Whether it closes a gap that it was added with.</summary>
    internal readonly bool Closes => Closing > 0;

    /// <summary>There is a reason to ask.</summary>
    /// <returns>Whether it did not ask before.</returns>
    internal bool Ask()
    {
        var isNew = Asks <= 0;
        if (isNew)
        {
            var isSoon = Period > 0 && Calm <= Period;
            Period = isSoon ? MathHelper.Min(2 * Period, GreatestPeriod) : LeastPeriod;
        }
        Asks = Period;
        return isNew;
    }

    /// <summary>Time passes in which there is no reason to ask, or in which it may not.</summary>
    internal void Rest(float time)
    {
        Refused = MathHelper.Max(Refused - time, 0);
        if (Asks > 0)
        {
            Asks = MathHelper.Max(Asks - time, 0);
            Calm = 0;
        }
        else if (Period > 0)
            Calm = MathHelper.Min(Calm + time, 2 * GreatestPeriod);
    }

    /// <summary>Its structure would take too long to be solved at once: neither it nor another joint of it asks for a time.</summary>
    internal void Refuse() => (Asks, Refused) = (0, GreatestPeriod);

    /// <summary>What stays when the mode becomes another one: how far it is on its way from the sweeps.</summary>
    internal readonly JointNeed Renewed(long number) =>
        new() { Number = number, Eases = Eases, Underway = Underway, Gap = Gap, Turn = Turn, Closing = Closing };

    /// <summary>Begins to go over from the sweeps.</summary>
    internal void Ease() => (Eases, Underway, Gap, Turn) = (EaseEnd, 0, 0, 0);

    /// <summary>Goes a substep further on the way from the sweeps.</summary>
    internal void GoOn(float substepDt, float pace = 1)
    {
        Eases = MathHelper.Max(Eases - pace * substepDt, 0);
        Underway += substepDt;
    }

    /// <summary>Whether it is on its way from the sweeps, and may get there soon: of joints that contradict each other some never do.</summary>
    internal readonly bool IsUnderway => (Eases > 0 || Closes) && Underway < GreatestPeriod;

    /// <summary>How many times as fast an error goes: slower where it is large, and faster if a body of the joint turns.</summary>
    /// <param name="turnSquared">Square of the angular speed of the body that turns fastest, rad2/s2.</param>
    /// <param name="error">The error, as a part of the size of the bodies or in radians: one that is not small is not taken back faster than they move.</param>
    // Long chains are long ways: of fifty links each of which is off by half of its size the last goes by twenty-five sizes, and what it pulls in is thrown.
    // But a gap that turns with a body is a brake: it goes within a radian.
    internal static float PaceOf(float turnSquared, double error) => MathHelper.Max(
        (float)Math.Sqrt(Math.Min(1, LargeError / error)), EaseTime * MathF.Sqrt(turnSquared) * (float)Math.Min(1, SmallError / error));

    /// <summary>How many times as fast an error goes under a load that would open the joint further: never faster.</summary>
    /// <param name="opened">What the sweeps would let it open to under its load, as a part of the error that it came with: more than one.</param>
    /// <param name="error">The error, as a part of the size of the bodies or in radians.</param>
    // To put a joint right that is off by C takes its load times C, which nothing gives back: little where that is the load that opened it, and a part of all
    // motion, about twice that of the size, where what hangs in it has begun to whirl since. So it waits for the load to be less, but for what is small.
    internal static float PaceUnder(double opened, double error) => (float)Math.Max(1 / opened, Math.Min(1, QuietPart * Tolerance / error));

    /// <summary>The error that a joint came with, in parts of what is to be left of it by now.</summary>
    // exp((t / T)^2) as (1 + (t / T)^2 / 64)^64: products are the same everywhere.
    internal readonly double Shrunk
    {
        get
        {
            var t = (double)(EaseEnd - Eases) / EaseTime;
            var power = 1 + t * t / 64;
            for (int i = 0; i < 6; ++i)
                power *= power;
            return power;
        }
    }

    /// <summary>Part of an error that is corrected in a substep.</summary>
    /// <param name="left">What is left of the one that the joint came with: <see cref="Gap"/> or <see cref="Turn"/>; found in the first substep.</param>
    /// <param name="error">Length of the error.</param>
    /// <param name="substepDt">Length of the substep, s.</param>
    /// <param name="pace">How many times as fast the error goes.</param>
    // What is to be left goes with exp(-(t / T)^2): by a rate of 2 t / T^2, which begins with nothing, so that no velocity jumps; the greatest speed is .86 of
    // it over T. What is beyond, be it added by a motion that turns within a substep, goes as sweeps would take it.
    internal readonly double CorrectedPart(ref float left, double error, float substepDt, float pace = 1)
    {
        var t = EaseEnd - Eases;
        left = t > 0 ? left * (1 - MathHelper.Min(1, 2 * t * pace * substepDt / (EaseTime * EaseTime))) : (float)error;
        return error > left ? (1 - left / error) * Math.Min(1, substepDt / BeyondTime) : 0;
    }
}
