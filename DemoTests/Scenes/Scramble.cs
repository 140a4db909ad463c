using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;
using DemoTests.Collidables.Meshes;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>
/// A crowded pit in which things are added, removed and changed at random, beside a list of what there must be: after each step the
/// simulation must be sound and hold exactly that.
/// </summary>
sealed class Scramble : IDisposable
{
    const int MostBodies = 90;
    const float Extent = 7;
    // Bodies that may sleep do so in the very scramble, and are at rest no sooner than others.
    readonly BodyActivityDescription activity;
    readonly bool sleeps;

    readonly Random random;
    readonly TestWorld world;
    readonly List<TypedIndex> shapes = [];
    // Shapes that only statics have, and what returns the memory of shapes that have some.
    readonly List<TypedIndex> grounds = [];
    readonly List<Action> disposals = [];
    readonly List<BodyHandle> bodies = [];
    readonly List<StaticHandle> statics = [];
    readonly List<Joint> joints = [];

    // A joint of the list; the kind is that of the switch in AddJoint.
    readonly record struct Joint(ConstraintHandle Handle, int Kind, BodyHandle A, BodyHandle B)
    {
        public bool Has(BodyHandle body) => A == body || B == body;
    }

    public Scramble(int seed, int threads, SimulationAllocationSizes? sizes, bool sleeps = false)
    {
        this.sleeps = sleeps;
        activity = sleeps ? new(.3f, 3) : new(-1);
        random = new Random(seed);
        world = new TestWorld(threads: threads, sizes: sizes);
        Fill();
    }

    public Simulation Simulation => world.Simulation;

    /// <summary>The bodies that there are.</summary>
    public IReadOnlyList<BodyHandle> Bodies => bodies;

    /// <summary>The two bodies of each joint that has two.</summary>
    public IEnumerable<(BodyHandle A, BodyHandle B)> Joined
    {
        get
        {
            foreach (var joint in joints)
            {
                if (joint.A != joint.B)
                    yield return (joint.A, joint.B);
            }
        }
    }

    /// <summary>Some changes and a step.</summary>
    public void Round()
    {
        int changes = sleeps && random.Next(4) > 0 ? 0 : random.Next(6);
        for (int i = 0; i < changes; ++i)
            Change();
        Step();
    }

    /// <summary>A step of any length, in any number of substeps.</summary>
    public void Step()
    {
        if (random.Next(8) == 0)
            world.Solver.SubstepCount = random.Next(1, 6);
        world.Step(random.Next(10) == 0 ? 1 / 120f : TestWorld.Dt);
    }

    /// <summary>Requires that the simulation is sound and has what it was given.</summary>
    public void Check()
    {
        Simulation.Validate();
        CheckEvents();
        Assert.Equal(bodies.Count, world.Bodies.CountBodies());
        Assert.Equal(statics.Count, world.Statics.Count);
        Assert.All(bodies, body => Assert.True(world.Bodies.BodyExists(body)));
        Assert.All(statics, still => Assert.True(world.Statics.StaticExists(still)));
        // Shapes that are made of others may have several patches.
        var mostPatches = grounds.Count > 0 ? PatchSet.Capacity : 1;
        int contacts = Simulation.NarrowPhase.PairCount;
        Assert.InRange(world.Solver.CountConstraints(), joints.Count + contacts, joints.Count + contacts * mostPatches);
        foreach (var joint in joints)
            AssertDescription(joint);
    }

    // What is told of a step is of bodies and statics that took part in it, which are those that there are now.
    void CheckEvents()
    {
        foreach (ref readonly var begun in Simulation.Events.Began)
            CheckExists(begun.Pair);
        foreach (ref readonly var persisting in Simulation.Events.Persisting)
            CheckExists(persisting.Pair);
    }

    void CheckExists(CollidablePair pair)
    {
        Assert.True(world.Bodies.BodyExists(pair.A.BodyHandle));
        Assert.True(pair.B.Mobility == CollidableMobility.Static
            ? world.Statics.StaticExists(pair.B.StaticHandle)
            : world.Bodies.BodyExists(pair.B.BodyHandle));
    }

