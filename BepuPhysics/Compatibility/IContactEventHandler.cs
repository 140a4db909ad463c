using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;

namespace BepuPhysics.Compatibility;

/// <summary>What a game does when things touch, by the names of the contact events demo of bepuphysics2. See <see cref="ContactEvents"/>.</summary>
/// <remarks>
/// Handlers are called by <see cref="ContactEvents.Flush"/> on its thread, so the worker index is 0 always. Manifolds are copies: writing to
/// them changes nothing.
/// </remarks>
public interface IContactEventHandler
{
    /// <summary>A contact was not there in the step before.</summary>
    /// <param name="eventSource">Collidable that is listened to.</param>
    /// <param name="pair">The two collidables.</param>
    /// <param name="contactManifold">All contacts of the two.</param>
    /// <param name="contactOffset">Place of the contact relative to A's centre, in world axes, m.</param>
    /// <param name="contactNormal">Unit normal, from B to A.</param>
    /// <param name="depth">Depth when collisions were detected, m; negative where the surfaces were apart.</param>
    /// <param name="featureId">Names the features that touch.</param>
    /// <param name="contactIndex">Index of the contact in the manifold.</param>
    /// <param name="workerIndex">0.</param>
    void OnContactAdded<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold,
        Vector3 contactOffset, Vector3 contactNormal, float depth, int featureId, int contactIndex, int workerIndex)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
    }

    /// <summary>A contact of the step before is there no more.</summary>
    /// <param name="eventSource">Collidable that is listened to.</param>
    /// <param name="pair">The two collidables.</param>
    /// <param name="contactManifold">All contacts that are left.</param>
    /// <param name="removedFeatureId">What the contact was named by.</param>
    /// <param name="workerIndex">0.</param>
    void OnContactRemoved<TManifold>(
        CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int removedFeatureId, int workerIndex)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
    }

    /// <summary>Two collidables touch that did not in the step before.</summary>
    /// <param name="eventSource">Collidable that is listened to.</param>
    /// <param name="pair">The two collidables.</param>
    /// <param name="contactManifold">All contacts of the two.</param>
    /// <param name="workerIndex">0.</param>
    void OnStartedTouching<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
    }

    /// <summary>Two collidables touch, in this step or still.</summary>
    /// <param name="eventSource">Collidable that is listened to.</param>
    /// <param name="pair">The two collidables.</param>
    /// <param name="contactManifold">All contacts of the two.</param>
    /// <param name="workerIndex">0.</param>
    void OnTouching<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
    }

    /// <summary>Two collidables touch no more.</summary>
    /// <param name="eventSource">Collidable that is listened to.</param>
    /// <param name="pair">The two collidables.</param>
    /// <param name="contactManifold">All contacts that are left.</param>
    /// <param name="workerIndex">0.</param>
    void OnStoppedTouching<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
    }

    /// <summary>Two collidables have contacts, touching or foreseen, that had none in the step before.</summary>
    /// <param name="eventSource">Collidable that is listened to.</param>
    /// <param name="pair">The two collidables.</param>
    /// <param name="contactManifold">All contacts of the two.</param>
    /// <param name="workerIndex">0.</param>
    void OnPairCreated<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
    }

    /// <summary>Two collidables have contacts; after all else that is told of them.</summary>
    /// <param name="eventSource">Collidable that is listened to.</param>
    /// <param name="pair">The two collidables.</param>
    /// <param name="contactManifold">All contacts of the two.</param>
    /// <param name="workerIndex">0.</param>
    void OnPairUpdated<TManifold>(CollidableReference eventSource, CollidablePair pair, ref TManifold contactManifold, int workerIndex)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
    }

    /// <summary>Two collidables have no contacts any more; either may have been removed.</summary>
    /// <param name="eventSource">Collidable that is listened to.</param>
    /// <param name="pair">The two collidables.</param>
    void OnPairEnded(CollidableReference eventSource, CollidablePair pair)
    {
    }
}
