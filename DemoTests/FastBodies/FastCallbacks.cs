using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;

namespace DemoTests.FastBodies;

/// <summary>Contacts of what is shot with what it is shot at, and of nothing else: shots do not meet.</summary>
struct FastCallbacks(int firstShot, float friction, float restitution) : ISurfaceCallbacks<FastCallbacks>
{
    public readonly void Initialize(Simulation simulation)
    {
    }

    readonly bool IsShot(CollidableReference collidable) => collidable.Mobility == CollidableMobility.Dynamic && collidable.Slot >= firstShot;

    public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) =>
        IsShot(a) != IsShot(b);

    public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

    public readonly bool ConfigureContactManifold<TManifold>(
        int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        pairMaterial = new(friction, 2, SpringSettings.Rigid);
        return true;
    }

    public readonly bool ConfigureContactManifold(
        int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

    public readonly SurfaceProperties GetSurface<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold)
        where TManifold : unmanaged, IContactManifold<TManifold> => new() { Restitution = restitution };

    public readonly void Dispose()
    {
    }
}
