namespace BepuPhysics.Trees;

/// <summary>Receives pairs of leaves whose boxes overlap or touch.</summary>
public interface IOverlapHandler
{
    /// <summary>Called on the querying thread, once for each pair. Within one tree <paramref name="indexA"/> is below
    /// <paramref name="indexB"/>.</summary>
    void Handle(int indexA, int indexB);
}
