using System;
using System.Threading;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;

namespace Demos.Fuzz;

/// <summary>What the callbacks of a world do wrong, and in which of their calls. Shared by all threads of a step.</summary>
sealed class FuzzPlan
{
    int callsLeft = -1;
    Action? action;

    /// <summary>Materials of pairs; bad ones where that is asked for.</summary>
    public PairMaterialProperties Material = new(0.5f, 2, SpringSettings.Rigid);
    /// <summary>Added to the speculative margin.</summary>
    public float Margin;
    /// <summary>Number of contacts that is written to manifolds; none where it is below 0.</summary>
    public int ContactCount = -1;
    /// <summary>Written to a velocity; nothing where it is 0.</summary>
    public float Velocity;
    /// <summary>Whether pairs are refused.</summary>
    public bool RefusesPairs;

    /// <summary>Whether one thread makes the step: nothing else goes on while it is in a callback.</summary>
    public bool IsAlone;

    /// <summary>Does something in a callback to come, once.</summary>
    public void Do(int afterCalls, Action what)
    {
        action = what;
        callsLeft = afterCalls;
    }

    /// <summary>Ends what was planned; whether it was not done.</summary>
    public void Reset()
    {
        callsLeft = -1;
        action = null;
        Margin = 0;
        ContactCount = -1;
        Velocity = 0;
        RefusesPairs = false;
        Material = new(0.5f, 2, SpringSettings.Rigid);
    }

    /// <summary>Whether a callback was called since this was set to false: a step that is refused then has begun, and is not completed.</summary>
    public bool WasCalled { get; set; }

    /// <summary>To be called by every callback.</summary>
    public void OnCall()
    {
        if (!WasCalled)
            WasCalled = true;
        if (Volatile.Read(ref callsLeft) >= 0 && Interlocked.Decrement(ref callsLeft) == -1)
            action?.Invoke();
    }
}
