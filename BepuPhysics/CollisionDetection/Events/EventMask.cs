using System;

namespace BepuPhysics.CollisionDetection;

/// <summary>What is to be told of the contacts of a collidable.</summary>
[Flags]
public enum EventMask : byte
{
    /// <summary>Nothing.</summary>
    None = 0,
    /// <summary>That two collidables touch that did not in the step before.</summary>
    Begin = 1,
    /// <summary>That two collidables touch no more.</summary>
    End = 2,
    /// <summary>That two collidables met faster than <see cref="CollisionEvents.HitSpeed"/>.</summary>
    Hit = 4,
    /// <summary>That two collidables still touch, with what they pushed in the step.</summary>
    Persist = 8,
    /// <summary>That the body falls asleep or wakes.</summary>
    Sleep = 16,
    /// <summary>All that is told of contacts.</summary>
    Contacts = Begin | End | Hit | Persist,
    /// <summary>All of these.</summary>
    All = Contacts | Sleep,
}
