namespace BepuPhysics.Constraints;

// What joints make of a blow, in no time: velocities that they allow, from any that are there. Nobody is at a bound then.
readonly unsafe partial struct DirectEquations<TVectors, TNumbers>
{
    /// <summary>Works out the factors of all joints that are not held.</summary>
    internal void Factor()
    {
        for (int k = firstNode; k < endNode; ++k)
        {
            if (TNumbers.Any(IsFree(k)))
                Weigh(nodes[k]);
        }
        FactorAll();
    }

    /// <summary>Changes velocities by the least energy of the change, so that rows have what they are after; their impulses are those that do it.</summary>
    internal void Project()
    {
        for (int k = firstNode; k < endNode; ++k)
        {
            for (int i = 0; i < nodes[k].RowCount; ++i)
                rows[nodes[k].FirstRow + i].Impulse = default;
        }
        SolveOnce(TNumbers.All);
    }
}
