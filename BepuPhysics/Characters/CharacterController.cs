using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.Characters;

/// <summary>What a character wants, what it can, and what it stands on. Names are those of the character demo of bepuphysics2.</summary>
/// <remarks>
/// Its body is a dynamic one that does not turn by itself (no inverse inertia), so that it pushes, is pushed and is carried as other bodies are.
/// Set the goals before a step; a body that sleeps is woken by goals that have changed.
/// </remarks>
public struct CharacterController
{
    /// <summary>Where the character looks, in the world: forwards is the part of it along the ground. Of any length; zero is as -Z.</summary>
    public Vector3 ViewDirection;
    /// <summary>Velocity to the right and forwards, along the ground and relative to it, m/s.</summary>
    public Vector2 TargetVelocity;
    /// <summary>Jumps in the next step if the character stands on something. The step sets it to false either way.</summary>
    public bool TryJump;
    /// <summary>The body.</summary>
    public BodyHandle BodyHandle;
    /// <summary>Upwards, in the frame of the body; unit length. The Y axis unless it is set.</summary>
    public Vector3 LocalUp;
    /// <summary>Speed upwards that a jump leaves the ground with, m/s: it reaches its square over twice the gravity. 5 unless it is set.</summary>
    public float JumpVelocity;
    /// <summary>Greatest force along the ground, N: over the mass, how fast the character gathers and loses speed. 20 m/s2 unless it is set.</summary>
    public float MaximumHorizontalForce;
    /// <summary>Greatest force that holds the character to the ground where this falls away, N. 100 m/s2 times the mass unless it is set.</summary>
    public float MaximumVerticalForce;
    /// <summary>
    /// Greatest force that steers the character in the air, N: towards its goal as seen from the world, and never against what it is faster by. Zero, so
    /// that it keeps its velocity, unless it is set.
    /// </summary>
    public float MaximumAirForce;
    /// <summary>Cosine of the steepest slope on which the character can stand. That of 45 degrees unless it is set.</summary>
    public float CosMaximumSlope;
    /// <summary>Least depth of a contact with what the character comes to stand on, m; negative for a gap. -0.002 unless it is set.</summary>
    public float MinimumSupportDepth;
    /// <summary>Least depth of a contact with what it has stood on before, m. -0.1 unless it is set, which holds it to the ground downhill.</summary>
    public float MinimumSupportContinuationDepth;
    /// <summary>
    /// Height of the steps that the character goes up without a jump, m: onto statics and kinematic bodies that its layers meet. Zero for
    /// none, unless it is set; it costs three sweeps in each step in which the character walks against something steep.
    /// </summary>
    public float MaximumStepHeight;
    /// <summary>Whether the character stood on something in the last step.</summary>
    public bool Supported;
    /// <summary>What it stood on, if anything.</summary>
    public CollidableReference Support;
    /// <summary>The constraint that moves it; exists while it is supported.</summary>
    public ConstraintHandle MotionConstraintHandle;

    // The goals when the character was last looked at: what has changed since wakes it.
    internal Vector2 LastVelocity;
    internal Vector3 LastView;
    // Whether it went up a step in the last step: then it may stand on nothing, on the way over the edge.
    internal bool Rises;

    internal readonly float TargetSpeed => MathF.Sqrt(Exact.Dot(TargetVelocity, TargetVelocity));
}
