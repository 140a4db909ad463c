using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>What every shape type has in common. Shapes are unmanaged structs, kept by value in <see cref="Shapes"/>.</summary>
public interface IShape
{
    /// <summary>Number of the shape type, 0 to 127, unlike that of every other type.</summary>
    static abstract int TypeId { get; }

    /// <summary>Creates the storage of the shapes of this type; called by <see cref="Shapes"/> when the first one is added.</summary>
    /// <param name="pool">Source of the batch's memory.</param>
    /// <param name="initialCapacity">Number of shapes to make room for.</param>
    /// <param name="shapes">The collection that will own the batch; shapes made of other shapes look them up there.</param>
    static abstract ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes);

    /// <summary>Refuses a shape that cannot be simulated; called before a shape is added.</summary>
    /// <exception cref="System.ArgumentException">A size is not finite or outside its range; the message names field and value.</exception>
    void Validate();
}
