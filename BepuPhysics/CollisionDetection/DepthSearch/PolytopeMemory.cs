using System.Runtime.CompilerServices;

namespace BepuPhysics.CollisionDetection;

/// <summary>Where an <see cref="ExpandingPolytope"/> lives: on the stack, about 20 KB. Nothing of it needs to be cleared.</summary>
// Faces by components, so that a vector holds one component of several faces. What is behind the last face may be read and written.
unsafe struct PolytopeMemory
{
    /// <summary>Greatest number of vertices: two words of a bit each.</summary>
    public const int VertexCapacity = 128;
    /// <summary>A closed surface of triangles has twice as many faces as vertices, less four; and what a vector writes behind them.</summary>
    public const int FaceCapacity = 2 * VertexCapacity + Behind;
    const int HorizonCapacity = VertexCapacity + Behind;
    // Doubles of a vector, and the first vertex of the horizon once more.
    const int Behind = 5;

    [InlineArray(VertexCapacity)]
    public struct VertexArray
    {
        PolytopeVertex first;
    }

    public fixed double NormalX[FaceCapacity];
    public fixed double NormalY[FaceCapacity];
    public fixed double NormalZ[FaceCapacity];
    /// <summary>Height of the plane over the origin; infinite for a face without an area, which nothing can be over.</summary>
    public fixed double Offset[FaceCapacity];
    /// <summary>The same, or infinite for a face that need not be looked at any more.</summary>
    public fixed double Priority[FaceCapacity];
    /// <summary>Vertices, counterclockwise seen from outside: a byte each.</summary>
    public fixed uint Corners[FaceCapacity];
    /// <summary>By vertex: the vertices to which edges of removed faces lead from there, a bit each.</summary>
    public fixed ulong Edges[2 * VertexCapacity];
    /// <summary>Numbers of the faces that go, ascending.</summary>
    public fixed short Removed[FaceCapacity];
    public fixed byte Horizon[HorizonCapacity];
    /// <summary>By vertex: the next one around the horizon.</summary>
    public fixed byte NextOnHorizon[256];
    public VertexArray Vertices;
}
