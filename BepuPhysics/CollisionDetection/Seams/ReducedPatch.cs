using System;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints.Contact;

namespace BepuPhysics.CollisionDetection;

/// <summary>A patch of which contacts are chosen, and those that were.</summary>
unsafe struct ReducedPatch
{
    /// <summary>What was found for each child.</summary>
    public ChildResult* Results;
    /// <summary>Shapes and poses of each.</summary>
    public PlacedChildren* Placed;
    /// <summary>The first of the children of its pair among those that are ranked, and their number; not all have contacts in the patch.</summary>
    public int FirstChild, ChildCount;
    /// <summary>The patch.</summary>
    public Patch Patch;
    /// <summary>Place of the patch among those of its pair, by which its children know it.</summary>
    public int Number;
    /// <summary>Least depth that a contact must have at the end of the step to touch, m.</summary>
    public float Limit;
    /// <summary>Whether contacts that do not touch are candidates too.</summary>
    public bool IsLeaning;
    /// <summary>What friction against turning has for a lever; see <see cref="FaceLever"/>.</summary>
    public byte Lever;
    int count;
    Names names;

    [InlineArray(ConvexContactManifold.MaximumContactCount)]
    struct Names
    {
        int first;
    }

    /// <summary>The contacts that were chosen, by their names: a slot, times the contacts of a manifold, and a contact.</summary>
    [UnscopedRef]
    public readonly ReadOnlySpan<int> Kept => ((ReadOnlySpan<int>)names)[..count];

    /// <summary>Forgets what was chosen.</summary>
    public void Clear() => count = 0;

    /// <summary>Keeps a contact, if there is room for one more.</summary>
    public void Add(int name)
    {
        if (count < Patch.Share)
            names[count++] = name;
    }
}

/// <summary>A contact that may be chosen.</summary>
struct ReducedContact
{
    /// <summary>Its place across the normal, m.</summary>
    public float X, Y;
    /// <summary>How deep it is, and by how much it comes nearer within the step, m.</summary>
    public float Depth, Approach;
    /// <summary>What squared distances to it count for.</summary>
    public float Weight;
    /// <summary>Its name.</summary>
    public int Name;
    /// <summary>Whether it was the first one in the last step.</summary>
    public bool IsFirst;
}
