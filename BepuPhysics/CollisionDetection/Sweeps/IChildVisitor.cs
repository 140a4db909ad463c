using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>What is asked of the children of a container, near ones first.</summary>
/// <typeparam name="TTest">What is asked of their boxes.</typeparam>
interface IChildVisitor<TTest> where TTest : struct, IReachTest
{
    /// <summary>Makes the test of boxes.</summary>
    /// <param name="root">What is below the root of the container.</param>
    /// <param name="count">Number of boxes.</param>
    TTest CreateTest(Buffer<NodeChild> root, int count);

    /// <summary>What is farther away is of no interest.</summary>
    float Maximum { get; }

    /// <summary>Whether nothing more is of interest.</summary>
    bool IsDone { get; }

    /// <summary>Whether a child is of interest.</summary>
    bool Allows(int index);

    /// <summary>Receives a child that is.</summary>
    void Visit(int index, in ContainerChild child);
}
