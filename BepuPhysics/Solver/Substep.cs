using System;

namespace BepuPhysics.Constraints;

/// <summary>The part of a step that the solver is working on.</summary>
public readonly struct Substep
{
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

    /// <summary>How stiff joints may be.</summary>
    public readonly SubstepStiffness Joints;
    /// <summary>How stiff contacts may be.</summary>
    public readonly SubstepStiffness Contacts;

    /// <summary>Describes a substep.</summary>
    /// <param name="index">Index within the step, from 0.</param>
    /// <param name="dt">Length, s.</param>
    /// <param name="warmStartScale">Ratio of the length to the last substep's.</param>
    /// <param name="iterations">Sweeps over the constraints.</param>
    /// <param name="relaxations">Sweeps after the bodies have moved.</param>
    /// <param name="isRelaxation">Whether this is one of the latter.</param>
    /// <param name="steadyDt">Length of the longest substep of late, s, where that is more than <paramref name="dt"/>.</param>
    public Substep(
        int index, float dt, float warmStartScale = 1, int iterations = 1, int relaxations = 0, bool isRelaxation = false, float steadyDt = 0)
    {
        var steadiness = dt / MathF.Max(dt, steadyDt);
        Joints = new(SpringSettings.JointCyclesPerSubstep(iterations, relaxations), steadiness);
        Contacts = new(SpringSettings.ContactCyclesPerSubstep(iterations, relaxations), steadiness);
        Index = index;
        Dt = dt;
        InverseDt = 1 / dt;
        WarmStartScale = warmStartScale;
        IsRelaxation = isRelaxation;
    }
}

/// <summary>How stiff one kind of constraint may be in a substep.</summary>
/// <param name="cyclesPerSubstep">Greatest frequency at which the sweeps of the substep are stable, in periods per substep.</param>
/// <param name="steadiness">Part of it that rigid constraints have; less than 1 after longer substeps.</param>
public readonly struct SubstepStiffness(float cyclesPerSubstep, float steadiness)
{
    /// <summary>Angular frequency of rigid constraints times the length of the substep; at most <see cref="StiffestFrequencyDt"/>.</summary>
    public readonly float RigidFrequencyDt = MathF.Tau * cyclesPerSubstep * steadiness;
    /// <summary>Greatest angular frequency times the length of the substep at which its sweeps are stable.</summary>
    public readonly float StiffestFrequencyDt = MathF.Tau * cyclesPerSubstep;
}
