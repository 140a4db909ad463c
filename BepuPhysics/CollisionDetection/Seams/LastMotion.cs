using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>What the last step has done to a pair: asked for only where a triangle may have to hold what was pressed through it.</summary>
struct LastMotion
{
    PatchDepths depths;

    /// <summary>How A and B moved, as twists.</summary>
    public BodyVelocity OfA, OfB;

    [InlineArray(PatchSet.Capacity)]
    struct PatchDepths
    {
        float first;
    }

    /// <summary>How deep the contacts of a patch came to be, m; zero if they were apart.</summary>
    /// <param name="patch">The patch, as one of <see cref="KnownPatches"/>.</param>
    public readonly float Depth(int patch) => depths[patch];

    /// <summary>Notes that a contact of a patch came to be as deep, m.</summary>
    public void NoteDepth(int patch, float depth) => depths[patch] = MathHelper.Max(depths[patch], depth);
}
