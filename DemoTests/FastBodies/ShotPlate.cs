using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities.Memory;

namespace DemoTests.FastBodies;

/// <summary>How plates are held that a ball is shot at.</summary>
public enum PlateScene
{
    Free,
    OnTheGround,
    Door,
    Stack,
    Row,
}

/// <summary>
/// A marked ball of 5 mm to 10 cm, at 50 to 1,000 m/s, within 60 degrees of straight on, is shot at plates of 2 cm, of a hundredth to a hundred times its mass.
/// </summary>
sealed class ShotPlate : IDisposable
{
    const float Dt = 1 / 60f;
    const float Thickness = .02f;
    const int Steps = 20;
    // Of a plate in a substep, rad: what turns farther may have been hit within it, and turned around the ball.
    const float GreatestTurn = .3f;

    // Sees where bodies are at the end of each substep, when their ways have been swept.
    sealed class AfterWays(Action look) : ISolverStage
    {
        int ISolverStage.GetBlockCount(SolverPoint point) => point is SolverPoint.AfterIntegration or SolverPoint.AfterSubsteps ? 1 : 0;

        void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
        {
            if (FastPairs.HasMoved(point, substep))
                look();
        }
    }

    readonly BufferPool pool = new();
    readonly Simulation simulation;
    readonly List<BodyHandle> plates = [];
    readonly List<RigidPose> before = [];
    Vector3 ballBefore;
    readonly BodyHandle ball;
    readonly Box plate;
    readonly float radius;
    readonly bool hasGravity;

    /// <summary>Speed of the ball, m/s.</summary>
    public float Speed { get; }

    /// <summary>Whether the centre of the ball was in a plate when a substep ended, or went through one.</summary>
    public bool HasPassed { get; private set; }

    /// <summary>Greatest energy after a step, with that of the weight, less that at the beginning, of that at the beginning.</summary>
    public double Gain { get; private set; } = -1;

    /// <summary>Greatest change of momentum, of that of the ball, where nothing else takes any.</summary>
    public double MomentumError { get; private set; }

