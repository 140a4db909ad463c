using System.Numerics;

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

/// <summary>A question to boxes that can be asked bit by bit, by boxes around what is near enough.</summary>
interface IReachTest : IBoxTest
{
    /// <summary>How many times as far the next bit goes as the one before: as many as it costs to begin anew.</summary>
    static abstract float Growth { get; }

    /// <summary>How much farther away, as <see cref="IBoxTest.Meets"/> has it, something is that is so much farther away in metres.</summary>
    /// <param name="length">The length, m.</param>
    float Farther(float length);

    /// <summary>Greatest extent of what asks, m.</summary>
    float Extent { get; }

    /// <summary>A box that all boxes overlap that are farther away than one bound and no farther than another, and are not met before.</summary>
    /// <param name="from">The bound below; at least zero.</param>
    /// <param name="to">The bound above.</param>
    /// <param name="min">Lower corner, m.</param>
    /// <param name="max">Upper corner, m.</param>
    void Reach(float from, float to, out Vector3 min, out Vector3 max);
}
