namespace Benchmarks.Marked;

/// <summary>Where balls of .1 m are that may be marked as continuous.</summary>
public enum MarkedScene
{
    /// <summary>In a closed room, one for each 10 m^3, at 150 m/s: they meet each other and the walls again and again.</summary>
    Room,
    /// <summary>As in the room, among as many posts as there are balls.</summary>
    Posts,
    /// <summary>In a bin that they have been poured into.</summary>
    Heap,
}
