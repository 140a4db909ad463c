using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;

namespace Demos.Fuzz.Operations;

/// <summary>Calls to statics and to references of them.</summary>
static class StaticOperations
{
    const int MaximumStatics = 10;

    public static FuzzOperation[] All { get; } =
    [
        new("Statics.Add", 12, Add),
        new("Statics.AddWithoutAwakeningBodies", 2, AddQuietly),
        new("Statics.Remove without waking", 1, w =>
        {
            var filter = default(StaticsShouldntAwakenBodies);
            w.Simulation.Statics.Remove(w.AnyStatic(), ref filter);
        }),
        new("Statics.Remove", 4, w => w.Simulation.Statics.Remove(w.AnyStatic())),
        new("Statics.RemoveAt", 2, w => w.Simulation.Statics.RemoveAt(w.Random.Below(w.StaticCount + 4) - 2)),
        new("Statics.ApplyDescription", 6, w => w.Simulation.Statics.ApplyDescription(w.AnyStatic(), Describe(w))),
        new("Statics.GetDescription", 2, w => w.Simulation.Statics.GetDescription(w.AnyStatic())),
        new("Statics.SetShape", 4, w => w.Simulation.Statics.SetShape(w.AnyStatic(), w.AnyShape())),
        new("Statics.UpdateBounds", 3, w => w.Simulation.Statics.UpdateBounds(w.AnyStatic())),
        new("Events.Listen to a static", 4, w => w.Simulation.Events.Listen(w.AnyStatic(), (EventMask)w.Random.Below(36))),
        new("Events.SetSensor of a static", 1, w => w.Simulation.Events.SetSensor(w.AnyStatic(), w.Random.Percent(40))),
        new("Layers of a static", 2, w => w.Simulation.Layers[w.AnyStatic()] = BodyOperations.AnyLayers(w)),
        new("Statics.EnsureCapacity", 2, w => w.Simulation.Statics.EnsureCapacity(w.AnyCount())),
        new("Statics.GetDirectReference", 2, w => _ = w.Simulation.Statics.GetDirectReference(w.AnyStatic()).Pose.Position.X),
        new("StaticReference of a handle", 3, w => w.KeptStatics.Add(w.Simulation.Statics[w.AnyStatic()])),
        new("StaticReference made by hand", 1, w => w.KeptStatics.Add(new StaticReference(w.AnyStatic(), w.Simulation.Statics))),
        Of("Exists", (w, s) => _ = s.Exists),
        Of("Index", (w, s) => _ = s.Index),
        Of("Static", (w, s) => _ = s.Static.Shape),
        Of("Pose", (w, s) => _ = s.Pose.Position.X),
        Of("Continuity", (w, s) => _ = s.Continuity.Mode),
        Of("Shape", (w, s) => _ = s.Shape),
        Of("BoundingBox", (w, s) => _ = s.BoundingBox),
        Of("CollidableReference", (w, s) => _ = s.CollidableReference),
        Of("GetDescription", (w, s) => s.GetDescription(out _)),
        Of("ApplyDescription", (w, s) => s.ApplyDescription(Describe(w))),
        Of("SetShape", (w, s) => s.SetShape(w.AnyShape())),
        Of("UpdateBounds", (w, s) => s.UpdateBounds()),
    ];

    delegate void Call(FuzzWorld world, StaticReference reference);

    static FuzzOperation Of(string name, Call call) => new("StaticReference." + name, 1, w =>
    {
        if (w.KeptStatics.Count > 20)
            w.KeptStatics.RemoveRange(0, 10);
        bool isKept = w.Has(FuzzScope.StaleReferences) && w.KeptStatics.Count > 0 && w.Random.Percent(30);
        StaticReference reference = isKept ? w.Random.Of(w.KeptStatics) : w.Simulation.Statics[w.AnyStatic()];
        w.Tell($"{reference.Handle} {(isKept ? "kept" : "")}");
        call(w, reference);
    });

    static void Add(FuzzWorld w)
    {
        if (w.Statics.Live.Count >= MaximumStatics)
            return;
        StaticDescription description = Describe(w);
        w.Statics.Live.Add(w.Simulation.Statics.Add(description));
    }

    static void AddQuietly(FuzzWorld w)
    {
        if (w.Statics.Live.Count >= MaximumStatics)
            return;
        StaticDescription description = Describe(w);
        w.Statics.Live.Add(w.Simulation.Statics.AddWithoutAwakeningBodies(description));
    }

    static StaticDescription Describe(FuzzWorld w)
    {
        StaticDescription description = w.Random.Spoil(new StaticDescription(w.AnyPose(), w.AnyShape(), ContinuousDetection.Discrete), 8);
        w.Tell($"{description.Pose.Position} {description.Pose.Orientation} {description.Shape}");
        return description;
    }
}
