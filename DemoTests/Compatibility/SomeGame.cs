namespace DemoTests.Compatibility.SomeGame;

/// <summary>A type that a game calls as the library does one of its own.</summary>
public struct RayHit
{
    /// <summary>How far the ray went, m.</summary>
    public float Distance;
}
