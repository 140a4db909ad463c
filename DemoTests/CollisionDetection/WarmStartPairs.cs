using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Demos.References;
using DemoTests.Support;

namespace DemoTests.CollisionDetection;

/// <summary>The pairs of hulls in a simulation whose bounds overlap, and what a search of its own remembers of each.</summary>
sealed class WarmStartPairs(Simulation simulation)
{
    readonly Dictionary<int, DepthSearchShape> hulls = [];
    readonly List<DepthSearchShape> a = [];
    readonly List<DepthSearchShape> b = [];
    readonly List<SearchPlace> places = [];
    readonly List<float> margins = [];
    readonly List<(int A, int B)> keys = [];
    Dictionary<(int A, int B), DepthSearchState> kept = [];

    /// <summary>Pairs of this step that were there in the last one.</summary>
    public int KeptCount { get; private set; }

    /// <summary>Searches all pairs twice: knowing nothing, and with what was kept from the last step.</summary>
    public (SearchOutcome[] Cold, SearchOutcome[] Warm) Search()
    {
        Collect();
        if (keys.Count == 0)
            return ([], []);
        var states = new DepthSearchState[keys.Count];
        KeptCount = 0;
        for (int i = 0; i < states.Length; ++i)
            KeptCount += kept.TryGetValue(keys[i], out states[i]) ? 1 : 0;
        var warm = DepthSearchShape.Find(a, b, places, [.. margins], states);
        kept = new(states.Length);
        for (int i = 0; i < states.Length; ++i)
            kept.Add(keys[i], states[i]);
        return (DepthSearchShape.Find(a, b, places, [.. margins]), warm);
    }

    void Collect()
    {
        a.Clear();
        b.Clear();
        places.Clear();
        margins.Clear();
        keys.Clear();
        var overlaps = new Overlaps([]);
        simulation.BroadPhase.FindOverlaps(ref overlaps);
        foreach (var (leafA, leafB) in overlaps.Found)
        {
            var handleA = simulation.BroadPhase.ActiveLeaves[leafA].BodyHandle;
            var handleB = simulation.BroadPhase.ActiveLeaves[leafB].BodyHandle;
            keys.Add((Math.Min(handleA.Value, handleB.Value), Math.Max(handleA.Value, handleB.Value)));
        }
        keys.Sort();
        foreach (var (valueA, valueB) in keys)
        {
            BodyReference bodyA = simulation.Bodies[new BodyHandle(valueA)], bodyB = simulation.Bodies[new BodyHandle(valueB)];
            a.Add(Hull(bodyA.Collidable.Shape));
            b.Add(Hull(bodyB.Collidable.Shape));
            var toA = ConvexRotation.From(bodyA.Pose.Orientation);
            var offset = toA.RotateBack((Double3)bodyB.Pose.Position - bodyA.Pose.Position);
            var inverse = (DoubleQuaternion)Quaternion.Conjugate(bodyA.Pose.Orientation);
            var turned = DoubleQuaternion.Normalize(inverse * bodyB.Pose.Orientation);
            places.Add(new(ConvexGenerator.ToVector(offset), new((float)turned.X, (float)turned.Y, (float)turned.Z, (float)turned.W)));
            margins.Add(bodyA.Collidable.SpeculativeMargin + bodyB.Collidable.SpeculativeMargin);
        }
    }

    DepthSearchShape Hull(TypedIndex index)
    {
        // The search alone is of interest: any shape does for the reference.
        if (!hulls.TryGetValue(index.Index, out var shape))
            hulls.Add(index.Index, shape = DepthSearchShapes.Of(simulation.Shapes.GetShape<ConvexHull>(index.Index), ConvexShape.Sphere(1)));
        return shape;
    }

    readonly struct Overlaps(List<(int A, int B)> found) : IBroadPhaseOverlapHandler
    {
        public List<(int A, int B)> Found => found;

        // The pit is of statics.
        public void Handle(int workerIndex, int leafA, int leafB, bool bIsStatic)
        {
            if (!bIsStatic)
                found.Add((leafA, leafB));
        }
    }
}
