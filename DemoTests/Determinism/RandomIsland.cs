using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;

namespace DemoTests.Determinism;

/// <summary>A part of a world by itself: ground, columns or other bodies, kinematic ones that move and turn, joints, and what a game does to them.</summary>
sealed class RandomIsland
{
    readonly Simulation simulation;
    readonly BufferPool pool;
    readonly Vector3 origin;
    readonly float sleepThreshold;
    readonly Random random;
    readonly Random edits;
    readonly List<BodyHandle> bodies = [];

    public RandomIsland(Simulation simulation, BufferPool pool, int seed, Vector3 origin, float sleepThreshold, bool hasFastBodies)
    {
        (this.simulation, this.pool, this.origin, this.sleepThreshold) = (simulation, pool, origin, sleepThreshold);
        random = new Random(seed);
        edits = new Random(seed + 5);
        AddGround(random.Next(3));
        var isColumns = random.Next(4) == 0;
        var count = random.Next(5, 50);
        var spread = Next(0, 2);
        for (int i = 0; i < count; ++i)
        {
            var mass = MathF.Pow(10, Next(-spread, spread));
            var description = isColumns ? Brick(i, mass) : AnyBody(mass);
            if (hasFastBodies && random.Next(3) == 0)
                description.Collidable.Continuity = ContinuousDetection.Continuous();
            bodies.Add(simulation.Bodies.Add(description));
        }
        for (int i = random.Next(4); i > 0; --i)
            bodies.Add(AddPlatform());
        for (int i = random.Next(count / 2 + 1); i > 0; --i)
            AddJoint(random.Next(5), bodies[random.Next(bodies.Count)], bodies[random.Next(bodies.Count)]);
    }

    public int Count => bodies.Count;

    /// <summary>Pose and velocity of a body.</summary>
    public MotionState this[int body] => new() { Pose = simulation.Bodies[bodies[body]].Pose, Velocity = simulation.Bodies[bodies[body]].Velocity };

    float Next(float least, float most) => least + (most - least) * random.NextSingle();

    Vector3 NextVector(float most) => new(Next(-most, most), Next(-most, most), Next(-most, most));

    Quaternion NextTurn() => Quaternion.Normalize(new Quaternion(Next(-1, 1), Next(-1, 1), Next(-1, 1), Next(0.1f, 1)));

    void AddGround(int kind)
    {
        if (kind == 0)
        {
            simulation.Statics.Add(new StaticDescription(origin - new Vector3(0, 5, 0), simulation.Shapes.Add(new Box(100, 10, 100))));
        }
        else if (kind == 1)
        {
            simulation.Statics.Add(new StaticDescription(origin, simulation.Shapes.Add(Terrain())));
        }
        else
        {
            for (int i = 0; i < 81; ++i)
            {
                var place = new Vector3(2 * (i % 9 - 4), Next(-0.5f, -0.45f), 2 * (i / 9 - 4));
                simulation.Statics.Add(new StaticDescription(origin + place, simulation.Shapes.Add(new Box(2, 1, 2))));
            }
        }
    }

    Mesh Terrain()
    {
        const int width = 16;
        var heights = new float[(width + 1) * (width + 1)];
        for (int i = 0; i < heights.Length; ++i)
            heights[i] = Next(0, 0.8f);
        Vector3 Corner(int x, int z) => new(2 * x - width, heights[z * (width + 1) + x], 2 * z - width);
        pool.Take<Triangle>(2 * width * width, out var triangles);
        for (int i = 0; i < width * width; ++i)
        {
            var (x, z) = (i % width, i / width);
            triangles[2 * i] = new(Corner(x, z), Corner(x + 1, z), Corner(x, z + 1));
            triangles[2 * i + 1] = new(Corner(x + 1, z), Corner(x + 1, z + 1), Corner(x, z + 1));
        }
        return new Mesh(triangles, Vector3.One, pool);
    }

    // Columns of eight.
    BodyDescription Brick(int number, float mass)
    {
        var brick = new Box(1, 0.5f, 1);
        var (column, row) = (number / 8, number % 8);
        return BodyDescription.CreateDynamic(
            origin + new Vector3((column % 5 - 2) * 2.5f, 0.85f + row * 0.505f, (column / 5 - 1) * 2.5f), new BodyVelocity(NextVector(0.2f), NextVector(0.2f)),
            brick.ComputeInertia(mass), simulation.Shapes.Add(brick), sleepThreshold);
    }

