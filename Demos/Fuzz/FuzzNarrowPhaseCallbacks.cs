using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;

namespace Demos.Fuzz;

/// <summary>Does what the plan says.</summary>
readonly struct FuzzNarrowPhaseCallbacks(FuzzPlan plan) : INarrowPhaseCallbacks
{
    public void Initialize(Simulation simulation)
    {
    }

    public bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin)
    {
        plan.OnCall();
        speculativeMargin += plan.Margin;
        return !plan.RefusesPairs;
    }

    public bool ConfigureContactManifold<TManifold>(
        int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        plan.OnCall();
        pairMaterial = plan.Material;
        if (plan.ContactCount >= 0 && manifold is ConvexContactManifold)
            Unsafe.As<TManifold, ConvexContactManifold>(ref manifold).Count = plan.ContactCount;
        return true;
    }

    public static bool DecidesOnChildren => false;

    public bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

    public bool ConfigureContactManifold(
        int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

    public void Dispose()
    {
    }
}
