using System;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;

namespace Demos.Fuzz.Operations;

/// <summary>Calls to bodies and to references of them.</summary>
static class BodyOperations
{
    public static FuzzOperation[] All { get; } =
    [
        new("Bodies.Add", 60, Add),
        new("Bodies.Remove", 14, w => w.Simulation.Bodies.Remove(w.AnyBody())),
        new("Bodies.RemoveAt", 4, w => w.Simulation.Bodies.RemoveAt(w.Random.Below(w.BodyCount + 4) - 2)),
        new("Bodies.ApplyDescription", 14, w => w.Simulation.Bodies.ApplyDescription(w.AnyBody(), Describe(w))),
        new("Bodies.GetDescription", 4, w => w.Simulation.Bodies.GetDescription(w.AnyBody())),
        new("Bodies.SetShape", 8, w => w.Simulation.Bodies.SetShape(w.AnyBody(), w.AnyShape())),
        new("Bodies.SetLocalInertia", 8, w => w.Simulation.Bodies.SetLocalInertia(w.AnyBody(), w.Random.Spoil(Inertia(w), 20))),
        new("Bodies.UpdateBounds", 5, w => w.Simulation.Bodies.UpdateBounds(w.AnyBody())),
        new("Layers of a body", 3, w => w.Simulation.Layers[w.AnyBody()] = AnyLayers(w)),
        new("Events.Listen to a body", 8, w => w.Simulation.Events.Listen(w.AnyBody(), (EventMask)w.Random.Below(36))),
        new("Events.SetSensor of a body", 2, w => w.Simulation.Events.SetSensor(w.AnyBody(), w.Random.Percent(40))),
        new("Bodies.GetInterpolatedPose", 2, w => w.Simulation.Bodies.GetInterpolatedPose(w.AnyBody(), w.Random.Spoil(w.Random.Number(0, 1), 10))),
        new("Bodies.EnsureCapacity", 3, w => w.Simulation.Bodies.EnsureCapacity(w.AnyCount())),
        new("Bodies.MinimumConstraintCapacityPerBody", 2, w => w.Simulation.Bodies.MinimumConstraintCapacityPerBody = w.AnyCount()),
        new("Bodies.EnumerateConnectedBodies", 4, w =>
        {
            var counter = new Counter();
            w.Simulation.Bodies.EnumerateConnectedBodies(w.AnyBody(), ref counter);
        }),
        new("Bodies.CountBodies", 1, w => w.Simulation.Bodies.CountBodies()),
        new("BodyReference of a handle", 6, w => w.KeptBodies.Add(w.Simulation.Bodies[w.AnyBody()])),
        new("BodyReference made by hand", 1, w => w.KeptBodies.Add(new BodyReference(w.AnyBody(), w.Simulation.Bodies))),
        Of("Exists", 2, (w, body) => _ = body.Exists),
        Of("Awake", 2, (w, body) => _ = body.Awake),
        Of("Awake written", 8, (w, body) => body.Awake = w.Random.Percent(40)),
        new("Awakener.AwakenBody", 3, w => w.Simulation.Awakener.AwakenBody(w.AnyBody())),
        new("Awakener.AwakenSet", 1, w => w.Simulation.Awakener.AwakenSet(w.Random.Below(5) - 1)),
        new("Awakener.AwakenAll", 1, w => w.Simulation.Awakener.AwakenAll()),
        Of("Pose", 2, (w, body) => _ = body.Pose.Position.X),
        Of("Velocity", 2, (w, body) => _ = body.Velocity.Linear.X),
        Of("LocalInertia", 2, (w, body) => _ = body.LocalInertia.InverseMass),
        Of("Dynamics", 2, (w, body) => _ = body.Dynamics.Motion.Pose.Position.X + body.Dynamics.Inertia.World.InverseMass),
        Of("Collidable", 2, (w, body) => _ = body.Collidable.Shape),
        Of("Activity", 2, (w, body) => _ = body.Activity.SleepThreshold),
        Of("Constraints", 2, (w, body) => _ = body.Constraints.Count),
        Of("CollidableReference", 2, (w, body) => _ = body.CollidableReference),
        Of("Kinematic", 2, (w, body) => _ = body.Kinematic),
        Of("HasLockedInertia", 2, (w, body) => _ = body.HasLockedInertia),
        Of("BoundingBox", 3, (w, body) => _ = body.BoundingBox),
        Of("GetDescription", 2, (w, body) => body.GetDescription(out _)),
        Of("ComputeInverseInertia", 2, (w, body) => body.ComputeInverseInertia(out _)),
        Of("GetVelocityForOffset", 2, (w, body) => body.GetVelocityForOffset(w.Random.Vector(1), out _)),
        Of("ApplyDescription", 5, (w, body) => body.ApplyDescription(Describe(w))),
        Of("SetShape", 3, (w, body) => body.SetShape(w.AnyShape())),
        Of("SetLocalInertia", 3, (w, body) => body.SetLocalInertia(w.Random.Spoil(Inertia(w)))),
        Of("BecomeKinematic", 4, (w, body) => body.BecomeKinematic()),
        Of("UpdateBounds", 3, (w, body) => body.UpdateBounds()),
        Of("ApplyImpulse", 6, (w, body) => body.ApplyImpulse(Spoiled(w, 3), Spoiled(w, 1))),
        Of("ApplyLinearImpulse", 6, (w, body) => body.ApplyLinearImpulse(Spoiled(w, 5))),
        Of("ApplyAngularImpulse", 6, (w, body) => body.ApplyAngularImpulse(Spoiled(w, 2))),
        Of("Pose written", 4, (w, body) => body.Pose = w.AnyPose()),
        Of("Velocity written", 4, (w, body) => body.Velocity = new BodyVelocity(w.Random.Vector(6), w.Random.Vector(6))),
        Of("Pose written badly", 1, (w, body) =>
        {
            RigidPose pose = w.Random.Spoil(w.AnyPose(), w.Has(FuzzScope.DirectWrites) ? 40 : 0);
            w.Tell($"{pose.Position} {pose.Orientation}");
            FuzzWorld.WakeToWrite(body);
            body.Pose = pose;
            w.NoteWritten(body);
        }),
        Of("Velocity written badly", 1, (w, body) =>
        {
            var velocity = w.Random.Spoil(new BodyVelocity(w.Random.Vector(6), w.Random.Vector(6)), w.Has(FuzzScope.DirectWrites) ? 40 : 0);
            w.Tell($"{velocity.Linear} {velocity.Angular}");
            FuzzWorld.WakeToWrite(body);
            body.Velocity = velocity;
            w.NoteWritten(body);
        }),
        Of("LocalInertia written", 1, WriteInertia),
    ];

