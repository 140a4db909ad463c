using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;

namespace BepuPhysics.CollisionDetection;

// A static that a game moves has no velocity: to the load path it is ground that rests, and what it is put into moves, by the speed at which contacts push that
// out. Held like a load, that would be brought to rest in each substep, and the body would stay in what pushes it. So in the step after a static was put into
// something its contacts are springs that a game asked for, of which the load path takes none, as stiff as others are. What is moved along under a body, or
// away from it, takes nothing of that: as LoadPathStage.Elsewhere has it for kinematic bodies.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // As stiff and damped as what is rigid.
    SpringSettings LikeRigid => new() { AngularFrequency = Simulation.Solver.RigidContactFrequency, TwiceDampingRatio = 2 };

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void LetGoOfMoved(in CollidablePair pair, in Vector3 normal, ref PairMaterialProperties material)
    {
        if (Simulation.Statics.AnyMoved && pair.B.Mobility == CollidableMobility.Static && material.SpringSettings.AngularFrequency == 0 &&
            Simulation.Statics.WasMovedInto(pair.B.StaticHandle, normal))
            material.SpringSettings = LikeRigid;
    }
}
