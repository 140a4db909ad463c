using System;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;

namespace DemoTests.Locking;

/// <summary>Contacts between everything; fails at the beginning or at the end when asked to.</summary>
struct ThrowingContacts : INarrowPhaseCallbacks
{
    public bool InInitialize;
    public bool InDispose;

    public readonly void Initialize(Simulation simulation)
    {
        if (InInitialize)
            throw new TimeZoneNotFoundException("of the test");
    }

    public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) => true;

    public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

    public readonly bool ConfigureContactManifold<TManifold>(
        int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        pairMaterial = new PairMaterialProperties(1, 2, default);
        return true;
    }

    public readonly bool ConfigureContactManifold(
        int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

    public readonly void Dispose()
    {
        if (InDispose)
            throw new TimeZoneNotFoundException("of the test");
    }
}
