using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>What happened between two collidables in a step.</summary>
public struct ContactEvent
{
    /// <summary>
    /// The two, in the order of their contacts. One that was removed is named by its handle still, which <see cref="Bodies.BodyExists"/> and
    /// <see cref="Statics.StaticExists"/> recognise.
    /// </summary>
    public CollidablePair Pair;
    /// <summary>Place of the strongest contact when collisions were detected, m, in world axes. Zero without contacts, as of sensors.</summary>
    public Vector3 Position;
    /// <summary>Unit normal of the strongest contact, from B to A. Zero without contacts.</summary>
    public Vector3 Normal;
    /// <summary>Depth of the strongest contact when collisions were detected, m; negative where the surfaces were apart.</summary>
    public float Depth;
    /// <summary>
    /// Sum of what all contacts pushed along their normals in the step, bounces included, N s; of hits in the step before, too, if they began in it.
    /// </summary>
    public float Impulse;
    /// <summary>What friction pushed A with in the same time, bounces included, N s; B was pushed the other way.</summary>
    public Vector3 FrictionImpulse;
    /// <summary>
    /// Greatest speed at which surfaces approached along the normal before the step pushed them, with what gravity gives until they meet, m/s; negative where
    /// they parted.
    /// </summary>
    public float ApproachSpeed;
    /// <summary>Whether one of the two is a sensor.</summary>
    public bool IsSensor;

    internal int FirstContact;
    internal int ContactCount;
}

/// <summary>One contact of a <see cref="ContactEvent"/>.</summary>
public struct EventContact
{
    /// <summary>Where it was when collisions were detected, m, in world axes: halfway between the two surfaces.</summary>
    public Vector3 Position;
    /// <summary>Unit normal, from B to A.</summary>
    public Vector3 Normal;
    /// <summary>Depth when collisions were detected, m; negative where the surfaces were apart.</summary>
    public float Depth;
    /// <summary>What the contact pushed along its normal in the step, N s; without bounces, which belong to all contacts of a pair.</summary>
    public float Impulse;
    /// <summary>Names the features that touch.</summary>
    public int FeatureId;
    /// <summary>Index of the child of A that touches; -1 where neither shape has children.</summary>
    public int ChildA;
    /// <summary>Index of the child of B that touches; -1 where neither shape has children.</summary>
    public int ChildB;
}
