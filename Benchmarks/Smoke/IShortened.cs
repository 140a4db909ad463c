namespace Benchmarks.Smoke;

/// <summary>A class of benchmarks that do more work per call than it takes to see that they run.</summary>
interface IShortened
{
    /// <summary>Called before the setup when nothing is measured: reduces the work to the least that goes through all the code.</summary>
    void Shorten();
}
