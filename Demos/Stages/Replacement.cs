using System.Collections.Generic;
using BepuPhysics;

namespace Demos.Stages;

/// <summary>Takes bodies out of a simulation, in turn, and adds them anew as they were at the start: rain that does not end.</summary>
sealed class Replacement
{
    readonly Simulation simulation;
    readonly int countPerStep;
    readonly List<BodyHandle> handles = [];
    readonly List<BodyDescription> descriptions = [];
    int next;

    public Replacement(Simulation simulation, int countPerStep)
    {
        this.simulation = simulation;
        this.countPerStep = countPerStep;
        ref BodySet active = ref simulation.Bodies.ActiveSet;
        for (int i = 0; i < active.Count; ++i)
        {
            handles.Add(active.IndexToHandle[i]);
            descriptions.Add(simulation.Bodies.GetDescription(active.IndexToHandle[i]));
        }
    }

    /// <summary>Replaces those whose turn it is.</summary>
    public void Step()
    {
        for (int i = 0; i < countPerStep; ++i)
        {
            simulation.Bodies.Remove(handles[next]);
            handles[next] = simulation.Bodies.Add(descriptions[next]);
            next = (next + 1) % handles.Count;
        }
    }
}
