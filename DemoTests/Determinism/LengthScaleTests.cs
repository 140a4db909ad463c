using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Demos.Engine;
using Demos.Running;
using Demos.Scenes;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Determinism;

/// <summary>
/// No length, time or speed is built in. Under the same gravity a world of four times the length goes the same way in twice the time: with powers of two,
/// positions to the bit, and orientations but for components that are rounding.
/// </summary>
// g = length / time^2, so lengths are times 4^k and times are times 2^k; speeds times 2^k, rates times 2^-k. Masses stay, and inertias follow their shapes.
public class LengthScaleTests
{
    const int Steps = 40;
    // What was seen: components of 1e-11 and less that differ by 1e-13 at most. Why they do was not looked into.
    const float OrientationTolerance = 1e-12f;

    static readonly Dictionary<string, Func<SceneDescription>> scenes = new()
    {
        ["pyramids"] = () => SmallScenes.Pyramids(count: 3, baseCount: 10),
        ["cloth-lattice"] = () => SmallScenes.Lattice(width: 16),
        ["shape-pile"] = () => SmallScenes.Pile("shape-pile", columns: 4, layers: 6),
        ["hull-pile"] = () => SmallScenes.Pile("hull-pile", columns: 4, layers: 4),
    };

    public static TheoryData<string, int> Cases()
    {
        var cases = new TheoryData<string, int>();
        foreach (var name in scenes.Keys.Concat(["towers", "cylinder-tower", "newton", "rolling", "slope", "coins", "washer", "tiles", "ragdolls"]))
        {
            cases.Add(name, -2);
            cases.Add(name, 1);
        }
        return cases;
    }

    [Theory]
    [MemberData(nameof(Cases))]
    public void A_world_of_another_size_goes_the_same_way(string name, int power)
    {
        var scene = scenes.TryGetValue(name, out var create) ? create() : SceneLibrary.Load(name, 1);
        var expected = Run(scene, 0);
        var actual = Run(scene, power);
        for (int step = 0; step < Steps; ++step)
        {
            for (int body = 0; body < expected[step].Length; ++body)
            {
                var ((position, orientation), (nowPosition, nowOrientation)) = (expected[step][body], actual[step][body]);
                Assert.True(position == nowPosition, $"step {step}, body {body}: {position:R} became {nowPosition:R}, in lengths of its own");
                var difference = (orientation - nowOrientation).Length();
                Assert.True(difference <= OrientationTolerance, $"step {step}, body {body}: its orientation is another by {difference}");
            }
        }
    }

    static List<(Vector3, Quaternion)[]> Run(SceneDescription scene, int power)
    {
        var time = MathF.ScaleB(1, power);
        var length = time * time;
        using var pool = new BufferPool();
        var recorder = new ContactRecorder(1);
        using var simulation = Simulation.Create(
            pool,
            new SceneNarrowPhaseCallbacks(recorder,
                new PairMaterialProperties(scene.Friction, EngineDefaults.MaximumRecoveryVelocity * (length / time), EngineDefaults.ContactSpring)),
            new ScenePoseIntegratorCallbacks(SceneDescription.Gravity, scene.Damping / time), SolveDescription.Default);
        var built = SceneBuilder.Build(Scale(scene, length, time), simulation, EngineDefaults.JointSpring, recorder, sleep: false);
        var states = new List<(Vector3, Quaternion)[]>();
        for (int step = 0; step < Steps; ++step)
        {
            simulation.Timestep(time / 60);
            states.Add([.. Enumerable.Range(0, built.BodyCount).Select(i => built[i].Pose).Select(pose => (pose.Position / length, pose.Orientation))]);
        }
        return states;
    }

    static SceneDescription Scale(SceneDescription scene, float length, float time)
    {
        var scaled = new SceneDescription { Name = scene.Name };
        scaled.Shapes.AddRange(scene.Shapes.Select(shape => new SceneShape
        {
            Kind = shape.Kind,
            Size = shape.Size * length,
            Points = shape.Points?.Select(point => point * length).ToArray()!,
            Indices = shape.Indices,
        }));
        scaled.Bodies.AddRange(scene.Bodies.Select(body => new SceneBody
        {
            Kind = body.Kind,
            Children = [.. body.Children.Select(child => child with { Position = child.Position * length })],
            Mass = body.Mass,
            Position = body.Position * length,
            Orientation = body.Orientation,
            LinearVelocity = body.LinearVelocity * (length / time),
            AngularVelocity = body.AngularVelocity / time,
            Group = body.Group,
        }));
        scaled.Joints.AddRange(scene.Joints.Select(joint => new SceneJoint
        {
            Kind = joint.Kind,
            BodyA = joint.BodyA,
            BodyB = joint.BodyB,
            AnchorA = joint.AnchorA * length,
            AnchorB = joint.AnchorB * length,
            MaximumSwing = joint.MaximumSwing,
            MinimumTwist = joint.MinimumTwist,
            MaximumTwist = joint.MaximumTwist,
        }));
        return scaled;
    }
}
