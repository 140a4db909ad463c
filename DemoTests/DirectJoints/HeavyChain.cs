using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using DemoTests.Scenes;
using DemoTests.Support;

namespace DemoTests.DirectJoints;

/// <summary>Light links with a heavy load at their end, drawn by lot: how many, how large, of which joints, how they hang and are kicked.</summary>
sealed class HeavyChain : IDisposable
{
    const double Gravity = 9.81;

    readonly List<BodyHandle> bodies = [];
    readonly List<(BodyHandle A, BodyHandle B)> joints = [];
    readonly float size;
    readonly double start;
    readonly double scale;

    /// <summary>Draws one.</summary>
    /// <param name="seed">Which.</param>
    /// <param name="crooked">By how much a link may be turned against the chain, rad; joints are where they should be all the same.</param>
    /// <param name="zigzag">Whether all links are turned by that, to and fro.</param>
    /// <param name="substeps">Number of substeps.</param>
    public HeavyChain(int seed, float crooked, bool zigzag = false, int substeps = 4)
    {
        World = new TestWorld(new AccuracySettings { Contacts = ContactScope.None, SubstepCount = substeps });
        var random = new Random(seed);
        float Uniform(float from, float to) => from + random.NextSingle() * (to - from);
        var count = random.Next(3, 41);
        size = Uniform(.2f, 1);
        var box = new Box(size, size * Uniform(.3f, 1), size * Uniform(.3f, 1));
        var load = MathF.Pow(10, Uniform(3, 4));
        var along = random.Next(2) == 0 ? -Vector3.UnitY : Vector3.UnitX;
        var turn = along.X > 0 ? Quaternion.Identity : Quaternion.CreateFromAxisAngle(Vector3.UnitZ, -MathF.PI / 2);
        var kick = new Vector3(Uniform(-3, 3), Uniform(-1, 1), Uniform(-3, 3));
        var type = random.Next(3);
        var half = new Vector3(size / 2, 0, 0);
        bodies.Add(World.AddKinematic(box, new RigidPose(default, turn)));
        var end = Vector3.Transform(half, turn);
        for (int i = 1; i <= count; ++i)
        {
            var angle = i == count ? 0 : zigzag ? (i % 2 * 2 - 1) * crooked : Uniform(-crooked, crooked);
            var own = turn * Quaternion.CreateFromAxisAngle(Vector3.UnitZ, angle);
            var center = end + Vector3.Transform(half, own);
            end = center + Vector3.Transform(half, own);
            bodies.Add(World.AddDynamic(box, i < count ? 1 : load, new RigidPose(center, own), new BodyVelocity(i < count ? default : kick)));
            joints.Add((bodies[i - 1], bodies[i]));
            if (type == 0)
                World.Solver.Add(bodies[i - 1], bodies[i], new BallSocket { LocalOffsetA = half, LocalOffsetB = -half });
            else if (type == 1)
                World.Solver.Add(bodies[i - 1], bodies[i], HingeAt(half));
            else
                World.Solver.Add(bodies[i - 1], bodies[i], SwivelAt(half));
        }
        start = Energy;
        scale = (count - 1 + load) * Gravity * size * count + .5 * load * kick.LengthSquared();
    }

    static Hinge HingeAt(Vector3 half) => new()
    {
        LocalOffsetA = half,
        LocalOffsetB = -half,
        LocalHingeAxisA = Vector3.UnitZ,
        LocalHingeAxisB = Vector3.UnitZ,
    };

    static SwivelHinge SwivelAt(Vector3 half) => new()
    {
        LocalOffsetA = half,
        LocalOffsetB = -half,
        LocalSwivelAxisA = Vector3.UnitX,
        LocalHingeAxisB = Vector3.UnitZ,
    };

    public TestWorld World { get; }

    double Energy => bodies.Skip(1).Sum(handle => BodyEnergy.Of(World.Bodies[handle], Gravity));

    /// <summary>Energy beyond that of the beginning, as a part of what there is: the fall of all by the length of the chain, and the kick.</summary>
    public double Gain => (Energy - start) / scale;

    /// <summary>Mean gap, as a part of a link.</summary>
    public float Stretch => joints.Average(joint =>
        (DirectStructures.Point(World, joint.A, size / 2) - DirectStructures.Point(World, joint.B, -size / 2)).Length()) / size;

    public void Dispose() => World.Dispose();
}
