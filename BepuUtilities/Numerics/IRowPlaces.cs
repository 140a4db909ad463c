using System.Numerics;

namespace BepuUtilities;

/// <summary>Where the rows of a bundle's lanes are, for gathers and scatters that are compiled for each way to say so.</summary>
// Static, with the places by reference: an instance method that is called through a read-only reference to a type parameter is called on a copy.
public unsafe interface IRowPlaces<TRows> where TRows : unmanaged, IRowPlaces<TRows>
{
    /// <summary>Row of a lane; row 0 for an empty one.</summary>
    /// <param name="places">Where rows are.</param>
    /// <param name="rows">Row 0.</param>
    /// <param name="strideInFloats">Floats from one row to the next: a multiple of eight.</param>
    /// <param name="lane">The lane.</param>
    static abstract float* Row(in TRows places, float* rows, int strideInFloats, int lane);

    /// <summary>One bit per lane, set where nothing is written: empty lanes, and those of rows that are only read.</summary>
    static abstract uint Unwritten(in TRows places);

    /// <summary>Index of each lane's row, with flags as <see cref="Transpose"/> knows them.</summary>
    static abstract Vector<int> Indices(in TRows places);
}
