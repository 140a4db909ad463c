using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuUtilities;
using BepuUtilities.Diagnostics;

namespace Demos.Fuzz;

// Numbers that are no numbers. What is written through a reference is not looked at when it is written, so it is the one thing that may be wrong between
// calls, and only in the body that it was written to, until a stage of a step has looked: a call that is refused, or that is no stage, leaves it.
// Whatever else is not finite was made so by the library.
sealed partial class FuzzWorld
{
    // Bodies that were left not finite by a reference, and how many stages had begun by then.
    readonly Dictionary<BodyHandle, int> unsoundMotions = [];
    readonly Dictionary<BodyHandle, int> unsoundInertias = [];
    readonly List<(int Index, MotionState Motion, BodyInertia Inertia)> hidden = [];
    int stages;

    /// <summary>Whether a number that was written through a reference waits for the next step.</summary>
    public bool HasUnsoundNumbers => unsoundMotions.Count + unsoundInertias.Count > 0;

    /// <summary>How often bodies were stopped because of their numbers.</summary>
    public long StoppedCount { get; set; }

    /// <summary>To be called before something is written through a reference that a step is to look at.</summary>
    // No step looks at what sleeps, and writing wakes nobody. Callbacks may write, but not wake.
    public static void WakeToWrite(BodyReference body)
    {
        if (!body.Awake)
            body.Awake = true;
    }

    /// <summary>To be called when something was written through a reference.</summary>
    public void NoteWritten(BodyReference body)
    {
        if (!IsFinite(body.MotionState))
            unsoundMotions[body.Handle] = stages;
        if (!IsFinite(body.LocalInertia))
            unsoundInertias[body.Handle] = stages;
    }

    /// <summary>Calls a stage of a step, or all of them. When it ends well, every number was looked at that was written before it began.</summary>
    /// <param name="stage">The call.</param>
    /// <param name="looksAtInertias">Whether bounds are predicted: that stage looks at inertias, others at what moves alone.</param>
    public void Look(Action stage, bool looksAtInertias = false)
    {
        int began = ++stages;
        stage();
        ForgetUntil(began, unsoundMotions);
        if (looksAtInertias)
            ForgetUntil(began, unsoundInertias);
    }

    /// <summary>Which bodies wait for a step to look at them: a snapshot that is taken now holds their numbers.</summary>
    public void SaveUnsound(List<BodyHandle> motions, List<BodyHandle> inertias)
    {
        motions.Clear();
        motions.AddRange(unsoundMotions.Keys);
        inertias.Clear();
        inertias.AddRange(unsoundInertias.Keys);
    }

    /// <summary>To be called when a snapshot was restored: what was written before it was taken is there again.</summary>
    public void RestoreUnsound(List<BodyHandle> motions, List<BodyHandle> inertias)
    {
        Restore(unsoundMotions, motions);
        Restore(unsoundInertias, inertias);
    }

    void Restore(Dictionary<BodyHandle, int> unsound, List<BodyHandle> saved)
    {
        unsound.Clear();
        foreach (BodyHandle body in saved)
            unsound.Add(body, stages);
    }

    static void ForgetUntil(int stage, Dictionary<BodyHandle, int> unsound)
    {
        foreach ((BodyHandle body, int written) in unsound)
        {
            if (written < stage)
                unsound.Remove(body);
        }
    }

    void CheckNumbers()
    {
        ref BodySet set = ref Simulation.Bodies.ActiveSet;
        for (int i = 0; i < set.Count; ++i)
        {
            BodyHandle body = set.IndexToHandle[i];
            if (!IsFinite(set.MotionStates[i]) && !unsoundMotions.ContainsKey(body))
                throw new FuzzFailure($"{body} is not finite: {Describe(set.MotionStates[i])}");
            if (!IsFinite(set.LocalInertias[i]) && !unsoundInertias.ContainsKey(body))
                throw new FuzzFailure($"the inertia of {body} is not finite");
        }
        // Removed, or described anew: what goes wrong with it from now on is no fault of the reference.
        foreach (BodyHandle body in unsoundMotions.Keys)
        {
            if (!Simulation.Bodies.BodyExists(body) || IsFinite(Simulation.Bodies[body].MotionState))
                unsoundMotions.Remove(body);
        }
        foreach (BodyHandle body in unsoundInertias.Keys)
        {
            if (!Simulation.Bodies.BodyExists(body) || IsFinite(Simulation.Bodies[body].LocalInertia))
                unsoundInertias.Remove(body);
        }
    }

    // All but what was written through references must be valid, and what was written must be noticed.
    void Validate()
    {
        if (!HasUnsoundNumbers)
        {
            Require();
            return;
        }
        try
        {
            Simulation.Validate();
        }
        catch (PhysicsInvariantException)
        {
            Hide();
            try
            {
                Require();
            }
            finally
            {
                Unhide();
            }
            return;
        }
        throw new FuzzFailure("a number that is not finite was called valid");
    }

    void Require()
    {
        try
        {
            Simulation.Validate();
        }
        catch (PhysicsInvariantException error)
        {
            throw new FuzzFailure("invalid state: " + error.Message, error);
        }
    }

    void Hide()
    {
        hidden.Clear();
        ref BodySet set = ref Simulation.Bodies.ActiveSet;
        for (int i = 0; i < set.Count; ++i)
        {
            if (IsFinite(set.MotionStates[i]) && IsFinite(set.LocalInertias[i]))
                continue;
            hidden.Add((i, set.MotionStates[i], set.LocalInertias[i]));
            if (!IsFinite(set.MotionStates[i]))
                set.MotionStates[i] = new() { Pose = RigidPose.Identity };
            // What has no finite inertia counts as dynamic.
            if (!IsFinite(set.LocalInertias[i]))
                set.LocalInertias[i] = new() { InverseMass = 1 };
        }
    }

    void Unhide()
    {
        ref BodySet set = ref Simulation.Bodies.ActiveSet;
        foreach ((int index, MotionState motion, BodyInertia inertia) in hidden)
        {
            set.MotionStates[index] = motion;
            set.LocalInertias[index] = inertia;
        }
    }

    static string Describe(in MotionState motion) => FormattableString.Invariant(
        $"{motion.Pose.Position} {motion.Pose.Orientation} v {motion.Velocity.Linear} w {motion.Velocity.Angular}");

    static bool IsFinite(in MotionState motion)
    {
        Vector3 sum = motion.Pose.Position * 0 + motion.Velocity.Linear * 0 + motion.Velocity.Angular * 0;
        Quaternion q = motion.Pose.Orientation * 0f;
        return sum == Vector3.Zero && q.X + q.Y + q.Z + q.W == 0;
    }

    static bool IsFinite(in BodyInertia inertia)
    {
        ref readonly Symmetric3x3 i = ref inertia.InverseInertiaTensor;
        return (i.XX * 0) + (i.YX * 0) + (i.YY * 0) + (i.ZX * 0) + (i.ZY * 0) + (i.ZZ * 0) + (inertia.InverseMass * 0) == 0;
    }
}
