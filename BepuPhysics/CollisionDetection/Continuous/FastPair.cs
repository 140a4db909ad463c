using BepuPhysics.Collidables;

namespace BepuPhysics.CollisionDetection;

/// <summary>A pair of which one collidable is marked as continuous, and that moves far in this step.</summary>
struct FastPair
{
    /// <summary>Time of a pair that does not meet in the substep.</summary>
    internal const double Never = double.PositiveInfinity;

    public CollidablePair Pair;
    public TypedIndex ShapeA, ShapeB;
    /// <summary>Indices in the active set, then of the bodies that are watched; -1 for what does not move in this step.</summary>
    public int A, B;
    /// <summary>Inner radius of the thinner shape, m.</summary>
    public float Inner;
    /// <summary>Inner radius of the shape that reaches less far from its centre, m; known from the first sweep on.</summary>
    public float SmallerInner;
    /// <summary>Whether one of them is a sensor, which is seen to be met and passed.</summary>
    public bool IsSensor;
    /// <summary>Whether it has been met in this step.</summary>
    public bool HasPassed;
    /// <summary>Where what does not move is.</summary>
    public RigidPose PoseA, PoseB;
    /// <summary>Next pair of the same body, or -1.</summary>
    public int NextOfA, NextOfB;

    /// <summary>Next pair of one of the two bodies, or -1.</summary>
    public readonly int NextOf(int body) => A == body ? NextOfA : NextOfB;

    /// <summary>Which ways may meet at all; known from the first sweep on.</summary>
    public WayGate Gate;
    /// <summary>What it is if it is one of balls; known from the first sweep on.</summary>
    public BallWays Balls;
    /// <summary>Whether the gate or the balls are known.</summary>
    public bool IsKnown;
    /// <summary>Whether it stays apart in this step as far as its motion was foreseen.</summary>
    public bool StaysApart;
    /// <summary>When the cores of the shapes meet, s from the beginning of the substep.</summary>
    public double Time;
    /// <summary>Unit normal from B to A at that time.</summary>
    public DoubleVector3 Normal;
    /// <summary>Place at that time, from the centres of A and of B.</summary>
    public DoubleVector3 ArmA, ArmB;
    /// <summary>Impacts in this substep.</summary>
    public int ImpactCount;
    /// <summary>Rounds that its sweeps have taken in this step.</summary>
    public int RoundCount;

    /// <summary>Whether the callbacks were asked about the pair, and whether they let it pass.</summary>
    public bool IsAsked, Passes;
    /// <summary>What they said of its surfaces.</summary>
    public float Friction, Restitution;
    /// <summary>What impacts have pushed along their normals in this step, N s.</summary>
    public float Impulse;
}
