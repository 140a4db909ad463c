using BepuPhysics.Collidables;

namespace BepuPhysics;

/// <summary>Keeps the nearest; of several that are equally near that with the lowest reference, so that no order of tests shows.</summary>
struct NearestProximity : IProximityHandler
{
    public Proximity Nearest;
    public bool Exists;

    public readonly bool AllowTest(CollidableReference collidable) => true;

    public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

    public void OnProximity(ref float maximumDistance, in Proximity proximity)
    {
        if (Exists && proximity.Distance == Nearest.Distance && proximity.Collidable.Packed > Nearest.Collidable.Packed)
            return;
        maximumDistance = proximity.Distance;
        Nearest = proximity;
        Exists = true;
    }
}

/// <summary>Whether there is anything.</summary>
struct AnyProximity : IProximityHandler
{
    public bool Exists;

    public readonly bool AllowTest(CollidableReference collidable) => true;

    public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

    public void OnProximity(ref float maximumDistance, in Proximity proximity)
    {
        maximumDistance = -1;
        Exists = true;
    }
}
