namespace BepuPhysics;

/// <summary>Which of 32 layers a collidable is in, and which it meets. Two collide where each meets a layer that the other is in.</summary>
/// <param name="Is">A bit for each layer that the collidable is in.</param>
/// <param name="Meets">A bit for each layer that it meets.</param>
/// <remarks>The usual value is <see cref="Everything"/>. The <c>default</c> of the struct is in no layer and meets nothing.</remarks>
public readonly record struct CollisionLayers(uint Is, uint Meets)
{
    /// <summary>In all layers, and meets all: what every collidable is until it is given another value.</summary>
    public static CollisionLayers Everything => new(uint.MaxValue, uint.MaxValue);

    /// <summary>In no layer, and meets none: neither contacts nor queries with layers find it.</summary>
    public static CollisionLayers Nothing => default;

    /// <summary>Whether each of two meets a layer that the other is in.</summary>
    public static bool MayMeet(CollisionLayers a, CollisionLayers b) => (a.Is & b.Meets) != 0 && (b.Is & a.Meets) != 0;
}
