using System;

namespace BepuPhysics;

/// <summary>Doubles as floats that are on one side of them.</summary>
static class Rounded
{
    /// <summary>The greatest float that is not above a value.</summary>
    public static float Down(double value)
    {
        var rounded = (float)value;
        return rounded > value ? MathF.BitDecrement(rounded) : rounded;
    }

    /// <summary>The least float that is not below a value.</summary>
    public static float Up(double value)
    {
        var rounded = (float)value;
        return rounded < value ? MathF.BitIncrement(rounded) : rounded;
    }
}