    BodyDescription AnyBody(float mass)
    {
        var shape = AnyShape(MathF.Pow(10, Next(-0.5f, 0.3f)), mass, out var inertia);
        return BodyDescription.CreateDynamic(
            new RigidPose(origin + new Vector3(Next(-4, 4), Next(0.5f, 8), Next(-4, 4)), NextTurn()),
            new BodyVelocity(NextVector(4), NextVector(random.Next(6) == 0 ? 200 : 5)), inertia, shape, sleepThreshold);
    }

    TypedIndex AnyShape(float size, float mass, out BodyInertia inertia)
    {
        switch (random.Next(6))
        {
            case 0:
                return Add(new Box(size, size * Next(0.3f, 1), size * Next(0.5f, 1)), mass, out inertia);
            case 1:
                return Add(new Sphere(size / 2), mass, out inertia);
            case 2:
                return Add(new Capsule(size / 3, size / 2), mass, out inertia);
            case 3:
                return Add(new Cylinder(size / 2, size * Next(0.2f, 1)), mass, out inertia);
            case 4:
                var points = new Vector3[12];
                for (int i = 0; i < points.Length; ++i)
                    points[i] = NextVector(size / 2);
                return Add(new ConvexHull(points, pool, out _), mass, out inertia);
            default:
                using (var builder = new CompoundBuilder(pool, simulation.Shapes, 4))
                {
                    var count = 2 + random.Next(3);
                    for (int i = 0; i < count; ++i)
                        builder.Add(new Box(size / 2, size * Next(0.1f, 0.5f), size / 2), new RigidPose(NextVector(size / 2), NextTurn()), mass / count);
                    builder.BuildDynamicCompound(out var children, out inertia, out _);
                    return simulation.Shapes.Add(new Compound(children));
                }
        }
    }

    TypedIndex Add<TShape>(in TShape shape, float mass, out BodyInertia inertia) where TShape : unmanaged, IConvexShape
    {
        inertia = shape.ComputeInertia(mass);
        return simulation.Shapes.Add(shape);
    }

    BodyHandle AddPlatform() => simulation.Bodies.Add(BodyDescription.CreateKinematic(
        new RigidPose(origin + new Vector3(Next(-3, 3), Next(0, 2), Next(-3, 3)), random.Next(2) == 0 ? Quaternion.Identity : NextTurn()),
        new BodyVelocity(random.Next(2) == 0 ? NextVector(1) : default, random.Next(2) == 0 ? new Vector3(0, Next(-2, 2), 0) : default),
        simulation.Shapes.Add(new Box(4, 0.5f, 4)), -1));

    void AddJoint(int kind, BodyHandle a, BodyHandle b)
    {
        if (a == b || (simulation.Bodies[a].Kinematic && simulation.Bodies[b].Kinematic))
            return;
        switch (kind)
        {
            case 0:
                simulation.Solver.Add(a, b, new BallSocket { LocalOffsetA = NextVector(1), LocalOffsetB = NextVector(1) });
                break;
            case 1:
                simulation.Solver.Add(a, b, new Weld { LocalOffset = NextVector(1), LocalOrientation = NextTurn() });
                break;
            case 2:
                simulation.Solver.Add(a, b, new Hinge
                {
                    LocalOffsetA = NextVector(1),
                    LocalOffsetB = NextVector(1),
                    LocalHingeAxisA = Vector3.UnitX,
                    LocalHingeAxisB = Vector3.UnitY,
                });
                break;
            case 3:
                simulation.Solver.Add(a, b, new DistanceLimit(NextVector(1), NextVector(1), 0.1f, 1, new SpringSettings(30, 1)));
                break;
            default:
                simulation.Solver.Add(a, b, new SwivelHinge
                {
                    LocalOffsetA = NextVector(1),
                    LocalOffsetB = NextVector(1),
                    LocalSwivelAxisA = Vector3.UnitX,
                    LocalHingeAxisB = Vector3.UnitY,
                });
                break;
        }
    }

    /// <summary>Pushes, moves or puts to sleep one of the bodies, in one of twelve steps.</summary>
    public void Edit()
    {
        if (edits.Next(12) != 0)
            return;
        var body = simulation.Bodies[bodies[edits.Next(bodies.Count)]];
        var kind = edits.Next(4);
        float NextEdit() => 3 * (2 * edits.NextSingle() - 1);
        var vector = new Vector3(NextEdit(), NextEdit(), NextEdit());
        if (kind < 3)
            body.Awake = true;
        if (kind == 0 && !body.Kinematic)
            body.ApplyLinearImpulse(vector / body.LocalInertia.InverseMass);
        else if (kind == 1)
            body.Velocity = new BodyVelocity(vector, vector);
        else if (kind == 2)
            body.Pose.Position += vector * 0.2f;
        else if (kind == 3)
            body.Awake = false;
    }
}
