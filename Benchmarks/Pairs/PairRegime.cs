namespace Benchmarks.Pairs;

/// <summary>How the pairs of a case are placed.</summary>
enum PairRegime
{
    /// <summary>Random orientations; overlap of up to 4 % of the smaller size.</summary>
    Shallow,

    /// <summary>
    /// Sides that lie on each other; overlap of up to 1 % of the smaller size, or so much between two triangles. Half of the pairs are
    /// tilted by up to 2 mrad, half not at all.
    /// </summary>
    Resting,

    /// <summary>Random orientations, and 0.3 to 0.7 of the distance at which the shapes would touch.</summary>
    Deep,

    /// <summary>Random orientations; apart by 0.1 to 0.9 of the margin.</summary>
    Apart,

    /// <summary>Random orientations; apart by up to three times the margin, so that there are no contacts.</summary>
    Missed,
}
