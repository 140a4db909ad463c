using System;

namespace BepuPhysics.Collidables;

/// <summary>Numbers of what the children of a compound consist of, behind the numbers of the compound's own.</summary>
/// <remarks>
/// The numbers that there are, are shared out evenly: each child has as many, whatever it needs of them. So a number says by itself which child it belongs to.
/// Nothing is counted or kept, and nothing goes stale when children are changed in place.
/// </remarks>
/// <param name="own">Numbers that are the compound's own.</param>
/// <param name="childCount">Number of children, at least one.</param>
readonly struct PieceNumbers(int own, int childCount)
{
    readonly int own = own;

    /// <summary>How many numbers each child has.</summary>
    public int PerChild { get; } = (int.MaxValue - own) / childCount;

    /// <summary>Number of a part of a child.</summary>
    /// <param name="child">Number of the child.</param>
    /// <param name="inner">Number of its part, as the child itself has it.</param>
    /// <exception cref="InvalidOperationException">The child has more parts than there are numbers for.</exception>
    public int Of(int child, int inner)
    {
        // Looked at when the compound is added; the child may have been replaced in place since.
        if ((uint)inner >= (uint)PerChild)
            throw new InvalidOperationException($"Child {child} of a compound has a part of number {inner}: there are {PerChild} numbers for each child.");
        return own + child * PerChild + inner;
    }

    /// <summary>Which part of which child has a number that is not the compound's own.</summary>
    public (int Child, int Inner) Find(int number) => Math.DivRem(number - own, PerChild);
}
