using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>The layers of all bodies and statics of a simulation.</summary>
/// <remarks>
/// Layers are asked where bounds overlap, before anything is read of a body and before the callbacks are asked: the cheapest way to keep two
/// kinds of things apart. They belong to a handle, whatever shape it has, until it is removed. As long as no collidable was given layers,
/// they cost nothing; from then on 8 bytes for each. A change holds from the next step on: contacts that are not to be any more end there.
/// </remarks>
public sealed class CollidableLayers
{
    readonly WorldLock world;
    readonly BufferPool pool;
    readonly CollidableTraits traits;

    internal CollidableLayers(CollidableTraits traits, BufferPool pool, WorldLock world)
    {
        this.world = world;
        this.pool = pool;
        this.traits = traits;
    }

    /// <summary>Whether any collidable was given layers since the simulation began, or was cleared.</summary>
    internal bool IsUsed => traits.Layers.IsUsed;

    /// <summary>Layers of a body; <see cref="CollisionLayers.Everything"/> unless it was given others.</summary>
    /// <exception cref="System.ArgumentException">There is no such body; nothing was changed.</exception>
    /// <exception cref="System.InvalidOperationException">A value is set while a step, a change or a query is in progress; nothing was changed.</exception>
    public CollisionLayers this[BodyHandle body]
    {
        get => Of(traits.Existing(body));
        set => Set(traits.Existing(body), value);
    }

    /// <summary>Layers of a static; <see cref="CollisionLayers.Everything"/> unless it was given others.</summary>
    /// <exception cref="System.ArgumentException">There is no such static; nothing was changed.</exception>
    /// <exception cref="System.InvalidOperationException">A value is set while a step, a change or a query is in progress; nothing was changed.</exception>
    public CollisionLayers this[StaticHandle still]
    {
        get => Of(traits.Existing(still));
        set => Set(traits.Existing(still), value);
    }

    /// <summary>Layers of a body or static; <see cref="CollisionLayers.Everything"/> unless it was given others.</summary>
    /// <exception cref="System.ArgumentException">There is no such collidable; nothing was changed.</exception>
    /// <exception cref="System.InvalidOperationException">A value is set while a step, a change or a query is in progress; nothing was changed.</exception>
    public CollisionLayers this[CollidableReference collidable]
    {
        get => Of(traits.Existing(collidable));
        set => Set(traits.Existing(collidable), value);
    }

    /// <summary>Whether the layers of two collidables let them collide.</summary>
    /// <exception cref="System.ArgumentException">There is no such collidable.</exception>
    public bool MayMeet(CollidableReference a, CollidableReference b) => CollisionLayers.MayMeet(this[a], this[b]);

    /// <summary>As <see cref="this[CollidableReference]"/>, for collidables that are known to exist.</summary>
    internal CollisionLayers Of(CollidableReference collidable) => traits.Layers[collidable];

    void Set(CollidableReference collidable, CollisionLayers value)
    {
        using var change = world.Change("CollidableLayers.Set");
        traits.WakeAround(collidable);
        traits.Layers.Set(collidable, value, pool);
    }
}
