using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Trees;

public unsafe partial struct Tree
{
    /// <summary>Moves all boxes to where they are seen from a new origin.</summary>
    // Rounded outwards, so that each still contains what it contained. What is rounded in one direction keeps its order: a box around others is around them
    // still, and as tight as it was.
    internal readonly void ShiftOrigin(Vector3 shift)
    {
        for (int i = 0; i < 2 * NodeCount; ++i)
        {
            ref var child = ref Children[i];
            if (child.LeafCount == 0)
                continue;
            child.Min = new(Below(child.Min.X, shift.X), Below(child.Min.Y, shift.Y), Below(child.Min.Z, shift.Z));
            child.Max = -new Vector3(Below(-child.Max.X, -shift.X), Below(-child.Max.Y, -shift.Y), Below(-child.Max.Z, -shift.Z));
        }
    }

    // The difference of two floats is exact in double precision, or is off by far less than a float can tell. What has no end has none.
    static float Below(float value, float shift) => MathHelper.Max(Rounded.Down((double)value - shift), -float.MaxValue);
}
