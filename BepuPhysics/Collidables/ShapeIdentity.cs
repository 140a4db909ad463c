namespace BepuPhysics.Collidables;

/// <summary>Names the shape of a collidable for as long as it exists: a later one in the same slot has another generation.</summary>
/// <param name="Shape">Where the shape is.</param>
/// <param name="Generation">Number of shapes of its type that were added up to it.</param>
readonly record struct ShapeIdentity(TypedIndex Shape, int Generation);
