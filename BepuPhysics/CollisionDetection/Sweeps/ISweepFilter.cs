namespace BepuPhysics.CollisionDetection;

/// <summary>Chooses which children of two swept shapes are tested. Called on the thread that asked, in no particular order.</summary>
public interface ISweepFilter
{
    /// <summary>Whether two children are to be tested; asked only where one of the shapes at least is made of children.</summary>
    /// <param name="childA">Number of A's convex piece; zero for a shape without children.</param>
    /// <param name="childB">Number of B's convex piece; zero for a shape without children.</param>
    bool AllowTest(int childA, int childB);
}
