using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Demos.Engine;

namespace Demos.Running;

/// <summary>One material for all pairs, and the groups of the scene.</summary>
struct SceneNarrowPhaseCallbacks(ContactRecorder recorder, PairMaterialProperties material) : INarrowPhaseCallbacks
{
    readonly PairMaterialProperties material = material;

    public readonly void Initialize(Simulation simulation)
    {
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin)
    {
        if (a.Mobility != CollidableMobility.Dynamic && b.Mobility != CollidableMobility.Dynamic)
            return false;
        if (recorder.HasGroups && !MayCollide(GroupOf(a), GroupOf(b)))
            return false;
        if (recorder.Recording)
            ++recorder[workerIndex].Pairs;
        return true;
    }

    public static bool DecidesOnChildren => false;

    public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public readonly bool ConfigureContactManifold<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold,
        out PairMaterialProperties pairMaterial) where TManifold : unmanaged, IContactManifold<TManifold>
    {
        pairMaterial = material;
        if (recorder.Recording)
            Record(workerIndex, ref manifold);
        return true;
    }

    public readonly bool ConfigureContactManifold(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB,
        ref ConvexContactManifold manifold) => true;

    public readonly void Dispose()
    {
    }

    static bool MayCollide(int groupA, int groupB) => groupA >= 0 && groupB >= 0 && (groupA == 0 || groupA != groupB);

    readonly int GroupOf(CollidableReference collidable) => collidable.Mobility == CollidableMobility.Static
        ? recorder.StaticGroups[EngineHandles.Number(collidable)]
        : recorder.BodyGroups[EngineHandles.Number(collidable)];

    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void Record<TManifold>(int workerIndex, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold>
    {
        if (manifold.Count == 0)
            return;
        ref ContactRecorder.Slot slot = ref recorder[workerIndex];
        ++slot.Manifolds;
        slot.Contacts += manifold.Count;
        for (int i = 0; i < manifold.Count; ++i)
        {
            float depth = manifold.GetDepth(i);
            if (depth > slot.GreatestDepth)
                slot.GreatestDepth = depth;
        }
    }
}
