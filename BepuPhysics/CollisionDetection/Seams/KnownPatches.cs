using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>What is remembered of a patch besides its constraint.</summary>
struct PatchMemory
{
    /// <summary>Unit normal in world axes, from B to A.</summary>
    public Vector3 Normal;
    /// <summary>Features of the first two contacts, which are preferred to others that are as good.</summary>
    public int First, Second;
    // By how much the normal has turned since the step before, squared: negative where it turned otherwise in the step before that, zero where nothing touches.
    float squaredTurn;

    // Least part of one squared turn that another is which is like it: half as much, or twice.
    const float LeastAlike = 0.25f;

    /// <summary>Whether the surface is a smooth bend, along which a normal turns in each step: it has turned twice by about as much as now.</summary>
    // Between sides that are longer than the way of a step there are edges, and a lip is over after two steps.
    public readonly bool IsSmooth(float squaredTurn) => AreAlike(this.squaredTurn, squaredTurn);

    static bool AreAlike(float a, float b) => a >= LeastAlike * b && b >= LeastAlike * a;

    /// <summary>Remembers the patch as it is now.</summary>
    public void Write(in ConvexContactManifold manifold)
    {
        var turn = Normal == default ? 0 : Exact.DistanceSquared(manifold.Normal, Normal);
        // On its way along a bend that is wider than itself, what is held by planes gets no farther from it than this.
        if (!(manifold.GreatestDepth >= -turn * Exact.Length(manifold.Contact0.Offset)))
            turn = 0;
        squaredTurn = AreAlike(MathF.Abs(squaredTurn), turn) ? turn : -turn;
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
