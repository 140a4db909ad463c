using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Xunit;

namespace DemoTests.Queries;

/// <summary>A hit of a sweep; without a normal where the shapes overlapped from the start.</summary>
readonly record struct SweptHit(CollidableReference Collidable, float T, Vector3 Place, Vector3 Normal)
{
    public bool Overlaps => Normal == Vector3.Zero;
}

/// <summary>Keeps all hits, or only the nearest.</summary>
struct SweepHits(List<SweptHit> hits, bool nearestOnly = false) : ISweepHitHandler
{
    /// <summary>What is not to be tested.</summary>
    public CollidableReference? Ignored;
    /// <summary>The only child that is to be tested; all, if there is none.</summary>
    public int? OnlyChild;
    public int Calls, ChildCalls;

    public readonly bool AllowTest(CollidableReference collidable) => collidable != Ignored;

    public bool AllowTest(CollidableReference collidable, int childIndex)
    {
        ++ChildCalls;
        return OnlyChild is not { } only || only == childIndex;
    }

    public void OnHit(ref float maximumT, float t, Vector3 hitLocation, Vector3 hitNormal, CollidableReference collidable)
    {
        Assert.InRange(t, 0, maximumT);
        Assert.InRange(hitNormal.Length(), 1 - 1e-6f, 1 + 1e-6f);
        Keep(ref maximumT, new(collidable, t, hitLocation, hitNormal));
    }

    public void OnHitAtZeroT(ref float maximumT, CollidableReference collidable) => Keep(ref maximumT, new(collidable, 0, default, default));

    void Keep(ref float maximumT, SweptHit hit)
    {
        ++Calls;
        if (nearestOnly)
        {
            hits.Clear();
            maximumT = hit.T;
        }
        hits.Add(hit);
    }
}
