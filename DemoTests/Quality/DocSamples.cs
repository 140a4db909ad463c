using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using BepuUtilities;
using BepuUtilities.Memory;

namespace DemoTests.Quality;

/// <summary>
/// The code of the documentation, as it stands there, in methods that run it. A block of the documentation may be a part of a method
/// here; what surrounds it makes it a whole.
/// </summary>
static partial class DocSamples
{
    // README.md. The program itself; HelloWorldPackageTests runs it from the packages.
    public static void HelloWorld()
    {
        using var pool = new BufferPool();
        using var simulation = Simulation.Create(
            pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));

        var floor = simulation.Shapes.Add(new Box(100, 1, 100));
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -0.5f, 0), floor));
        var box = simulation.Bodies.Add(BodyDescription.CreateConvexDynamic(new Vector3(0, 5, 0), 1, simulation.Shapes, new Box(1, 1, 1)));

        for (int step = 0; step < 180; ++step)
            simulation.Timestep(1 / 60f);
        Console.WriteLine($"The box rests at a height of {simulation.Bodies[box].Pose.Position.Y:0.00} m.");
    }

    // What Docs/Guides/GettingStarted.md teaches, in parts that tests ask for other values. PackageTests runs the page itself.
    public static DefaultNarrowPhaseCallbacks Bouncing()
    {
        var material = new PairMaterialProperties(0.1f, 2, SpringSettings.Rigid);
        var callbacks = new DefaultNarrowPhaseCallbacks(material) { Surface = new() { Restitution = 0.5f } };
        return callbacks;
    }

    public static DefaultNarrowPhaseCallbacks Soft()
    {
        var soft = new DefaultNarrowPhaseCallbacks(new PairMaterialProperties(0.5f, 2, new SpringSettings(10, 1)));
        return soft;
    }

    public static BodyHandle AddBodies(Simulation simulation)
    {
        var shape = new Capsule(0.25f, 1);
        var index = simulation.Shapes.Add(shape);
        var inertia = shape.ComputeInertia(2);
        for (int i = 0; i < 10; ++i)
            simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(i, 3, 0), inertia, index, 0.01f));

        var platform = simulation.Bodies.Add(BodyDescription.CreateKinematic(
            new Vector3(0, 1, 0), new BodyVelocity(new Vector3(0.5f, 0, 0)), simulation.Shapes.Add(new Box(4, 0.5f, 4)), -1));
        return platform;
    }

    public static float Push(Simulation simulation, BodyHandle handle)
    {
        var body = simulation.Bodies[handle];
        body.ApplyLinearImpulse(new Vector3(0, 5, 0));
        var height = body.Pose.Position.Y;
        return height;
    }

    public static void HangAndLetGo(Simulation simulation, BodyHandle anchor, BodyHandle bob, Action between)
    {
        var joint = simulation.Solver.Add(anchor, bob, new BallSocket { LocalOffsetA = Vector3.Zero, LocalOffsetB = new Vector3(0, 1, 0) });
        between();
        simulation.Solver.Remove(joint);
    }

    public static void StepOnThreads(Simulation simulation)
    {
        using var dispatcher = new ThreadDispatcher(4);
        simulation.Timestep(1 / 60f, dispatcher);
    }

    public static (SolveDescription Usual, SolveDescription Stiff, SolveDescription Calm) Dial()
    {
        var usual = new SolveDescription(velocityIterationCount: 1, substepCount: 4);
        var stiff = new SolveDescription(velocityIterationCount: 1, substepCount: 16);
        var calm = new SolveDescription(velocityIterationCount: 1, substepCount: 4) { RelaxationIterationCount = 1 };
        return (usual, stiff, calm);
    }

    // Docs/Internals/Memory.md
    public static void GiveEverythingBack()
    {
        var pool = new BufferPool();
        var simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        simulation.Timestep(1 / 60f);
        simulation.Dispose();
        pool.AssertEmpty();
        pool.Dispose();
    }

    // Docs/Recipes/AddAConstraint.md
    public static ConstraintHandle KeepAbove(Simulation simulation, BodyHandle body)
    {
        var limit = simulation.Solver.Add(body, new HeightLimit { MinimumHeight = 1 });
        return limit;
    }

    // Docs/Recipes/AddAPair.md
    public static void RegisterPair(Simulation simulation)
    {
        simulation.NarrowPhase.CollisionTaskRegistry.Register(
            new ConvexCollisionTask<Sphere, SphereWide, Sphere, SphereWide, Few1<ContactWide>, CushionedSphereTester>());
    }
}

