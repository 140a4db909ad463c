using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>A shape that owns memory of a pool; copies of it look at the same memory.</summary>
public interface IDisposableShape : IShape
{
    /// <summary>Returns the shape's memory; neither it nor any copy may be used any more. Does nothing to a shape without memory.</summary>
    /// <param name="pool">Pool that the memory was taken from.</param>
    void Dispose(BufferPool pool);
}
