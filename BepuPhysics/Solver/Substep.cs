using System;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>The part of a step that the solver is working on.</summary>
public readonly struct Substep
{
    // Up to this part of the usual length a longer substep keeps the usual stiffness of contacts.
    const float GreatestContactLength = 3;
    // The same for joints.
    const float GreatestJointLength = 1.25f;

    /// <summary>Index of the substep within its step, from 0.</summary>
    public readonly int Index;
    /// <summary>Length of the substep, s.</summary>
    public readonly float Dt;
    /// <summary>One over the length, 1/s.</summary>
    public readonly float InverseDt;
    /// <summary>
    /// Factor for the impulses that the previous substep left: the ratio of the two lengths, since the force is what carries over.
    /// 1 except in the first substep of a step whose substeps differ in length from the last step's.
    /// </summary>
    public readonly float WarmStartScale;
    /// <summary>Whether the sweep comes after the bodies have moved, and brings rigid constraints to rest without correcting positions.</summary>
    public readonly bool IsRelaxation;

    /// <summary>
    /// Whether contacts may land, that is stop what comes fast at once: where a game asks for it, and there are so many substeps in a step that
    /// what gravity gives in one is little beside what falls.
    /// </summary>
    internal bool Lands { get; init; }

    /// <summary>How stiff joints may be that are no servos.</summary>
    public readonly SubstepStiffness Joints;
    /// <summary>How stiff servos may be.</summary>
    public readonly SubstepStiffness Servos;
    /// <summary>How stiff joints and servos may be at most where many are on one body, or do not see each other's impulses.</summary>
    public readonly SubstepStiffness Hubs;
    /// <summary>How stiff contacts may be.</summary>
    public readonly SubstepStiffness Contacts;

    /// <summary>What joints are that a game gave no frequency.</summary>
    internal readonly RigidSoftness RigidJoints;
    /// <summary>What servos are that a game gave no frequency.</summary>
    internal readonly RigidSoftness RigidServos;

    /// <summary>Describes a substep.</summary>
    /// <param name="index">Index within the step, from 0.</param>
    /// <param name="dt">Length, s.</param>
    /// <param name="warmStartScale">Ratio of the length to the last substep's.</param>
    /// <param name="iterations">Sweeps over the constraints.</param>
    /// <param name="relaxations">Sweeps after the bodies have moved.</param>
    /// <param name="isRelaxation">Whether this is one of the latter.</param>
    /// <param name="usualDt">Usual length of a substep, s, to which the stiffness of rigid constraints belongs; 0 where that is <paramref name="dt"/>.</param>
    /// <param name="contactFrequency">Frequency of rigid contacts, Hz; 0 for as stiff as the sweeps hold, beyond which it does not go.</param>
    public Substep(
        int index, float dt, float warmStartScale = 1, int iterations = 1, int relaxations = 0, bool isRelaxation = false, float usualDt = 0,
        float contactFrequency = 0)
    {
        // Stiffness is that of the usual substep. In a longer one both bear more cycles for a time than for ever, joints of chains less than
        // contacts, and those of hubs none.
        var length = usualDt > 0 ? dt / usualDt : 1;
        var forHubs = MathHelper.Min(length, 1);
        var forJoints = MathHelper.Min(length, GreatestJointLength);
        var forContacts = MathHelper.Min(length, GreatestContactLength);
        // Relaxations leave servos and what a game gave a frequency alone, and so do nothing for how stiff these may be.
        var joint = SubstepStiffness.JointCycles(iterations, relaxations);
        var unrelaxedJoint = SubstepStiffness.JointCycles(iterations);
        var contact = SubstepStiffness.ContactCycles(iterations, relaxations);
        var unrelaxedContact = SubstepStiffness.ContactCycles(iterations);
        Joints = new(joint * forJoints, unrelaxedJoint * forJoints);
        Servos = new(unrelaxedJoint * forJoints, unrelaxedJoint * forJoints);
        Hubs = new(contact * forHubs, unrelaxedContact * forHubs);
        var stiffest = contact * forContacts;
        Contacts = new(contactFrequency > 0 ? MathHelper.Min(contactFrequency * dt, stiffest) : stiffest, unrelaxedContact * forContacts);
        Index = index;
        Dt = dt;
        InverseDt = 1 / dt;
        WarmStartScale = warmStartScale;
        IsRelaxation = isRelaxation;
        RigidJoints = new(this, Joints);
        RigidServos = new(this, Servos);
    }

    Substep(in Substep swept, in SubstepStiffness joints, in SubstepStiffness servos)
    {
        this = swept;
        Joints = joints;
        Servos = servos;
        Hubs = SubstepStiffness.Direct;
        RigidJoints = new(this, Joints);
        RigidServos = new(this, Servos);
    }

    /// <summary>The same for joints that are solved all at once: what no sweep could hold.</summary>
    internal Substep Directly() => new(this, SubstepStiffness.Direct, SubstepStiffness.Direct);

    /// <summary>The same for limits and servos among them. What a game gave no frequency goes back as fast as by sweeps, however hard it is.</summary>
    internal Substep DirectlyWithBounds() => new(this, SubstepStiffness.DirectWithRate(Joints), SubstepStiffness.DirectWithRate(Servos));
}

