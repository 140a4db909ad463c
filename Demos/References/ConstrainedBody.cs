namespace Demos.References;

/// <summary>A body of <see cref="ConstrainedBodies"/>, at rest.</summary>
/// <param name="Mass">In kg.</param>
/// <param name="PrincipalInertia">About its centre of mass and its own axes, kg m2.</param>
/// <param name="Position">Of its centre of mass.</param>
/// <param name="Orientation">Body to world.</param>
public readonly record struct ConstrainedBody(double Mass, Double3 PrincipalInertia, Double3 Position, DoubleQuaternion Orientation)
{
    /// <summary>A box by its full extents.</summary>
    public static ConstrainedBody Box(double mass, Double3 size, Double3 position, DoubleQuaternion orientation) =>
        new(mass, TorqueFreeBody.BoxInertia(mass, size.X, size.Y, size.Z), position, orientation);
}
