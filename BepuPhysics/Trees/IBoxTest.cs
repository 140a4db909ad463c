namespace BepuPhysics.Trees;

/// <summary>A question to boxes, whose answer is how far away they are: in time, or in length.</summary>
unsafe interface IBoxTest
{
    /// <summary>Whether a box is within a maximum.</summary>
    /// <param name="child">The box.</param>
    /// <param name="maximum">The maximum.</param>
    /// <param name="t">How far away the box is; what is in it is no nearer.</param>
    bool Meets(NodeChild* child, float maximum, out float t);

    /// <summary>The same of both sides of a node.</summary>
    /// <param name="children">The first side, behind which is the second.</param>
    /// <param name="maximum">The maximum.</param>
    /// <param name="tA">How far away the first side is.</param>
    /// <param name="tB">How far away the second side is.</param>
    (bool A, bool B) MeetsBoth(NodeChild* children, float maximum, out float tA, out float tB);
}
