using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>A pair with a coefficient of restitution, for one step.</summary>
// What each impact asks its neighbours for comes first, and what most of them need of one contact after it.
struct BouncingPair
{
    /// <summary>Time of a pair whose surfaces do not meet in the substep.</summary>
    internal const float Never = float.PositiveInfinity;

    /// <summary>When the surfaces meet, s from the beginning of the substep; negative where they did before, and nobody looked.</summary>
    public float Time;
    /// <summary>Speed at which they then approach, m/s.</summary>
    public float Speed;
    /// <summary>Place in the queue, or -1.</summary>
    public int QueueIndex;
    /// <summary>Index of body A in the active set.</summary>
    public int A;
    /// <summary>Index of body B, or -1 where nothing moves it.</summary>
    public int B;
    /// <summary>Next pair of A, or -1.</summary>
    public int NextOfA;
    /// <summary>Next pair of B, or -1.</summary>
    public int NextOfB;
    /// <summary>Impacts in this substep.</summary>
    public int ImpactCount;
    public ConstraintHandle Constraint;
    public int ContactCount;
    public float Coefficient;
    /// <summary>What comes nearer by less than this in a substep rests, m.</summary>
    public float LeastHit;
    /// <summary>Greatest speed at which it was hit in this substep, m/s; zero where it bounces.</summary>
    public float Stopped;
    /// <summary>How far they are to be moved apart in this substep, besides what their velocity does.</summary>
    public float Overlap;
    /// <summary>Whether the constraint carries a load in this substep.</summary>
    public bool IsLoaded;
    /// <summary>Whether the surfaces overlap, and the solver is not told: they carry no load, or hang in joints.</summary>
    public bool Overlaps;
    /// <summary>How far it may overlap by its load, m.</summary>
    public float Sunk;
    /// <summary>Whether it carries a load, and overlaps by more.</summary>
    public bool Presses;
    /// <summary>Whether they overlap, and do not part by themselves or carry a load, and both hang.</summary>
    public bool Stays;
    /// <summary>Whether one of the bodies is in a structure of joints; known from the first impact of a step on.</summary>
    public bool IsInStructure;
    /// <summary>Whether the surfaces lie on each other more than they press sideways.</summary>
    public bool Bears;
    /// <summary>Whether both bodies are in structures that hang from what nothing moves, and meet sideways; known as long.</summary>
    public bool Hangs;
    /// <summary>Whether it takes part in the impact that is being made.</summary>
    public bool Joins;
    /// <summary>Whether A rests on something, so that its velocity is without what the substep has added to it.</summary>
    public bool RestsA;
    /// <summary>As <see cref="RestsA"/>, of B.</summary>
    public bool RestsB;
    /// <summary>What impacts have pushed along the normal in this step, N s.</summary>
    public float Impulse;
    /// <summary>What friction of impacts has pushed A with in this step, N s.</summary>
    public Vector3 Friction;
    /// <summary>Where the constraint is in this step.</summary>
    public ContactPlace Place;
    /// <summary>What the integration of a substep adds to the speed at each contact, or to that along the normal, either way, m/s.</summary>
    public FourFloats Gained;
    /// <summary>Overlap of each contact that the solver is not told of in this substep.</summary>
    public FourFloats Hidden;
    /// <summary>Rows of the contacts along the normal: the same in all substeps.</summary>
    public FourRows Rows;
    /// <summary>Velocity of A before the step, then what the integration of a substep adds to it.</summary>
    public BodyVelocity GainA;
    /// <summary>As <see cref="GainA"/>, of B.</summary>
    public BodyVelocity GainB;

    /// <summary>Square of the greater one of what gravity adds to the speeds of the two in a substep, (m/s)^2.</summary>
    public readonly float GainSquared => MathHelper.Max(Exact.LengthSquared(GainA.Linear), Exact.LengthSquared(GainB.Linear));

    /// <summary>What is in the velocity of A, while impacts are made, of what the substep has added to it.</summary>
    public readonly BodyVelocity GainInA => RestsA ? default : GainA;

    /// <summary>As <see cref="GainInA"/>, of B.</summary>
    public readonly BodyVelocity GainInB => RestsB ? default : GainB;

    /// <summary>The speed at which a contact approaches, with what the substep adds to who rests: that at which it rests has a part for it.</summary>
    public readonly float WithGain(int contact, float speed) =>
        RestsA || RestsB ? speed - Rows[contact].Along(RestsA ? GainA : default, RestsB ? GainB : default) : speed;

    /// <summary>Next pair of one of the two bodies, or -1.</summary>
    public readonly int NextOf(int body) => A == body ? NextOfA : NextOfB;

    /// <summary>
    /// The gap that is closed in a substep at a speed, m. What does not bounce has come as near as it was fast when it was hit: a body that was turned by the
    /// impact is not where it would have been turned to, and others may push it on.
    /// </summary>
    internal readonly float Reach(float speed, float dt) => (speed + Stopped) * dt;

    /// <summary>
    /// The gap of a contact that meets with others within the substep, m: what meets as it ends would, by rounding, be hit at some of its corners and turned.
    /// </summary>
    internal readonly float ReachOfAlike(float speed, float dt) => Reach(speed, dt) * (1 + Restitution.AlikeShare);
}
