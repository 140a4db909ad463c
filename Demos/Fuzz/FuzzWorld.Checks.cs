using System.Numerics;
using BepuPhysics;
using BepuUtilities.Diagnostics;

namespace Demos.Fuzz;

sealed partial class FuzzWorld
{
    // Walking all invariants takes longer than most calls.
    const int CallsPerValidation = 7;

    /// <summary>What must hold after any call.</summary>
    public void Check(int call)
    {
        Sync();
        DisposeLostHulls(false);
        if (Bodies.Live.Count != Simulation.Bodies.CountBodies())
            throw new FuzzFailure($"{Simulation.Bodies.CountBodies()} bodies, {Bodies.Live.Count} handles");
        if (Statics.Live.Count != Simulation.Statics.Count)
            throw new FuzzFailure($"{Simulation.Statics.Count} statics, {Statics.Live.Count} handles");
        if (call % CallsPerValidation != 0)
            return;
        try
        {
            Simulation.Validate();
        }
        catch (PhysicsInvariantException error)
        {
            throw new FuzzFailure("invalid state: " + error.Message, error);
        }
    }

    /// <summary>Whether the state of every body is made of numbers.</summary>
    public bool IsFinite()
    {
        ref BodySet set = ref Simulation.Bodies.ActiveSet;
        for (int i = 0; i < set.Count; ++i)
        {
            ref MotionState motion = ref set.MotionStates[i];
            Vector3 sum = motion.Pose.Position * 0 + motion.Velocity.Linear * 0 + motion.Velocity.Angular * 0;
            Quaternion q = motion.Pose.Orientation * 0f;
            if (sum != Vector3.Zero || q.X + q.Y + q.Z + q.W != 0)
                return false;
        }
        return true;
    }
}