// As in Docs/Guides/GettingStarted.md, but for what names the ice.
struct IceCallbacks : INarrowPhaseCallbacks
{
    public StaticHandle Ice;

    public readonly void Initialize(Simulation simulation) { }

    public readonly bool AllowContactGeneration(
        int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) => true;

    public readonly bool ConfigureContactManifold<TManifold>(
        int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        var onIce = pair.B.Mobility == CollidableMobility.Static && pair.B.StaticHandle == Ice;
        pairMaterial = new PairMaterialProperties(onIce ? 0 : 0.5f, 2, SpringSettings.Rigid);
        return true;
    }

    public readonly bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

    public readonly bool ConfigureContactManifold(
        int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

    public readonly void Dispose() { }
}

// Docs/Recipes/AddAConstraint.md
/// <summary>Keeps the centre of a body above a height.</summary>
public struct HeightLimit : IOneBodyConstraintDescription<HeightLimit>
{
    /// <summary>Least height of the centre, m.</summary>
    public float MinimumHeight;
    /// <summary>Stiffness of the limit; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    public static int ConstraintTypeId => 100;
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        OneBody, HeightLimitWide, Rows1, JointConstraint<OneBody, HeightLimitWide, HeightLimitGeometry, Rows1, Rows1, HeightLimitJoint>>();

    public static void Validate(in HeightLimit description)
    {
        if (!float.IsFinite(description.MinimumHeight))
            throw new ArgumentException($"{nameof(MinimumHeight)} must be finite, not {description.MinimumHeight}.", nameof(description));
        if (!SpringSettings.Validate(description.SpringSettings))
            throw new ArgumentException($"{nameof(SpringSettings)} must be finite and not negative.", nameof(description));
    }
}

/// <summary>A bundle of <see cref="HeightLimit"/>: the same fields, widened, in the same order.</summary>
public struct HeightLimitWide : IWide<HeightLimit>
{
    public Vector<float> MinimumHeight;
    public SpringSettingsWide SpringSettings;
}

/// <summary>What the rows need beyond the bodies: nothing but the slack.</summary>
public struct HeightLimitGeometry
{
    public Vector<float> Slack;
}

/// <summary>Row of <see cref="HeightLimit"/>.</summary>
// C = x.y - minimum >= 0
// J = [ 0 1 0, 0 0 0 ]   over (v, w)
// K = 1/m
public readonly struct HeightLimitJoint : IJoint<OneBody, HeightLimitWide, HeightLimitGeometry, Rows1, Rows1>
{
    public static RowKind Kind => RowKind.Inequality;

    public static void Prepare(in OneBody bodies, in HeightLimitWide prestep, out HeightLimitGeometry geometry) =>
        geometry.Slack = bodies.A.Position.Y - prestep.MinimumHeight;

    public static void PositionError(in OneBody bodies, in HeightLimitWide prestep, in HeightLimitGeometry geometry, out Rows1 error) =>
        error.X = geometry.Slack;

    public static void RelativeVelocity(in HeightLimitGeometry geometry, in OneBody bodies, out Rows1 velocity) =>
        velocity.X = bodies.A.Linear.Y;

    public static void ApplyImpulse(in HeightLimitGeometry geometry, ref OneBody bodies, in Rows1 impulse) =>
        bodies.A.Linear.Y += impulse.X * bodies.A.InverseMass;

    public static void InverseEffectiveMass(in HeightLimitGeometry geometry, in OneBody bodies, out Rows1 inverseMass) =>
        inverseMass.X = bodies.A.InverseMass;

    public static SpringSettingsWide Spring(in HeightLimitWide prestep) => prestep.SpringSettings;
}

// Docs/Recipes/AddAPair.md
/// <summary>Spheres that sink one centimetre into each other before they touch.</summary>
public readonly struct CushionedSphereTester : IPairTester<SphereWide, SphereWide, Few1<ContactWide>>
{
    public static bool NeedsOrientationA => false;
    public static bool NeedsOrientationB => false;

    public static void Test(in SphereWide a, in SphereWide b, in PairPoseWide pose, Vector<float> speculativeMargin,
        out ConvexManifoldWide<Few1<ContactWide>> manifold)
    {
        var distance = pose.OffsetB.Length();
        var depth = a.Radius + b.Radius - new Vector<float>(0.01f) - distance;
        // Coincident centres: any direction will do, so it is +y.
        var apart = Vector.GreaterThan(distance, Vector<float>.Zero);
        var up = new Vector3Wide(Vector<float>.Zero, Vector<float>.One, Vector<float>.Zero);
        manifold.Normal = Vector3Wide.Select(apart, pose.OffsetB * (-Vector<float>.One / distance), up);
        ContactWide contact;
        contact.OffsetA = manifold.Normal * (depth * new Vector<float>(0.5f) - a.Radius);
        contact.Depth = depth;
        contact.FeatureId = Vector<int>.Zero;
        contact.Exists = Vector.GreaterThanOrEqual(depth, -speculativeMargin);
        manifold.Contacts = default;
        manifold.Contacts[0] = contact;
    }
}

// Docs/Recipes/AddAConstraint.md
/// <summary>Lifts the centre of a body at a speed.</summary>
public struct Lift : IOneBodyConstraintDescription<Lift>
{
    /// <summary>Speed upwards, m/s.</summary>
    public float TargetVelocity;
    /// <summary>Greatest force, N, and softness.</summary>
    public MotorSettings Settings;

