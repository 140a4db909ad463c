using System;
using BepuPhysics.Constraints.Contact;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>A greatest speed of recovery has a lever in its last bits, whatever a game has chosen for it.</summary>
public class FaceLeverTests
{
    const int Bits = 31;

    [Theory]
    [InlineData(0f), InlineData(float.Epsilon), InlineData(1e-38f), InlineData(1.3f), InlineData(1.9999999f), InlineData(2f)]
    [InlineData(float.MaxValue), InlineData(float.PositiveInfinity)]
    public void Any_speed_says_any_lever(float recovery)
    {
        for (byte code = 0; code <= Bits; ++code)
        {
            var written = FaceLever.Write(recovery, code);
            Assert.Equal(code, BitConverter.SingleToInt32Bits(written) & Bits);
            // Five bits of 24, or what is nothing beside any speed.
            var most = Math.Min(recovery, float.MaxValue);
            Assert.InRange(written, most * (1 - 4e-6) - 1e-43, most * (1 + 4e-6) + 1e-43);
        }
    }

    [Fact]
    public void Nothing_may_have_a_sign() => Assert.Equal(9, BitConverter.SingleToInt32Bits(FaceLever.Write(BitConverter.Int32BitsToSingle(1 << 31), 9)));

    [Theory]
    [InlineData(0f, 1), InlineData(.46f, 1), InlineData(2 / 3f, 11), InlineData(1f, 28), InlineData(5f, 31), InlineData(float.PositiveInfinity, 31)]
    public void Levers_are_said_in_fiftieths(float lever, byte code) => Assert.Equal(code, FaceLever.Code(lever));
}
