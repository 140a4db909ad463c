using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuPhysics.CollisionDetection;

/// <summary>What is remembered of a patch besides its constraint.</summary>
struct PatchMemory
{
    /// <summary>Unit normal in world axes, from B to A.</summary>
    public Vector3 Normal;
    /// <summary>Features of the first two contacts, which are preferred to others that are as good.</summary>
    public int First, Second;

    /// <summary>Remembers the patch as it is now.</summary>
    public void Write(in ConvexContactManifold manifold)
    {
        Normal = manifold.Normal;
        First = manifold.Contact0.FeatureId;
        Second = manifold.Count > 1 ? manifold.Contact1.FeatureId : First;
    }
}

/// <summary>The patches that a pair had in the last step.</summary>
struct KnownPatches
{
    /// <summary>Number of patches.</summary>
    public int Count;
    /// <summary>Whether the children are wanted after they were joined, as the pair may have to agree with others.</summary>
    public bool KeepsChildren;
    PatchNumbers numbers;
    PatchMemories memories;

    [InlineArray(PatchSet.Capacity)]
    struct PatchNumbers
    {
        int first;
    }

    [InlineArray(PatchSet.Capacity)]
    struct PatchMemories
    {
        PatchMemory first;
    }

    /// <summary>Adds a patch, of which there is room for as many as a pair has.</summary>
    public void Add(int number, in PatchMemory memory)
    {
        numbers[Count] = number;
        memories[Count++] = memory;
    }

    /// <summary>Number that a patch has.</summary>
    public readonly int Number(int index) => numbers[index];

    /// <summary>What is remembered of a patch.</summary>
    public readonly PatchMemory this[int index] => memories[index];
}