    public static int ConstraintTypeId => 101;
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        OneBody, LiftWide, Rows1, JointConstraint<OneBody, LiftWide, LiftGeometry, Rows1, Rows1, LiftJoint>>();

    public static void Validate(in Lift description)
    {
        if (!float.IsFinite(description.TargetVelocity))
            throw new ArgumentException($"{nameof(TargetVelocity)} must be finite, not {description.TargetVelocity}.", nameof(description));
        if (!MotorSettings.Validate(description.Settings))
            throw new ArgumentException($"{nameof(Settings)} must not be negative.", nameof(description));
    }
}

/// <summary>A bundle of <see cref="Lift"/>.</summary>
public struct LiftWide : IWide<Lift>
{
    public Vector<float> TargetVelocity;
    public MotorSettingsWide Settings;
}

/// <summary>Nothing: the row is the same for all poses.</summary>
public struct LiftGeometry;

/// <summary>Row of <see cref="Lift"/>.</summary>
// J v = v.y = target
// J = [ 0 1 0, 0 0 0 ]   over (v, w)
// K = 1/m
public readonly struct LiftJoint : IMotor<OneBody, LiftWide, LiftGeometry, Rows1, Rows1>
{
    public static void Prepare(in OneBody bodies, in LiftWide prestep, out LiftGeometry geometry) => geometry = default;

    public static void TargetVelocity(in OneBody bodies, in LiftWide prestep, in LiftGeometry geometry, out Rows1 velocity) =>
        velocity.X = prestep.TargetVelocity;

    public static void RelativeVelocity(in LiftGeometry geometry, in OneBody bodies, out Rows1 velocity) =>
        velocity.X = bodies.A.Linear.Y;

    public static void ApplyImpulse(in LiftGeometry geometry, ref OneBody bodies, in Rows1 impulse) =>
        bodies.A.Linear.Y += impulse.X * bodies.A.InverseMass;

    public static void InverseEffectiveMass(in LiftGeometry geometry, in OneBody bodies, out Rows1 inverseMass) =>
        inverseMass.X = bodies.A.InverseMass;

    public static MotorSettingsWide Motor(in LiftWide prestep) => prestep.Settings;
}
