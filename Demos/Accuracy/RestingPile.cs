using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.References;

namespace Demos.Accuracy;

/// <summary>Bodies that are put where they can rest, and how far they come from there.</summary>
sealed class RestingPile
{
    /// <summary>What the pile may take to sink into its contacts, before it has to be still.</summary>
    const double SettlingTime = 2;
    const int Count = 10;
    const double LogRadius = .2;

    /// <summary>Piles of ten that can be made by name.</summary>
    public static readonly string[] Names =
    [
        .. Solids.Standing, "mixed", "spheres on each other", "spheres in a shaft", "spheres in a wide shaft",
        "capsules crosswise", "cylinders crosswise", "capsules in a groove", "cylinders in a groove",
    ];

    readonly Solids solids;
    readonly List<Resting> bodies = [];
    double top;
    bool isNested, isUneven;

    public RestingPile(Solids solids) => this.solids = solids;

    /// <summary>Makes one of <see cref="Names"/>, and what it rests on.</summary>
    public RestingPile(Solids solids, string name)
        : this(solids)
    {
        var world = solids.World;
        if (!name.EndsWith("groove", StringComparison.Ordinal))
            world.AddGround();
        switch (name)
        {
            case "mixed":
                isUneven = true;
                string[] order =
                    ["box", "cylinder", "hexagonal prism", "random hull", "coin", "cube hull", "octagonal prism", "cylinder", "box", "random hull"];
                for (int i = 0; i < Count; ++i)
                    AddStanding(order[i], yaw: i, seed: i);
                break;
            case "spheres on each other":
                for (int i = 0; i < Count; ++i)
                    AddStanding("sphere");
                break;
            case "spheres in a shaft":
                AddShaft(.3);
                for (int i = 0; i < Count; ++i)
                    AddStanding("sphere");
                break;
            case "spheres in a wide shaft":
                AddZigzag();
                break;
            case "capsules crosswise":
                AddCrosswise("capsule");
                break;
            case "cylinders crosswise":
                AddCrosswise("wheel");
                break;
            case "capsules in a groove":
                AddInGroove("capsule");
                break;
            case "cylinders in a groove":
                AddInGroove("wheel");
                break;
            default:
                isUneven = name == "random hull";
                for (int i = 0; i < Count; ++i)
                    AddStanding(name, seed: i);
                break;
        }
    }

    /// <summary>Puts a solid on top of those that there are, its centre of mass over the origin.</summary>
    public void AddStanding(string name, double yaw = 0, int seed = 1)
    {
        var solid = solids.Create(name, seed);
        Add(solid, new(0, top + solid.Foot, 0), DoubleQuaternion.FromAxisAngle(new(0, 1, 0), yaw));
        top += solid.Height;
    }

    /// <summary>Puts a capsule or wheel down; its axis lies along X, turned about Y.</summary>
    public void AddLying(string name, Double3 position, double yaw = 0) => Add(solids.Create(name), position,
        DoubleQuaternion.FromAxisAngle(new(0, 1, 0), yaw) * DoubleQuaternion.FromAxisAngle(new(0, 0, 1), -Math.PI / 2));

    public void Run(double seconds)
    {
        var world = solids.World;
        double start = world.Time;
        world.Run(seconds, () =>
        {
            bool isSettled = world.Time - start > SettlingTime;
            foreach (var body in bodies)
                body.Look(world, isSettled);
        });
    }

    /// <summary>Adds what was measured: no drift above a millimetre, no turn above half a degree.</summary>
    public CaseResult Judge(CaseResult result)
    {
        double drift = 0, sideways = 0, turned = 0, settled = 0;
        foreach (var body in bodies)
        {
            drift = Tally.Most(drift, body.Drift);
            sideways = Tally.Most(sideways, body.Sideways);
            turned = Tally.Most(turned, body.Turned);
            settled = Tally.Most(settled, body.Settled);
        }
        // Between slanted walls, sinking into the contacts is sideways too; and so it is on uneven corners.
        result = isNested || isUneven ? result.Note("sideways", sideways, "m") : result.Limit("sideways", sideways, .001, "m");
        return result
            .Limit("drift", drift, .001, "m")
            .Limit("turned", turned * 180 / Math.PI, .5, "degrees")
            .Note("settled by", settled, "m");
    }

