using System;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>A convex hull as indices: which of the given points are its vertices, and which vertices its faces have.</summary>
public struct HullData
{
    /// <summary>For each vertex of the hull, the index of the point it is.</summary>
    public Buffer<int> OriginalVertexMapping;
    /// <summary>Vertices of all faces, one face after the other, each counterclockwise seen from outside; indices into the mapping.</summary>
    public Buffer<int> FaceVertexIndices;
    /// <summary>Where the vertices of each face begin in <see cref="FaceVertexIndices"/>; as long as there are faces.</summary>
    public Buffer<int> FaceStartIndices;

    /// <summary>The vertices of a face; a view.</summary>
    /// <param name="faceIndex">Number of the face.</param>
    /// <param name="vertexIndices">Indices into <see cref="OriginalVertexMapping"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such face.</exception>
    public readonly void GetFace(int faceIndex, out Buffer<int> vertexIndices)
    {
        if ((uint)faceIndex >= (uint)FaceStartIndices.Length)
            throw new ArgumentOutOfRangeException(nameof(faceIndex), faceIndex, $"The hull has {FaceStartIndices.Length} faces.");
        var start = FaceStartIndices[faceIndex];
        var end = faceIndex + 1 < FaceStartIndices.Length ? FaceStartIndices[faceIndex + 1] : FaceVertexIndices.Length;
        vertexIndices = FaceVertexIndices.Slice(start, end - start);
    }

    /// <summary>Returns the memory.</summary>
    /// <param name="pool">Pool that the memory was taken from.</param>
    public void Dispose(BufferPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        pool.ReturnIfTaken(ref OriginalVertexMapping);
        pool.ReturnIfTaken(ref FaceVertexIndices);
        pool.ReturnIfTaken(ref FaceStartIndices);
    }
}
