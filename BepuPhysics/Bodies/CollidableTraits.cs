using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>What only some bodies and statics have, until they are removed.</summary>
sealed class CollidableTraits(Bodies bodies, Statics statics, BufferPool pool)
{
    /// <summary>What meets what.</summary>
    internal CollidableTable<CollisionLayers> Layers = new(CollisionLayers.Everything);
    /// <summary>Who is listened to for what, and who is a sensor; the bits are those of the events.</summary>
    internal CollidableTable<byte> Listeners = new(0);

    /// <summary>Grows whenever a collidable is removed.</summary>
    internal int RemovalCount { get; private set; }

    /// <summary>Forgets what is known of a collidable that is removed.</summary>
    internal void Forget(CollidableReference collidable)
    {
        ++RemovalCount;
        Layers.Forget(collidable);
        Listeners.Forget(collidable);
    }

    internal void CopyState(StateCopy copy)
    {
        Layers.CopyState(copy);
        Listeners.CopyState(copy);
        RemovalCount = copy.Value(RemovalCount);
    }

    /// <summary>Forgets everything and gives the memory back.</summary>
    internal void Clear()
    {
        Layers.Dispose(pool);
        Listeners.Dispose(pool);
    }

    /// <summary>Forgets memory that is gone already.</summary>
    internal void Abandon()
    {
        Layers.Abandon();
        Listeners.Abandon();
    }

    /// <summary>Wakes what may collide otherwise when what is known of a collidable changes: itself and all that touches it.</summary>
    internal void WakeAround(CollidableReference collidable)
    {
        if (collidable.Mobility == CollidableMobility.Static)
            statics.WakeAround(collidable.StaticHandle);
        else
            bodies.WakeAround(collidable.BodyHandle);
    }

    /// <summary>Refuses a collidable that is none.</summary>
    /// <exception cref="System.ArgumentException">There is no such collidable.</exception>
    internal CollidableReference Existing(CollidableReference collidable) => collidable.Mobility == CollidableMobility.Static
        ? Existing(collidable.StaticHandle)
        : Existing(collidable.BodyHandle);

    /// <summary>Names a body, of whatever mobility, or refuses the handle.</summary>
    /// <exception cref="System.ArgumentException">There is no such body.</exception>
    internal CollidableReference Existing(BodyHandle body)
    {
        bodies.CheckHandle(body);
        return new(CollidableMobility.Dynamic, body);
    }

    /// <summary>Names a static, or refuses the handle.</summary>
    /// <exception cref="System.ArgumentException">There is no such static.</exception>
    internal CollidableReference Existing(StaticHandle still)
    {
        statics.CheckHandle(still);
        return new(still);
    }
}