    // Most of them everything, or soon nothing would collide any more.
    internal static CollisionLayers AnyLayers(FuzzWorld w) => w.Random.Percent(60)
        ? CollisionLayers.Everything
        : new((uint)w.Random.Below(16), (uint)w.Random.Below(16));

    struct Counter : IForEach<BodyHandle>
    {
        int count;

        public void LoopBody(BodyHandle i) => ++count;
    }

    delegate void Call(FuzzWorld world, BodyReference body);

    // Through a reference to a body that there is, or through one that was kept since some time.
    static FuzzOperation Of(string name, int weight, Call call) => new("BodyReference." + name, weight, w =>
    {
        if (w.KeptBodies.Count > 20)
            w.KeptBodies.RemoveRange(0, 10);
        bool isKept = w.Has(FuzzScope.StaleReferences) && w.KeptBodies.Count > 0 && w.Random.Percent(30);
        BodyReference body = isKept ? w.Random.Of(w.KeptBodies) : w.Simulation.Bodies[w.AnyBody()];
        w.Tell($"{body.Handle} {(isKept ? "kept" : "")}");
        call(w, body);
    });

    static void Add(FuzzWorld w)
    {
        if (w.Bodies.Live.Count >= FuzzWorld.MaximumBodies)
            return;
        BodyDescription description = Describe(w);
        w.Bodies.Live.Add(w.Simulation.Bodies.Add(description));
    }