    public void Clear()
    {
        Simulation.Clear();
        bodies.Clear();
        statics.Clear();
        joints.Clear();
        shapes.Clear();
        DisposeShapes();
        Check();
        Fill();
    }

    public void Dispose()
    {
        Simulation.Clear();
        DisposeShapes();
        world.Dispose();
    }

    void DisposeShapes()
    {
        foreach (var dispose in disposals)
            dispose();
        disposals.Clear();
        grounds.Clear();
    }

    TypedIndex Add<TShape>(TShape shape) where TShape : unmanaged, IDisposableShape
    {
        disposals.Add(() => shape.Dispose(world.Pool));
        return Simulation.Shapes.Add(shape);
    }

    // Shapes that are made of others: two that bodies may have, and two that only statics are.
    void AddContainers()
    {
        world.Pool.Take(3, out Buffer<CompoundChild> children);
        for (int i = 0; i < 3; ++i)
            children[i] = new(new RigidPose(new Vector3(.5f * i - .5f, .1f * i, 0), TestWorld.Turn(random)), shapes[i]);
        shapes.Add(Add(new Compound(children)));
        var ring = MeshSample.Torus(.6f, .2f, 6, 4);
        shapes.Add(Add(new Mesh(ring.Vertices, ring.Indices, Vector3.One, world.Pool)));
        var hills = MeshSample.Terrain(4, .3f);
        grounds.Add(Add(new Mesh(hills.Vertices, hills.Indices, Vector3.One, world.Pool)));
        grounds.Add(Add(new HeightField(4, 4, 1, 1, new float[16], world.Pool)));
    }

    void Fill()
    {
        shapes.Add(Simulation.Shapes.Add(new Sphere(.4f)));
        shapes.Add(Simulation.Shapes.Add(new Capsule(.3f, .7f)));
        shapes.Add(Simulation.Shapes.Add(new Box(.8f, .6f, .9f)));
        shapes.Add(Simulation.Shapes.Add(new Sphere(.7f)));
        shapes.Add(Simulation.Shapes.Add(new Box(1.5f, .4f, .5f)));
        if (sleeps)
            AddContainers();
        AddStatic(new Vector3(0, -1, 0), new Box(2 * Extent, 2, 2 * Extent));
        for (int i = 0; i < 30; ++i)
            AddBody();
    }

    /// <summary>Changes something.</summary>
    public void Change()
    {
        switch (random.Next(sleeps ? 25 : 19))
        {
            case 0 or 1 or 2:
                if (bodies.Count < MostBodies)
                    AddBody();
                break;
            case 3 or 4:
                if (bodies.Count > 10)
                    RemoveBody(random.Next(bodies.Count));
                break;
            case 5:
                AddStatic(Place(), new Box(1, 1, 1));
                break;
            case 6:
                if (statics.Count > 0)
                    RemoveStatic();
                break;
            case 7:
                world.Bodies.SetShape(AnyBody(), random.Next(6) == 0 ? default : AnyShape());
                break;
            case 8:
                ToggleKinematic(AnyBody());
                break;
            case 9:
                Redescribe(AnyBody());
                break;
            case 10:
                if (statics.Count > 0)
                    ChangeStatic(statics[random.Next(statics.Count)]);
                break;
            case 11 or 12 or 13:
                AddJoint();
                break;
            case 14:
                if (joints.Count > 0)
                    RemoveJoint(random.Next(joints.Count));
                break;
            case 15:
                world.Bodies[AnyBody()].ApplyLinearImpulse(TestWorld.Scatter(random, 4));
                break;
            case 16:
                Simulation.Events.Listen(AnyBody(), (EventMask)random.Next(32));
                break;
            case 17:
                Simulation.Layers[AnyBody()] = random.Next(3) > 0 ? CollisionLayers.Everything : new((uint)random.Next(4), (uint)random.Next(4));
                break;
            case 18:
                if (statics.Count > 1)
                    Simulation.Events.SetSensor(statics[random.Next(1, statics.Count)], random.Next(2) == 0);
                break;
            case 19 or 20:
                SetAwake(world.Bodies[AnyBody()], random.Next(2) == 0);
                break;
            case 21:
                Teleport(world.Bodies[AnyBody()]);
                break;
            case 22:
                world.Bodies[AnyBody()].Velocity = new BodyVelocity(TestWorld.Scatter(random, 2), TestWorld.Scatter(random, 2));
                break;
            case 23:
                if (joints.Count > 0)
                    TouchJoint(joints[random.Next(joints.Count)]);
                break;
            default:
                if (random.Next(4) == 0)
                    Simulation.Awakener.AwakenAll();
                else
                    Simulation.Awakener.AwakenBody(AnyBody());
                break;
        }
    }