/// <summary>How stiff one kind of constraint may be in a substep.</summary>
/// <param name="rigidCycles">Frequency of rigid constraints, in periods per substep.</param>
/// <param name="greatestCycles">Upper limit of frequencies that a game gives, in periods per substep.</param>
public readonly struct SubstepStiffness(float rigidCycles, float greatestCycles)
{
    /// <summary>Frequency of joints that are solved all at once, in periods per substep: they give way by 3e-5 of what a sweep with one does.</summary>
    // Where there are loops, rows that do not give at all would turn the rounding of poses into great impulses between rows that nearly say the same.
    internal const float DirectCycles = 30;

    /// <summary>What such joints give way by, as a part of their own K: 1 / (w h (w h + 2)).</summary>
    internal const double DirectSoftness = 1 / (Math.Tau * DirectCycles * (Math.Tau * DirectCycles + 2));

    // Beyond half a period per substep an implicit spring has no stiffness left to gain.
    const float MaximumCycles = 0.5f;

    /// <summary>Angular frequency of rigid constraints times the length of the substep: that of the usual substep, and more with relaxations.</summary>
    public readonly float RigidFrequencyDt = MathF.Tau * rigidCycles;
    /// <summary>Greatest angular frequency that a game may give, times the length of the substep: at it the sweeps are stable without relaxations.</summary>
    public readonly float GreatestFrequencyDt = MathF.Tau * greatestCycles;

    /// <summary>Stiffness of joints that are solved all at once.</summary>
    internal static SubstepStiffness Direct => new(DirectCycles, DirectCycles);

    /// <summary>The same, with the rate at which others correct what has no frequency.</summary>
    internal static SubstepStiffness DirectWithRate(in SubstepStiffness others) => new(others.RigidFrequencyDt / MathF.Tau, DirectCycles);

    /// <summary>Frequency of joints that a number of sweeps can hold, in periods per substep.</summary>
    // The worst case is an exactly straight chain: with one sweep it is stable at 0.125 and diverges at 0.25. Each further sweep, of either
    // kind, moves a load over one more joint and is worth another 0.125 up to three, and half as much from there. Joints of bodies that have
    // three or more are no stiffer than contacts (Solver.Hubs.cs).
    internal static float JointCycles(int iterations, int relaxations = 0)
    {
        var sweeps = iterations + relaxations;
        return MathF.Min(MathF.Min(0.125f * sweeps, 0.0625f * (sweeps + 3)), MaximumCycles);
    }

    /// <summary>Frequency of contacts that a number of sweeps can hold, in periods per substep.</summary>
    // The worst case is a heap of many boxes: pyramids of 20 layers stay where they are with these values, and begin to shift at 0.25 with
    // two sweeps, 0.4 with four and 0.5 with six.
    internal static float ContactCycles(int iterations, int relaxations = 0) => MathF.Min(0.0625f * (iterations + relaxations + 1), MaximumCycles);
}
