namespace BepuPhysics.Collidables;

/// <summary>What can be asked of a batch of convex shapes without knowing their type.</summary>
public interface IConvexShapeBatch
{
    /// <summary>Inverse mass and inverse inertia of a shape of the batch; see <see cref="IConvexShape.ComputeInertia"/>.</summary>
    /// <param name="shapeIndex">Index of the shape in the batch.</param>
    /// <param name="mass">Mass, kg.</param>
    BodyInertia ComputeInertia(int shapeIndex, float mass);
}