    BodyHandle AnyBody() => bodies[random.Next(bodies.Count)];

    TypedIndex AnyShape() => shapes[random.Next(shapes.Count)];

    Vector3 Place() => TestWorld.Scatter(random, Extent) + new Vector3(0, Extent / 2 + .5f, 0);

    BodyDescription AnyDescription()
    {
        var pose = new RigidPose(Place(), TestWorld.Turn(random));
        var velocity = new BodyVelocity(TestWorld.Scatter(random, 4), TestWorld.Scatter(random, 4));
        CollidableDescription collidable = random.Next(10) == 0 ? default : AnyShape();
        return random.Next(6) == 0
            ? BodyDescription.CreateKinematic(pose, collidable, activity)
            : BodyDescription.CreateDynamic(pose, velocity, new Box(1, 1, 1).ComputeInertia(1 + random.NextSingle()), collidable, activity);
    }

    static void SetAwake(BodyReference body, bool value)
    {
        body.Awake = value;
        Assert.Equal(value, body.Awake);
    }

    // Asleep or not, with and without telling anybody.
    void Teleport(BodyReference body)
    {
        body.Pose.Position = Place();
        body.Pose.Orientation = TestWorld.Turn(random);
        if (random.Next(2) == 0)
            body.UpdateBounds();
        if (random.Next(2) == 0)
            body.Awake = true;
    }

    void TouchJoint(Joint joint)
    {
        if (joint.Kind != 0)
            return;
        world.Solver.GetDescription<BallSocket>(joint.Handle, out var description);
        if (random.Next(2) == 0)
            world.Solver.ApplyDescription(joint.Handle, description);
        else
            world.Solver.ApplyDescriptionWithoutWaking(joint.Handle, description);
    }

    void AddBody() => bodies.Add(world.Bodies.Add(AnyDescription()));

    void RemoveBody(int index)
    {
        var handle = bodies[index];
        world.Bodies.Remove(handle);
        bodies.RemoveAt(index);
        joints.RemoveAll(joint => joint.Has(handle));
    }

    void ToggleKinematic(BodyHandle handle)
    {
        var body = world.Bodies[handle];
        if (body.Kinematic)
            body.SetLocalInertia(new Sphere(.5f).ComputeInertia(1));
        else
            body.BecomeKinematic();
        DropJointsWithoutDynamics();
    }

    void Redescribe(BodyHandle handle)
    {
        world.Bodies.ApplyDescription(handle, AnyDescription());
        DropJointsWithoutDynamics();
    }

    void DropJointsWithoutDynamics() => joints.RemoveAll(joint => world.Bodies[joint.A].Kinematic && world.Bodies[joint.B].Kinematic);

    void AddStatic(Vector3 position, Box box) =>
        statics.Add(world.Statics.Add(new StaticDescription(new RigidPose(position), Simulation.Shapes.Add(box))));

    void RemoveStatic()
    {
        int index = random.Next(statics.Count);
        world.Statics.Remove(statics[index]);
        statics.RemoveAt(index);
    }

    void ChangeStatic(StaticHandle handle)
    {
        var shape = grounds.Count > 0 && random.Next(3) == 0 ? grounds[random.Next(grounds.Count)] : AnyShape();
        if (random.Next(2) == 0)
            world.Statics.SetShape(handle, shape);
        else
            world.Statics.ApplyDescription(handle, new StaticDescription(new RigidPose(Place(), TestWorld.Turn(random)), shape));
    }