    public ShotPlate(PlateScene scene, int seed)
    {
        var random = new Random(seed);
        float Between(float least, float most) => least * MathF.Pow(most / least, random.NextSingle());
        radius = Between(.0025f, .05f);
        Speed = Between(50, 1000);
        plate = new Box(.5f + 1.5f * random.NextSingle(), Thickness, .5f + 1.5f * random.NextSingle());
        var ratio = Between(.01f, 100);
        hasGravity = random.Next(2) == 0 || scene is PlateScene.OnTheGround or PlateScene.Stack;
        var isAsleep = random.Next(2) == 0;
        var mass = 4f / 3 * MathF.PI * 7800 * radius * radius * radius;
        var cosine = .5f + .5f * random.NextSingle();
        var turn = random.NextSingle() * MathF.Tau;
        var sine = MathF.Sqrt(1 - cosine * cosine);
        // In the frame of the plate, whose normal is y.
        var direction = new Vector3(sine * MathF.Cos(turn), -cosine, sine * MathF.Sin(turn));
        var target = new Vector3((random.NextSingle() - .5f) * plate.Width, 0, (random.NextSingle() - .5f) * plate.Length) * .9f;
        var distance = .5f + Speed * Dt * 2 * random.NextSingle();
        // What stands is hit from above, as the ball would come out of the ground.
        if (scene == PlateScene.OnTheGround)
            direction = Vector3.Normalize(direction with { Z = MathF.Abs(direction.Z) * .3f });
        var stands = scene is PlateScene.OnTheGround or PlateScene.Door;
        var frame = stands ? Quaternion.CreateFromAxisAngle(Vector3.UnitX, MathF.PI / 2) : Quaternion.Identity;

        simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(new Vector3(0, hasGravity ? -9.81f : 0, 0)),
            SolveDescription.Default);
        AddPlates(scene, frame, mass * ratio, isAsleep);
        for (int i = 0; i < (scene is PlateScene.OnTheGround or PlateScene.Stack || (isAsleep && !hasGravity) ? 90 : 0); ++i)
            simulation.Timestep(Dt);
        var pose = simulation.Bodies[plates[0]].Pose;
        var start = pose.Position + Vector3.Transform(target + new Vector3(0, Thickness / 2 + radius, 0) - direction * distance, pose.Orientation);
        var shape = new Sphere(radius);
        ball = simulation.Bodies.Add(BodyDescription.CreateDynamic(
            start, new BodyVelocity(Vector3.Transform(direction, pose.Orientation) * Speed), shape.ComputeInertia(mass),
            new CollidableDescription(simulation.Shapes.Add(shape), ContinuousDetection.Continuous()), -1));
        Run(Steps + (int)(distance / Speed / Dt), mass, scene is PlateScene.Free or PlateScene.Row && !hasGravity);
    }

    void AddPlates(PlateScene scene, Quaternion frame, float mass, bool maySleep)
    {
        var shape = simulation.Shapes.Add(plate);
        var count = scene is PlateScene.Stack or PlateScene.Row ? 5 : 1;
        var stands = scene is PlateScene.OnTheGround or PlateScene.Door;
        var top = new Vector3(0, stands ? plate.Length / 2 : (count - .5f) * Thickness, 0);
        for (int i = 0; i < count; ++i)
        {
            plates.Add(simulation.Bodies.Add(BodyDescription.CreateDynamic(
                new RigidPose(top - new Vector3(0, i * Thickness, 0), frame), plate.ComputeInertia(mass), shape,
                new BodyActivityDescription(maySleep ? .01f : -1))));
        }
        if (scene is PlateScene.OnTheGround or PlateScene.Stack)
            simulation.Statics.Add(new StaticDescription(new Vector3(0, -5, 0), simulation.Shapes.Add(new Box(400, 10, 400))));
        if (scene != PlateScene.Door)
            return;
        var post = simulation.Bodies.Add(BodyDescription.CreateKinematic(new Vector3(-plate.Width / 2, plate.Length / 2, 0), default(TypedIndex), -1));
        simulation.Solver.Add(post, plates[0], new Hinge
        {
            LocalHingeAxisA = Vector3.UnitY,
            LocalOffsetB = new Vector3(-plate.Width / 2, 0, 0),
            LocalHingeAxisB = -Vector3.UnitZ,
        });
    }

    void Run(int steps, float mass, bool isFree)
    {
        before.AddRange(plates.ConvertAll(handle => simulation.Bodies[handle].Pose));
        ballBefore = simulation.Bodies[ball].Pose.Position;
        var stages = simulation.Solver.OptionalStages;
        stages.Insert(stages.FindIndex(stage => stage is FastPairs) + 1, new AfterWays(Look));
        var (energy, momentum) = Sum();
        for (int step = 0; step < steps; ++step)
        {
            simulation.Timestep(Dt);
            var (now, moving) = Sum();
            Gain = Math.Max(Gain, now / energy - 1);
            if (isFree)
                MomentumError = Math.Max(MomentumError, Vector3.Distance(moving, momentum) / (mass * Speed));
        }
    }

    void Look()
    {
        var place = simulation.Bodies[ball].Pose.Position;
        for (int i = 0; i < plates.Count; ++i)
        {
            var body = simulation.Bodies[plates[i]];
            HasPassed |= Passes(before[i], body.Pose, place, body.Velocity.Angular.Length() * Dt / simulation.Solver.SubstepCount);
            before[i] = body.Pose;
        }
        ballBefore = place;
    }

    static Vector3 PlaceInFrame(in RigidPose pose, Vector3 place) => Vector3.Transform(place - pose.Position, Quaternion.Conjugate(pose.Orientation));

    bool IsBeside(Vector3 place, float edge) => MathF.Abs(place.X) < plate.Width / 2 - edge && MathF.Abs(place.Z) < plate.Length / 2 - edge;

    // In the frame of what turns ways are bent.
    bool Passes(in RigidPose start, in RigidPose end, Vector3 place, float turn)
    {
        const int parts = 32;
        var last = PlaceInFrame(start, ballBefore);
        var isThrough = MathF.Abs(PlaceInFrame(end, place).Y) < Thickness / 2 && IsBeside(PlaceInFrame(end, place), 0);
        for (int i = 1; i <= parts && turn < GreatestTurn; ++i)
        {
            var part = i / (float)parts;
            var pose = new RigidPose(Vector3.Lerp(start.Position, end.Position, part), Quaternion.Slerp(start.Orientation, end.Orientation, part));
            var next = PlaceInFrame(pose, Vector3.Lerp(ballBefore, place, part));
            isThrough |= last.Y > 0 != next.Y > 0 && IsBeside(Vector3.Lerp(last, next, last.Y / (last.Y - next.Y)), radius);
            last = next;
        }
        return isThrough;
    }

    (double Energy, Vector3 Momentum) Sum()
    {
        double energy = 0;
        Vector3 momentum = default;
        foreach (var handle in plates)
            Add(handle, ref energy, ref momentum);
        Add(ball, ref energy, ref momentum);
        return (energy, momentum);
    }

    void Add(BodyHandle handle, ref double energy, ref Vector3 momentum)
    {
        var body = simulation.Bodies[handle];
        var mass = 1 / body.LocalInertia.InverseMass;
        var spin = Vector3.Transform(body.Velocity.Angular, Quaternion.Conjugate(body.Pose.Orientation));
        var inverse = body.LocalInertia.InverseInertiaTensor;
        energy += .5 * mass * body.Velocity.Linear.LengthSquared() + (hasGravity ? 9.81 * mass * body.Pose.Position.Y : 0) +
            .5 * (spin.X * spin.X / inverse.XX + spin.Y * spin.Y / inverse.YY + spin.Z * spin.Z / inverse.ZZ);
        momentum += mass * body.Velocity.Linear;
    }

    public void Dispose()
    {
        simulation.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }
}
