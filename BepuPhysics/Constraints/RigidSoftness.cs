using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>Coefficients of joints that a game gave no frequency: the same for all of them, but for those of hubs.</summary>
/// <param name="substep">The substep, and what its present sweep is for.</param>
/// <param name="limits">How stiff the kind of joint may be in it.</param>
readonly struct RigidSoftness(in Substep substep, in SubstepStiffness limits)
{
    readonly Coefficients others = new(substep, limits.RigidFrequencyDt);
    readonly Coefficients hubs = new(substep, MathHelper.Min(limits.RigidFrequencyDt, substep.Hubs.RigidFrequencyDt));

    /// <summary>The coefficients of a bundle.</summary>
    /// <param name="hubMask">Lanes of hubs.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal SoftnessWide Widen(Vector<int> hubMask)
    {
        SoftnessWide softness;
        softness.ErrorToVelocity = Wide.Select(hubMask, new Vector<float>(hubs.ErrorToVelocity), new Vector<float>(others.ErrorToVelocity));
        softness.MassScale = Wide.Select(hubMask, new Vector<float>(hubs.MassScale), new Vector<float>(others.MassScale));
        softness.ImpulseScale = Wide.Select(hubMask, new Vector<float>(hubs.ImpulseScale), new Vector<float>(others.ImpulseScale));
        return softness;
    }

    // As for springs, whose formulas are derived there; each operation is that of a lane, and so are the bits.
    readonly struct Coefficients
    {
        internal readonly float ErrorToVelocity;
        internal readonly float MassScale;
        internal readonly float ImpulseScale;

        internal Coefficients(in Substep substep, float frequencyDt)
        {
            if (substep.IsRelaxation)
            {
                MassScale = 1;
                return;
            }
            var sum = frequencyDt + 2;
            var product = frequencyDt * sum;
            MassScale = product / (product + 1);
            ImpulseScale = 1 - MassScale;
            ErrorToVelocity = frequencyDt * substep.InverseDt / sum;
        }
    }
}
