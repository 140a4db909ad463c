using System;
using System.Collections.Generic;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;

namespace Demos.Fuzz;

/// <summary>One simulation that is called at random, with what is known about it: what there is, and what there was.</summary>
sealed partial class FuzzWorld : IDisposable
{
    /// <summary>More bodies than this are not added: worlds are many and small.</summary>
    public const int MaximumBodies = 40;
    const int RememberedCount = 30;

    readonly ThreadDispatcher dispatcher;

    public FuzzWorld(ulong seed, FuzzScope scope, ThreadDispatcher dispatcher)
    {
        Seed = seed;
        Scope = scope;
        this.dispatcher = dispatcher;
        Random = new FuzzRandom(seed);
        var solve = new SolveDescription(1 + Random.Below(2), 1 + Random.Below(4), Random.Percent(30) ? 1 + Random.Below(3) : 64)
        {
            RelaxationIterationCount = Random.Below(2),
            LoadPath = (LoadPathMode)Random.Below(3),
            DirectJoints = (DirectJointsMode)Random.Below(3),
        };
        SimulationAllocationSizes? sizes = Random.Percent(50) ? new(Random.Below(8), Random.Below(8), 0, Random.Below(3), Random.Below(8), 1, 1) : null;
        OwnsShapes = Random.Percent(80);
        Shapes = OwnsShapes ? null! : new Shapes(Pool, Random.Below(4));
        var mode = (AngularIntegrationMode)Random.Below(3);
        Simulation = Simulation.Create(
            Pool, new FuzzNarrowPhaseCallbacks(Plan), new FuzzPoseIntegratorCallbacks(Plan, mode), solve, null, sizes, Shapes);
        Shapes = Simulation.Shapes;
        Saved = new(Pool);
    }

    public ulong Seed { get; }

    public FuzzScope Scope { get; }

    /// <summary>Source of all that is drawn for the present call.</summary>
    public FuzzRandom Random { get; set; }

    public BufferPool Pool { get; } = new();

    public Simulation Simulation { get; }

    public Shapes Shapes { get; }

    public bool OwnsShapes { get; }

    public FuzzPlan Plan { get; } = new();

    /// <summary>What a call has saved, for one to come.</summary>
    public FuzzSnapshot Saved { get; }

    public FuzzHandles<BodyHandle> Bodies { get; } = new(RememberedCount);

    public FuzzHandles<StaticHandle> Statics { get; } = new(RememberedCount);

    public FuzzHandles<ConstraintHandle> Constraints { get; } = new(RememberedCount);

    public FuzzHandles<TypedIndex> ShapeNames { get; } = new(RememberedCount);

    /// <summary>References that are kept over removals.</summary>
    public List<BodyReference> KeptBodies { get; } = [];

    /// <summary>As <see cref="KeptBodies"/>.</summary>
    public List<StaticReference> KeptStatics { get; } = [];

    /// <summary>How shapes are disposed that own memory, which may be removed without it.</summary>
    public Dictionary<TypedIndex, Action> Owners { get; } = [];

    /// <summary>What the present call was given, for a list of calls.</summary>
    public string Arguments { get; private set; } = "";

    /// <summary>Whether somebody reads <see cref="Arguments"/>.</summary>
    public bool IsVerbose { get; init; }

    public bool Has(FuzzScope scope) => (Scope & scope) != 0;

    /// <summary>Says what the present call is given.</summary>
    public void Tell(FormattableString arguments)
    {
        if (IsVerbose)
            Arguments += " " + FormattableString.Invariant(arguments);
    }

    /// <summary>Forgets what the call before was given.</summary>
    public void BeginCall(FuzzRandom random)
    {
        Random = random;
        Arguments = "";
        Plan.WasCalled = false;
    }

    /// <summary>A dispatcher or none.</summary>
    public ThreadDispatcher? AnyDispatcher() => Random.Percent(30) ? dispatcher : null;

