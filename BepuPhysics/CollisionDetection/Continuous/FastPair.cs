using System.Numerics;
using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>A pair of which one collidable is marked as continuous, and that moves far in this step.</summary>
// What each sweep of all asks for comes first, as many pairs are more than the nearest memory holds.
struct FastPair
{
    /// <summary>Time of a pair that does not meet in the substep.</summary>
    internal const double Never = double.PositiveInfinity;

    /// <summary>When the cores of the shapes meet, s from the beginning of the substep.</summary>
    public double Time;
    /// <summary>Time in the step up to which it stays apart as far as its motion was foreseen, s from the beginning of the step.</summary>
    public double ApartUntil;
    /// <summary>Indices in the active set, then of the bodies that are watched; -1 for what does not move in this step.</summary>
    public int A, B;
    /// <summary>Next pair of the same body, or -1.</summary>
    public int NextOfA, NextOfB;
    public CollidablePair Pair;
    /// <summary>Whether the gate or the balls are known.</summary>
    public bool IsKnown;
    /// <summary>Whether the callbacks were asked about the pair, and whether they let it pass.</summary>
    public bool IsAsked, Passes;
    /// <summary>Whether one of them is a sensor, which is seen to be met and passed.</summary>
    public bool IsSensor;
    /// <summary>Whether it has been met in this step.</summary>
    public bool HasPassed;
    /// <summary>Impacts in this substep.</summary>
    public int ImpactCount;
    /// <summary>Whether it was found within the step: then it may have no contacts.</summary>
    public bool IsLate;
    /// <summary>Whether both go on as one body, for the rest of the substep or until one of them is hit by another.</summary>
    public bool IsJoined;
    /// <summary>Energy that impacts have taken along their normals in this step, and not given back, J.</summary>
    public float Lost;
    /// <summary>Rounds that its sweeps have taken in this step.</summary>
    public int RoundCount;
    /// <summary>The thickest cores that were apart when its last sweep began, by their number; as many as there are if none were.</summary>
    public int Level;
    /// <summary>Inner radius of the thinner shape, m.</summary>
    public float Inner;
    /// <summary>What it is if it is one of balls; known from the first sweep on.</summary>
    public BallWays Balls;
    /// <summary>Where what does not move is.</summary>
    public RigidPose PoseB, PoseA;
    public TypedIndex ShapeA, ShapeB;
    /// <summary>Inner radius of the shape that reaches less far from its centre, m; known from the first sweep on.</summary>
    public float SmallerInner;
    /// <summary>Which ways may meet at all; known from the first sweep on.</summary>
    public WayGate Gate;
    /// <summary>Unit normal from B to A at the time when they meet.</summary>
    public DoubleVector3 Normal;
    /// <summary>Place at that time, from the centres of A and of B.</summary>
    public DoubleVector3 ArmA, ArmB;

    /// <summary>What the callbacks said of its surfaces.</summary>
    public float Friction, Restitution;
    /// <summary>What impacts have pushed along their normals in this step, N s.</summary>
    public float Impulse;
    /// <summary>What friction of impacts has pushed A with, N s.</summary>
    public Vector3 FrictionImpulse;

    /// <summary>Next pair of one of the two bodies, or -1.</summary>
    public readonly int NextOf(int body) => A == body ? NextOfA : NextOfB;

    /// <summary>The other one of the two bodies, or -1.</summary>
    public readonly int OtherThan(int body) => A == body ? B : A;
}
