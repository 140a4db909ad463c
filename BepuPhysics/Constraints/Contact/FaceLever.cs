using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>
/// The lever of friction against turning where a patch is no single face: mean distance of what presses from its middle, over that of the contacts.
/// </summary>
// A patch has no room for one more number, which few have. The last bits of its greatest speed of recovery say it: 4e-6 of that speed at most.
static class FaceLever
{
    /// <summary>Says nothing: the contacts are the corners of one face.</summary>
    public const byte OfOneFace = 0;

    const int Bits = 31;
    const float OfDisc = 2 / 3f;
    // In steps of a fiftieth; from less than that of a triangle, .46, to more than 1, that of feet which have no size.
    const float Before = 0.44f;
    const float Step = 0.02f;

    /// <summary>The number that says a lever; never that of one face.</summary>
    public static byte Code(float lever) => (byte)MathHelper.Max(1, MathHelper.Min((lever - Before) * (1 / Step) + 0.5f, Bits));

    /// <summary>A greatest speed of recovery that says a lever too: of what is never pushed out it is next to nothing.</summary>
    public static float Write(float recovery, byte code) => recovery >= 0
        ? BitConverter.Int32BitsToSingle((BitConverter.SingleToInt32Bits(MathHelper.Min(recovery, float.MaxValue)) & int.MaxValue & ~Bits) | code)
        : recovery;

    /// <summary>Reads what is said of some patches, and leaves those alone that are one face.</summary>
    /// <param name="recovery">Their greatest speeds of recovery.</param>
    /// <param name="lever">Their levers.</param>
    /// <param name="elongation">How long they are: what is not one face is not like a line, however long.</param>
    /// <param name="rim">By how much each is a rim that bears alone: 0 of what has the lever of a disc, or less; 1 of a ring.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Read(Vector<float> recovery, ref Vector<float> lever, ref Vector<float> elongation, out Vector<float> rim)
    {
        rim = Vector<float>.Zero;
        var code = Vector.AsVectorInt32(recovery) & new Vector<int>(Bits);
        if (code == Vector<int>.Zero)
            return;
        var isOneFace = Vector.Equals(code, Vector<int>.Zero);
        var said = Vector.ConvertToSingle(code) * new Vector<float>(Step) + new Vector<float>(Before);
        var beyond = (said - new Vector<float>(OfDisc)) * new Vector<float>(1 / (1 - OfDisc));
        lever = Wide.Select(isOneFace, lever, said);
        elongation = Wide.Mask(isOneFace, elongation);
        rim = Wide.Mask(~isOneFace, Wide.Max(rim, Wide.Min(beyond, Vector<float>.One)));
    }
}