    /// <summary>A body: mostly one that there is, at times one that there was, or any number.</summary>
    public BodyHandle AnyBody() => Tell(Bodies.Any(Random, Has(FuzzScope.StaleReferences), bits => new(bits)));

    public StaticHandle AnyStatic() => Tell(Statics.Any(Random, Has(FuzzScope.StaleReferences), bits => new(bits)));

    /// <summary>A constraint, at times a contact: those have handles too.</summary>
    public ConstraintHandle AnyConstraint() => Tell(
        Random.Percent(15) ? new ConstraintHandle(Random.Below(60)) : Constraints.Any(Random, Has(FuzzScope.StaleReferences), bits => new(bits)));

    public TypedIndex AnyShape() => Tell(
        ShapeNames.Any(Random, Has(FuzzScope.StaleReferences), bits => new TypedIndex { Packed = (uint)bits }));

    /// <summary>A shape that nothing uses, unless the scope allows others.</summary>
    public TypedIndex RemovableShape()
    {
        TypedIndex shape = AnyShape();
        return Has(FuzzScope.UsedShapes) || !IsUsed(shape) ? shape : default;
    }

    /// <summary>A count, a bad one at times.</summary>
    public int AnyCount()
    {
        int count = Random.Count();
        return Tell(Has(FuzzScope.BadCounts) ? count : Math.Max(1, count));
    }

    /// <summary>Where things are: near enough to meet.</summary>
    public RigidPose AnyPose() => new(Random.Vector(3), Random.Turn());

    bool IsUsed(TypedIndex shape)
    {
        for (int set = 0; !IsOver && set < Simulation.Bodies.Sets.Length; ++set)
        {
            for (int i = 0; i < Simulation.Bodies.Sets[set].Count; ++i)
            {
                if (Simulation.Bodies.Sets[set].Collidables[i].Shape == shape)
                    return true;
            }
        }
        for (int i = 0; i < StaticCount; ++i)
        {
            if (Simulation.Statics[i].Shape == shape)
                return true;
        }
        return false;
    }

    T Tell<T>(T value)
    {
        if (IsVerbose)
            Arguments += " " + value;
        return value;
    }

    /// <summary>Finds out what there still is.</summary>
    public void Sync()
    {
        Bodies.Forget(Simulation.Bodies.BodyExists);
        Statics.Forget(Simulation.Statics.StaticExists);
        Constraints.Forget(Simulation.Solver.ConstraintExists);
        ShapeNames.Forget(Shapes.Exists);
    }

    /// <summary>Returns the memory of what are no shapes any more.</summary>
    public void DisposeLostShapes(bool all)
    {
        foreach (TypedIndex name in new List<TypedIndex>(Owners.Keys))
        {
            if (!all && Shapes.Exists(name))
                continue;
            Owners[name]();
            Owners.Remove(name);
        }
    }

    /// <summary>Whether the simulation was disposed, which no call should survive.</summary>
    public bool IsOver { get; private set; }

    /// <summary>Number of bodies; none when all is over.</summary>
    public int BodyCount => IsOver ? 0 : Simulation.Bodies.ActiveSet.Count;

    /// <summary>Number of statics; none when all is over.</summary>
    public int StaticCount => IsOver ? 0 : Simulation.Statics.Count;

    /// <summary>Disposes of the simulation ahead of the end.</summary>
    public void EndSimulation()
    {
        Simulation.Dispose();
        IsOver = true;
    }

    /// <summary>Returns everything; a pool that is not empty then is a failure.</summary>
    public void End()
    {
        Saved.Dispose();
        Simulation.Dispose();
        if (!OwnsShapes)
            Shapes.Dispose();
        DisposeLostShapes(true);
        CheckWorkers();
        try
        {
            Pool.AssertEmpty();
        }
        catch (Exception error)
        {
            throw new FuzzFailure("memory was not returned: " + error.Message, error);
        }
    }

    public void Dispose() => Pool.Clear();
}
