using System.Numerics;

namespace BepuPhysics.Collidables;

/// <summary>Gives triangles one after the other.</summary>
public interface ITriangleSource
{
    /// <summary>The next triangle.</summary>
    /// <param name="a">First corner, m.</param>
    /// <param name="b">Second corner, m.</param>
    /// <param name="c">Third corner, m.</param>
    /// <returns>Whether there was one more.</returns>
    bool GetNextTriangle(out Vector3 a, out Vector3 b, out Vector3 c);
}