    void Add(Solid solid, Double3 position, DoubleQuaternion turn)
    {
        var orientation = new Quaternion((float)turn.X, (float)turn.Y, (float)turn.Z, (float)turn.W);
        var body = solid.Place(new RigidPose(new((float)position.X, (float)position.Y, (float)position.Z), orientation));
        bodies.Add(new Resting(solids.World, body));
    }

    /// <summary>Four walls, this far from the middle.</summary>
    void AddShaft(double halfWidth)
    {
        float offset = (float)(halfWidth + .5);
        solids.World.AddStatic(new Box(1, 20, 4), new Vector3(-offset, 10, 0));
        solids.World.AddStatic(new Box(1, 20, 4), new Vector3(offset, 10, 0));
        solids.World.AddStatic(new Box(4, 20, 1), new Vector3(0, 10, -offset));
        solids.World.AddStatic(new Box(4, 20, 1), new Vector3(0, 10, offset));
    }

    /// <summary>Spheres in two opposite corners of a shaft in turn, each on the one before.</summary>
    void AddZigzag()
    {
        const double radius = .3, side = .1;
        isNested = true;
        AddShaft(radius + side);
        double rise = Math.Sqrt(4 * radius * radius - 8 * side * side);
        for (int i = 0; i < Count; ++i)
        {
            double place = i % 2 == 0 ? side : -side;
            Add(solids.Create("sphere"), new(place, radius + i * rise, place), DoubleQuaternion.Identity);
        }
    }

    /// <summary>Ten layers of two, as in a log cabin.</summary>
    void AddCrosswise(string name)
    {
        for (int i = 0; i < Count; ++i)
        {
            double height = LogRadius * (2 * i + 1), aside = .25;
            bool alongX = i % 2 == 0;
            double yaw = alongX ? 0 : Math.PI / 2;
            AddLying(name, alongX ? new(0, height, -aside) : new(-aside, height, 0), yaw);
            AddLying(name, alongX ? new(0, height, aside) : new(aside, height, 0), yaw);
        }
    }

    /// <summary>One, two, three and four parallel logs in a groove with sides of 60 degrees, into which they fit exactly.</summary>
    void AddInGroove(string name)
    {
        isNested = true;
        foreach (double angle in (ReadOnlySpan<double>)[Math.PI / 3, -Math.PI / 3])
        {
            // A slope, ten metres of which lie on either side of the bottom edge, would stick out on the other side; half of it does not.
            var turn = DoubleQuaternion.FromAxisAngle(new(1, 0, 0), angle);
            var center = turn.Rotate(new(0, -1, -Math.Sign(angle) * 3));
            solids.World.AddStatic(new Box(10, 2, 6), new RigidPose(
                new((float)center.X, (float)center.Y, (float)center.Z), new((float)turn.X, (float)turn.Y, (float)turn.Z, (float)turn.W)));
        }
        for (int row = 0; row < 4; ++row)
        {
            for (int i = 0; i <= row; ++i)
                AddLying(name, new(0, LogRadius * (2 + row * Math.Sqrt(3)), LogRadius * (2 * i - row)));
        }
    }

    /// <summary>One body: where it was put, and the farthest that it has come from there.</summary>
    sealed class Resting(AccuracyWorld world, BodyHandle body)
    {
        readonly Double3 start = world.Position(body);
        readonly DoubleQuaternion startTurn = world.Orientation(body);
        Double3 settledAt = world.Position(body);

        /// <summary>Farthest way since the pile has settled.</summary>
        public double Drift { get; private set; }

        /// <summary>Farthest way over the ground since the beginning.</summary>
        public double Sideways { get; private set; }

        /// <summary>Greatest angle to the attitude of the beginning.</summary>
        public double Turned { get; private set; }

        /// <summary>Way until it had settled.</summary>
        public double Settled => (settledAt - start).Length;

        public void Look(AccuracyWorld world, bool isSettled)
        {
            var position = world.Position(body);
            if (!isSettled)
                settledAt = position;
            var way = position - start;
            Drift = Tally.Most(Drift, (position - settledAt).Length);
            Sideways = Tally.Most(Sideways, Math.Sqrt(way.X * way.X + way.Z * way.Z));
            Turned = Tally.Most(Turned, DoubleQuaternion.AngleBetween(world.Orientation(body), startTurn));
        }
    }
}
