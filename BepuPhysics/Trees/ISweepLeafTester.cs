namespace BepuPhysics.Trees;

/// <summary>Receives the leaves whose boxes a moving box meets.</summary>
public interface ISweepLeafTester
{
    /// <summary>Called on the querying thread for a leaf whose box is met before the present maximum; near leaves tend to come
    /// first.</summary>
    /// <param name="leafIndex">Index of the leaf in the tree.</param>
    /// <param name="maximumT">Length of the sweep that is still of interest, in units of its direction; lower it to end the query
    /// sooner.</param>
    void TestLeaf(int leafIndex, ref float maximumT);
}
