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

    /// <summary>Angular frequency of rigid constraints times the length of the substep; at most <see cref="StiffestFrequencyDt"/>.</summary>
    public readonly float RigidFrequencyDt;
    /// <summary>Greatest angular frequency times the length of the substep at which its sweeps are stable.</summary>
    public readonly float StiffestFrequencyDt;

    /// <summary>Describes a substep.</summary>
    /// <param name="index">Index within the step, from 0.</param>
    /// <param name="dt">Length, s.</param>
    /// <param name="warmStartScale">Ratio of the length to the last substep's.</param>
    /// <param name="iterations">Sweeps over the constraints.</param>
    /// <param name="steadyDt">Length of the longest substep of late, s, where that is more than <paramref name="dt"/>.</param>
    public Substep(int index, float dt, float warmStartScale = 1, int iterations = 1, float steadyDt = 0)
    {
        StiffestFrequencyDt = MathF.Tau * SpringSettings.CyclesPerSubstep(iterations);
        RigidFrequencyDt = StiffestFrequencyDt * (dt / MathF.Max(dt, steadyDt));
        Index = index;
        Dt = dt;
        InverseDt = 1 / dt;
        WarmStartScale = warmStartScale;
    }
}