    void AddJoint()
    {
        BodyHandle a = AnyBody(), b = AnyBody();
        int kind = random.Next(7);
        // The kind on one body has it on both sides of the list.
        if (kind == 6)
            b = a;
        if ((kind < 6 && a == b) || (world.Bodies[a].Kinematic && world.Bodies[b].Kinematic))
            return;
        var solver = world.Solver;
        var spring = new SpringSettings(5, 1);
        ConstraintHandle handle = kind switch
        {
            0 => solver.Add(a, b, new BallSocket { LocalOffsetA = new Vector3(0, 1, 0), LocalOffsetB = new Vector3(0, -1, 0), SpringSettings = spring }),
            1 => solver.Add(a, b, new Weld { LocalOffset = new Vector3(1, 0, 0), LocalOrientation = Quaternion.Identity, SpringSettings = spring }),
            2 => solver.Add(a, b, new Hinge
            {
                LocalHingeAxisA = Vector3.UnitY,
                LocalHingeAxisB = Vector3.UnitY,
                LocalOffsetB = Vector3.UnitX,
                SpringSettings = spring,
            }),
            3 => solver.Add(a, b, new SwingLimit { AxisLocalA = Vector3.UnitX, AxisLocalB = Vector3.UnitX, MinimumDot = .5f, SpringSettings = spring }),
            4 => solver.Add(a, b, new TwistLimit
            {
                LocalBasisA = Quaternion.Identity,
                LocalBasisB = Quaternion.Identity,
                MinimumAngle = -1,
                MaximumAngle = 1,
                SpringSettings = spring,
            }),
            5 => solver.Add(a, b, new DistanceLimit { MinimumDistance = .5f, MaximumDistance = 3, SpringSettings = spring }),
            _ => solver.Add(a, new OneBodyLinearServo { Target = new Vector3(0, 3, 0), ServoSettings = new ServoSettings(2, 0, 50), SpringSettings = spring }),
        };
        joints.Add(new Joint(handle, kind, a, b));
    }

    void RemoveJoint(int index)
    {
        world.Solver.Remove(joints[index].Handle);
        joints.RemoveAt(index);
    }

    // A joint that lost its handle to a contact, or its place to another joint, has another type or other numbers.
    void AssertDescription(Joint joint)
    {
        var solver = world.Solver;
        Assert.True(solver.ConstraintExists(joint.Handle), $"{joint} is gone");
        switch (joint.Kind)
        {
            case 0:
                solver.GetDescription<BallSocket>(joint.Handle, out var ball);
                Assert.Equal(new Vector3(0, -1, 0), ball.LocalOffsetB);
                break;
            case 1:
                solver.GetDescription<Weld>(joint.Handle, out var weld);
                Assert.Equal(new Vector3(1, 0, 0), weld.LocalOffset);
                break;
            case 2:
                solver.GetDescription<Hinge>(joint.Handle, out var hinge);
                Assert.Equal(Vector3.UnitX, hinge.LocalOffsetB);
                break;
            case 3:
                solver.GetDescription<SwingLimit>(joint.Handle, out var swing);
                Assert.Equal(.5f, swing.MinimumDot);
                break;
            case 4:
                solver.GetDescription<TwistLimit>(joint.Handle, out var twist);
                Assert.Equal(1, twist.MaximumAngle);
                break;
            case 5:
                solver.GetDescription<DistanceLimit>(joint.Handle, out var distance);
                Assert.Equal(3, distance.MaximumDistance);
                break;
            default:
                solver.GetDescription<OneBodyLinearServo>(joint.Handle, out var servo);
                Assert.Equal(50, servo.ServoSettings.MaximumForce);
                break;
        }
        bool isListed = false;
        foreach (var constraint in world.Bodies[joint.A].Constraints)
            isListed |= constraint.ConnectingConstraintHandle == joint.Handle;
        Assert.True(isListed);
    }
}
