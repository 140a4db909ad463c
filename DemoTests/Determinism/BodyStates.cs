using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Determinism;

/// <summary>Where bodies were and how they moved, after each step.</summary>
sealed class BodyStates
{
    const int VectorsPerBody = 3;

    readonly List<Vector3[]> steps = [];

    /// <summary>Steps a world.</summary>
    /// <param name="world">The world.</param>
    /// <param name="bodies">The bodies that are looked at.</param>
    /// <param name="count">Number of steps.</param>
    /// <param name="beforeStep">Called before each.</param>
    public static BodyStates Of(TestWorld world, List<BodyHandle> bodies, int count, Action<int>? beforeStep = null)
    {
        var states = new BodyStates();
        for (int step = 0; step < count; ++step)
        {
            beforeStep?.Invoke(step);
            world.Step();
            var state = new Vector3[bodies.Count * VectorsPerBody];
            for (int i = 0; i < bodies.Count; ++i)
            {
                var body = world.Bodies[bodies[i]];
                (state[i * VectorsPerBody], state[i * VectorsPerBody + 1], state[i * VectorsPerBody + 2]) =
                    (body.Pose.Position, body.Velocity.Linear, body.Velocity.Angular);
            }
            states.steps.Add(state);
        }
        return states;
    }

    /// <summary>Fails where a bit of others is another.</summary>
    public void AssertSame(BodyStates others, string with)
    {
        Assert.Equal(steps.Count, others.steps.Count);
        for (int step = 0; step < steps.Count; ++step)
        {
            for (int i = 0; i < steps[step].Length; ++i)
                Assert.True(steps[step][i].Equals(others.steps[step][i]),
                    $"With {with}, step {step}, body {i / VectorsPerBody}, {i % VectorsPerBody}: {steps[step][i]:R} became {others.steps[step][i]:R}.");
        }
    }
}
