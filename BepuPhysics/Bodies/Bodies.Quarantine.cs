namespace BepuPhysics;

public sealed partial class Bodies
{
    /// <summary>Makes a body kinematic in the middle of a step, between two stages.</summary>
    internal void MakeKinematic(BodyHandle handle)
    {
        // Its contacts go.
        world.ReadUnread();
        ChangeInertia(handle, default);
    }

    /// <summary>The constraints of a body of the active set forget what they have pushed so far.</summary>
    internal void ForgetImpulses(int index)
    {
        foreach (var constraint in new BodyConstraints(solver, ActiveSet.Constraints[index]))
            solver.ForgetImpulses(constraint.ConnectingConstraintHandle);
    }
}
