using System;

namespace Demos.References;

/// <summary>
/// Counts reversals of a signal. A reversal counts once the signal is past half of its first magnitude, so noise around zero does not.
/// </summary>
public struct FlipCounter(double start)
{
    readonly double threshold = Math.Abs(start) / 2;
    int sign = Math.Sign(start);

    public int Count { get; private set; }

    public void Observe(double value)
    {
        if (value * sign < -threshold)
        {
            sign = -sign;
            ++Count;
        }
    }
}
