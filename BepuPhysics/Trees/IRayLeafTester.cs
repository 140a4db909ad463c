using BepuUtilities.Memory;

namespace BepuPhysics.Trees;

/// <summary>Receives the leaves whose boxes a ray meets.</summary>
public interface IRayLeafTester
{
    /// <summary>Called on the querying thread for a leaf whose box the ray enters before the present maximum; near leaves tend to come
    /// first.</summary>
    /// <param name="leafIndex">Index of the leaf in the tree.</param>
    /// <param name="rayData">The ray.</param>
    /// <param name="maximumT">Length of the ray that is still of interest, in units of its direction; lower it to end the query
    /// sooner.</param>
    /// <param name="pool">The pool that the query was given.</param>
    unsafe void TestLeaf(int leafIndex, RayData* rayData, float* maximumT, BufferPool pool);
}
