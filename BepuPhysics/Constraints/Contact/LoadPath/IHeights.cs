using System;

namespace BepuPhysics.Constraints.Contact;

/// <summary>How high each body is, in any unit.</summary>
interface IHeights
{
    /// <summary>Height of a body of the active set.</summary>
    float Of(int body);
}

/// <summary>How what rests moves along with what moves.</summary>
interface IFloors
{
    /// <summary>Whether two kinematic bodies move as one.</summary>
    bool MoveAlike(int kinematic, int other);

    /// <summary>Whether a body rests to who moves along with a kinematic one.</summary>
    bool RestsOn(int body, int kinematic);

    /// <summary>Whether a body may sway: to a kinematic one along with which it moves, or, where that is negative, to what does not move.</summary>
    bool Sways(int body, int kinematic);

    /// <summary>Takes the upper body of a support into the load of a column, from the top down, and says whether it stays over the support.</summary>
    bool IsBalanced(in SupportLink support, int kinematic, ref StandingLoad load);

    /// <summary>The same over all supports of a body; writes what each of them bears.</summary>
    bool IsBalanced(ReadOnlySpan<SupportLink> supports, int kinematic, ref StandingLoad load, Span<StandingLoad> parts);

    /// <summary>Number of constraints of a body.</summary>
    int CountConstraints(int body);

    /// <summary>Whether something hits a body hard in this step, or lies deep in it.</summary>
    bool IsHit(int body);
}
