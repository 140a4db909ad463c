namespace Benchmarks.Queries.Shared;

/// <summary>What is asked.</summary>
static class QueryNames
{
    /// <summary>The first that a ray of 10 m hits.</summary>
    public const string FirstHit = "first hit";

    /// <summary>The first 16 that it hits, in order.</summary>
    public const string AllHits = "all hits";

    /// <summary>How many bounds a box of 1 m overlaps.</summary>
    public const string Bounds = "bounds";

    /// <summary>Whether a shape overlaps anything.</summary>
    public const string Overlap = "overlap";

    /// <summary>The contacts that a shape has.</summary>
    public const string Contacts = "contacts";

    /// <summary>What is nearest to a shape within 10 m.</summary>
    public const string Nearest = "nearest";

    /// <summary>Half the width of the box of <see cref="Bounds"/>, m.</summary>
    public const float HalfWidth = .5f;

    /// <summary>Room for hits in order.</summary>
    public const int HitCount = 16;

    /// <summary>Reach of <see cref="Nearest"/>, m.</summary>
    public const float Reach = 10;
}