    // A reference must not make a body kinematic or dynamic; what is no number counts as dynamic.
    static void WriteInertia(FuzzWorld w, BodyReference body)
    {
        BodyInertia inertia = Inertia(w);
        int badPlace = w.Random.Percent(40) ? w.Random.Below(7) : -1;
        float bad = w.Random.Of((ReadOnlySpan<float>)[float.NaN, float.PositiveInfinity, float.NegativeInfinity]);
        if (badPlace >= 0 && w.Has(FuzzScope.DirectWrites))
            MemoryMarshal.Cast<BodyInertia, float>(new Span<BodyInertia>(ref inertia))[badPlace] = bad;
        w.Tell($"m {inertia.InverseMass} I {Entries(inertia.InverseInertiaTensor)}");
        if (body.Kinematic || Bodies.IsKinematic(inertia))
            return;
        FuzzWorld.WakeToWrite(body);
        body.LocalInertia = inertia;
        w.NoteWritten(body);
    }

    static BodyDescription Describe(FuzzWorld w)
    {
        FuzzRandom random = w.Random;
        var description = new BodyDescription
        {
            Pose = w.AnyPose(),
            Velocity = random.Percent(50) ? default : new(random.Vector(5), random.Vector(5)),
            LocalInertia = Inertia(w),
            Collidable = random.Percent(8) ? default : new CollidableDescription(w.AnyShape()),
            Activity = new(random.Number(-1, 1)),
        };
        if (random.Percent(30))
            description.Collidable.Continuity = ContinuousDetection.Continuous();
        if (random.Percent(30))
            description.Collidable.MaximumSpeculativeMargin = random.Number(0, 1);
        description = random.Spoil(description, 8);
        w.Tell($"{description.Pose.Position} {description.Pose.Orientation} v {description.Velocity.Linear} w {description.Velocity.Angular}");
        w.Tell($"m {description.LocalInertia.InverseMass} I {Entries(description.LocalInertia.InverseInertiaTensor)} {description.Collidable.Shape}");
        w.Tell($"margins {description.Collidable.MinimumSpeculativeMargin} {description.Collidable.MaximumSpeculativeMargin}");
        return description;
    }

    static string Entries(in Symmetric3x3 t) => FormattableStringOf($"{t.XX} {t.YX} {t.YY} {t.ZX} {t.ZY} {t.ZZ}");

    static string FormattableStringOf(FormattableString text) => FormattableString.Invariant(text);

    // Cubes and rods, light and heavy, at times at an angle; some turn about one axis only, some not at all, some do not move.
    static BodyInertia Inertia(FuzzWorld w)
    {
        FuzzRandom random = w.Random;
        int kind = random.Below(10);
        if (kind == 0)
            return default;
        float inverseMass = random.Magnitude(0.01f, 100);
        var diagonal = new Vector3(6 * inverseMass);
        if (kind >= 7)
            diagonal[random.Below(3)] *= random.Magnitude(1, 1000);
        if (kind == 1)
            diagonal[random.Below(3)] = 0;
        if (kind == 2)
            diagonal = default;
        Symmetric3x3 tensor = Symmetric3x3.Diagonal(diagonal.X, diagonal.Y, diagonal.Z);
        return new BodyInertia
        {
            InverseMass = kind == 3 ? 0 : inverseMass,
            InverseInertiaTensor = kind >= 8 ? Symmetric3x3.RotateInverseInertia(tensor, random.Turn()) : tensor,
        };
    }

    static Vector3 Spoiled(FuzzWorld w, float size)
    {
        Vector3 value = w.Random.Spoil(w.Random.Vector(size));
        w.Tell($"{value}");
        return value;
    }
}
