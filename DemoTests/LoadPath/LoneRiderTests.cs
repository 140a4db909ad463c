using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.LoadPath;

/// <summary>What rests alone on a kinematic body goes where that takes it, and is none of those whose loads are handed down one by one.</summary>
public class LoneRiderTests(ITestOutputHelper output)
{
    const float Dt = 1 / 60f;
    const float Gravity = 10;

    // Platforms far from each other, of which each moves in its own phase and carries so many boxes of its own size, one on the other.
    sealed class Platforms : IDisposable
    {
        readonly BufferPool pool = new();
        readonly List<(BodyHandle Platform, BodyHandle Box, Vector3 Place)> riders = [];
        readonly Func<double, int, BodyVelocity> motion;
        int step;

        internal Platforms(Func<double, int, BodyVelocity> motion, int count, int boxes = 1, float size = 1)
        {
            this.motion = motion;
            Simulation = Simulation.Create(
                pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(new Vector3(0, -Gravity * size, 0)), SolveDescription.Default);
            var platform = Simulation.Shapes.Add(new Box(4 * size, size, 4 * size));
            var random = new Random(7);
            for (int i = 0; i < count; ++i)
            {
                var home = new Vector3(i % 8 * 9, 0, i / 8 * 9) * size;
                var handle = Simulation.Bodies.Add(BodyDescription.CreateKinematic(home, platform, -1));
                var side = size * (0.5f + 0.1f * (i % 5));
                var foot = home + new Vector3(0.6f * random.NextSingle(), 0.5f, 0.6f * random.NextSingle()) * size;
                for (int level = 0; level < boxes; ++level)
                {
                    var place = foot + new Vector3(0, side * (level + 0.5f), 0);
                    var body = BodyDescription.CreateConvexDynamic(place, 1 + i % 7, Simulation.Shapes, new Box(side, side, side));
                    body.Activity.SleepThreshold = -1;
                    riders.Add((handle, Simulation.Bodies.Add(body), place - home));
                }
            }
        }

        internal Simulation Simulation { get; }

        // Greatest way that a box has gone on its platform, as seen from that, in double precision.
        internal double Moved
        {
            get
            {
                double moved = 0;
                foreach (var (platform, box, place) in riders)
                {
                    ref var pose = ref Simulation.Bodies[platform].Pose;
                    var (x, y, z) = Seen(Simulation.Bodies[box].Pose.Position - pose.Position, pose.Orientation);
                    moved = Math.Max(moved, Math.Sqrt(Square(x - place.X) + Square(y - place.Y) + Square(z - place.Z)));
                }
                return moved;
            }
        }

        internal void Run(double seconds, IThreadDispatcher? dispatcher = null)
        {
            for (int end = step + (int)Math.Round(seconds / Dt); step < end; ++step)
            {
                for (int i = 0; i < riders.Count; ++i)
                    Simulation.Bodies[riders[i].Platform].Velocity = motion(step * (double)Dt, Simulation.Bodies[riders[i].Platform].Handle.Value);
                Simulation.Timestep(Dt, dispatcher);
            }
        }

        public void Dispose()
        {
            Simulation.Dispose();
            pool.Clear();
        }

        static double Square(double value) => value * value;

        // v + 2 u x (u x v + w v) for the conjugate of a quaternion.
        static (double X, double Y, double Z) Seen(Vector3 v, Quaternion q)
        {
            double x = -q.X, y = -q.Y, z = -q.Z, w = q.W;
            var (cx, cy, cz) = (y * v.Z - z * v.Y + w * v.X, z * v.X - x * v.Z + w * v.Y, x * v.Y - y * v.X + w * v.Z);
            return (v.X + 2 * (y * cz - z * cy), v.Y + 2 * (z * cx - x * cz), v.Z + 2 * (x * cy - y * cx));
        }
    }

    static BodyVelocity Velocity(string motion, double time, int body, float size = 1)
    {
        var phase = time + body;
        return motion switch
        {
            "stands" => default,
            "straight" => new(new Vector3(0.2f, 0.05f * (body % 3 - 1), 0.1f) * size),
            "sways" => new(new Vector3((float)Math.Cos(phase), 0.3f * (float)Math.Cos(1.3 * phase), (float)Math.Sin(phase)) * (0.3f * size)),
            "turns" => new(default, new Vector3(0, 0.3f, 0)),
            "turns to and fro" => new(default, new Vector3(0, 0.4f * (float)Math.Cos(phase), 0)),
            "tips" => new(default, new Vector3(0.05f * (float)Math.Cos(time), 0, 0.05f * (float)Math.Sin(time))),
            _ => throw new ArgumentException(motion),
        };
    }

    [Theory]
    [InlineData("stands", 1), InlineData("straight", 1), InlineData("sways", 1)]
    [InlineData("turns", 1), InlineData("turns to and fro", 1), InlineData("tips", 1)]
    [InlineData("straight", 1e-3f), InlineData("sways", 1e-3f), InlineData("straight", 50), InlineData("sways", 50)]
    public void One_box_goes_where_its_platform_does(string motion, float size)
    {
        // From rest: what starts at once leaves behind what stands on it.
        using var platforms = new Platforms((time, body) => Scaled(Velocity(motion, time, body, size), (float)Math.Min(time, 1)), 24, 1, size);
        platforms.Run(1.5);
        var nodes = 0;
        for (int step = 0; step < 240; ++step)
        {
            platforms.Run(Dt);
            nodes += platforms.Simulation.NarrowPhase.LoadNodeCount;
        }
        output.WriteLine($"moved {platforms.Moved / size:e2} of the size, {nodes} nodes of {24 * 240}");
        Assert.InRange(platforms.Moved / size, 0, 1e-3);
        // What a turn that changes takes from a box is not known before the warm start has given it.
        if (motion != "turns to and fro")
            Assert.InRange(nodes, 0, 24 * 240 / 20);
    }

    [Theory, InlineData("straight"), InlineData("sways"), InlineData("turns")]
    public void What_bears_another_hands_its_load_down_as_before(string motion)
    {
        using var platforms = new Platforms((time, body) => Scaled(Velocity(motion, time, body), (float)Math.Min(time, 1)), 24, 2);
        platforms.Run(3);
        output.WriteLine($"moved {platforms.Moved:e2}");
        Assert.InRange(platforms.Moved, 0, 2e-3);
        Assert.Equal(48, platforms.Simulation.NarrowPhase.LoadNodeCount);
    }

    [Theory, InlineData("sways"), InlineData("turns"), InlineData("tips")]
    public void Threads_make_no_difference(string motion)
    {
        using var dispatcher = new ThreadDispatcher(3);
        using var one = new Platforms((time, body) => Velocity(motion, time, body), 300);
        using var three = new Platforms((time, body) => Velocity(motion, time, body), 300);
        for (int i = 0; i < 40; ++i)
        {
            one.Run(Dt);
            three.Run(Dt, dispatcher);
            Assert.Equal(one.Simulation.StateHash(), three.Simulation.StateHash());
        }
    }

    static BodyVelocity Scaled(BodyVelocity velocity, float share) => new(velocity.Linear * share, velocity.Angular * share);
}
