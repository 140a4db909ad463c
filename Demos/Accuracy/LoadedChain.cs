using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.References;

namespace Demos.Accuracy;

/// <summary>A chain of links of 1 kg that hangs in a point, with a load at its end.</summary>
sealed class LoadedChain
{
    const float LinkLength = .2f;

    readonly AccuracyWorld world;
    readonly BodyHandle[] links;
    readonly float load;

    /// <param name="world">World to add to.</param>
    /// <param name="start">How it begins.</param>
    /// <param name="linkCount">Number of links without the load.</param>
    /// <param name="load">Mass at the end, kg.</param>
    /// <param name="spring">Of the joints; null for that of the world.</param>
    public LoadedChain(AccuracyWorld world, ChainStart start, int linkCount, float load, SpringSettings? spring = null)
    {
        this.world = world;
        this.load = load;
        links = new BodyHandle[linkCount + 1];
        bool hanging = start is ChainStart.HangingStraight or ChainStart.HangingKicked;
        var straight = hanging ? -Vector3.UnitY : Vector3.UnitX;
        var stiffness = spring ?? world.Settings.Spring;
        var link = new Capsule(.05f, LinkLength - .1f);
        var joint = world.AddAnchor(Vector3.Zero);
        var jointOffset = Vector3.Zero;
        var end = Vector3.Zero;
        for (int i = 0; i <= linkCount; ++i)
        {
            // Links lie along their local Y, so that the last joint's offset is +Y of each.
            float bend = start == ChainStart.HorizontalZigzag ? (i % 2 == 0 ? .02f : -.02f) : 0;
            var direction = bend == 0 ? straight : Vector3.Normalize(straight + new Vector3(0, bend, bend));
            var orientation = hanging ? Quaternion.Identity : FromMinusY(direction);
            float half = LinkLength / 2;
            var pose = new RigidPose(end + direction * half, orientation);
            links[i] = i < linkCount ? world.AddDynamic(link, 1, pose) : world.AddDynamic(new Sphere(half), load, pose);
            var socket = new BallSocket { LocalOffsetA = jointOffset, LocalOffsetB = new Vector3(0, half, 0), SpringSettings = stiffness };
            world.Simulation.Solver.Add(joint, links[i], socket);
            (joint, jointOffset) = (links[i], new Vector3(0, -half, 0));
            end += direction * LinkLength;
        }
        if (start == ChainStart.HangingKicked)
            world.Bodies[links[linkCount]].Velocity.Linear = new Vector3(.5f, 0, .25f);
    }

    /// <summary>Kinetic energy of the motion of the centres, and potential energy, J.</summary>
    public double Energy
    {
        get
        {
            double energy = 0;
            for (int i = 0; i < links.Length; ++i)
            {
                double mass = i < links.Length - 1 ? 1 : load;
                energy += mass * (world.LinearVelocity(links[i]).LengthSquared / 2 - Double3.Dot(world.Settings.Gravity, world.Position(links[i])));
            }
            return energy;
        }
    }

    /// <summary>Mean gap of the joints as a part of a link's length, and the worst gap so far in metres.</summary>
    public void Gaps(out double meanStretch, ref double worst)
    {
        double sum = 0;
        var end = Double3.Zero;
        foreach (var body in links)
        {
            var half = world.Orientation(body).Rotate(new(0, LinkLength / 2, 0));
            double gap = (world.Position(body) + half - end).Length;
            sum += gap;
            worst = Tally.Most(worst, gap);
            end = world.Position(body) - half;
        }
        meanStretch = sum / links.Length / LinkLength;
    }

    /// <summary>Turns -Y into a direction.</summary>
    static Quaternion FromMinusY(Vector3 direction)
    {
        var axis = Vector3.Cross(-Vector3.UnitY, direction);
        return Quaternion.CreateFromAxisAngle(Vector3.Normalize(axis), System.MathF.Atan2(axis.Length(), -direction.Y));
    }
}

/// <summary>How a chain begins. Exactly straight is the worst case for a stiff solver: nothing can buckle away.</summary>
public enum ChainStart
{
    HangingStraight,
    HangingKicked,
    HorizontalStraight,
    HorizontalZigzag,
}
