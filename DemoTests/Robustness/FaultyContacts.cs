using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;

namespace DemoTests.Robustness;

/// <summary>Changes what callbacks say of a pair.</summary>
delegate void ContactChange(ref ConvexContactManifold manifold, ref PairMaterialProperties material);

/// <summary>What narrow phase callbacks get wrong, once armed, for the pairs of one body.</summary>
sealed class Fault
{
    public const float NoMargin = -12345;

    public bool Armed { get; set; }

    /// <summary>Value of the body's handle; null for all pairs.</summary>
    public int? Body { get; set; }

    public ContactChange? Change { get; init; }

    public float Margin { get; init; } = NoMargin;

    public float Restitution { get; init; }

    public bool Concerns(CollidableReference a, CollidableReference b) => Armed && (Body is not int body
        || (a.Mobility != CollidableMobility.Static && a.RawHandleValue == body)
        || (b.Mobility != CollidableMobility.Static && b.RawHandleValue == body));
}

/// <summary>Ordinary contacts but for a fault.</summary>
struct FaultyContacts(Fault fault) : ISurfaceCallbacks<FaultyContacts>
{
    public readonly void Initialize(Simulation simulation)
    {
    }

    public readonly bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin)
    {
        if (fault.Margin != Fault.NoMargin && fault.Concerns(a, b))
            speculativeMargin = fault.Margin;
        return true;
    }

    public readonly bool ConfigureContactManifold<TManifold>(
        int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        pairMaterial = new PairMaterialProperties(.5f, 2, default);
        if (fault.Concerns(pair.A, pair.B) && manifold.Count > 0)
            fault.Change?.Invoke(ref Unsafe.As<TManifold, ConvexContactManifold>(ref manifold), ref pairMaterial);
        return true;
    }

    public readonly SurfaceProperties GetSurface<TManifold>(int workerIndex, CollidablePair pair, ref TManifold manifold)
        where TManifold : unmanaged, IContactManifold<TManifold> => new() { Restitution = fault.Concerns(pair.A, pair.B) ? fault.Restitution : 0 };

    public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

    public readonly bool ConfigureContactManifold(
        int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

    public readonly void Dispose()
    {
    }
}
