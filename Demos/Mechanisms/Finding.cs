namespace Demos.Mechanisms;

/// <summary>Something that must be true of a machine: a figure that lies between two others.</summary>
/// <param name="What">What it is, with its unit.</param>
/// <param name="Figure">What was measured.</param>
/// <param name="Least">It may not be below this.</param>
/// <param name="Most">It may not be above this.</param>
readonly record struct Finding(string What, double Figure, double Least, double Most)
{
    /// <summary>Whether it is true; what is no number is not.</summary>
    public bool Holds => Figure >= Least && Figure <= Most;
}
