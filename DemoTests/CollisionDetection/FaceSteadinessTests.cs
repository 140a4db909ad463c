using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using Demos.Accuracy;
using Xunit;
using Harness = DemoTests.CollisionDetection.FaceHarness<
    DemoTests.CollisionDetection.FaceTestPolygon, DemoTests.CollisionDetection.FaceTestPolygonWide, DemoTests.CollisionDetection.FaceTestFeature,
    DemoTests.CollisionDetection.FaceTestPolygon, DemoTests.CollisionDetection.FaceTestPolygonWide, DemoTests.CollisionDetection.FaceTestFeature>;
using Pair = DemoTests.CollisionDetection.FacePair<DemoTests.CollisionDetection.FaceTestPolygon, DemoTests.CollisionDetection.FaceTestPolygon>;

namespace DemoTests.CollisionDetection;

/// <summary>Which four of more than four corners are contacts: even ones, and the same ones while nothing but rounding changes.</summary>
public class FaceSteadinessTests
{
    const float Depth = 0.01f;

    /// <summary>A regular polygon of radius one that looks up or down.</summary>
    static FaceTestPolygon Regular(int count, double turn, bool up)
    {
        var vertices = new Vector3[count];
        for (int i = 0; i < count; ++i)
        {
            // Seen from above, angles about Y run counter-clockwise from Z to X.
            var angle = (up ? 1 : -1) * i * Math.Tau / count + turn;
            vertices[i] = new((float)Math.Sin(angle), 0, (float)Math.Cos(angle));
        }
        return new(vertices, up ? Vector3.UnitY : -Vector3.UnitY);
    }

    /// <summary>A regular polygon on a large square, tilted by a small rotation vector.</summary>
    static Pair OnSquare(int count, double turn, Vector3 tilt = default)
    {
        var square = new FaceTestPolygon([new(-3, 0, 3), new(3, 0, 3), new(3, 0, -3), new(-3, 0, -3)], Vector3.UnitY);
        var orientation = Quaternion.Normalize(new(tilt / 2, 1));
        var deepest = Math.Sqrt(tilt.X * tilt.X + tilt.Z * tilt.Z);
        return new(Regular(count, turn, up: false), square, new(0, Depth - (float)deepest, 0), orientation, Quaternion.Identity,
            Vector3.UnitY, Depth, default, 0.1f);
    }

    [Theory]
    [InlineData(6)]
    [InlineData(8)]
    [InlineData(10)]
    [InlineData(14)]
    [InlineData(16)]
    public void ARegularPolygonRestsOnTwoPairsOfOppositeCorners(int count)
    {
        for (int i = 0; i < 40; ++i)
        {
            var contacts = Harness.Run(OnSquare(count, i * 0.17));
            Assert.Equal(4, contacts.Contacts.Length);
            // Their middle is the polygon's.
            var sum = contacts.Contacts.Aggregate(default(References.Double3), (total, contact) => total + contact.Offset);
            Assert.True(Math.Sqrt(sum.X * sum.X + sum.Z * sum.Z) < 1e-3, $"{sum} at turn {i}");
        }
    }

    [Theory]
    [InlineData(5)]
    [InlineData(6)]
    [InlineData(7)]
    [InlineData(8)]
    [InlineData(16)]
    public void CornersStayWhileTheTiltIsNextToNothing(int count)
    {
        var random = new Random(count);
        var sets = new HashSet<string>();
        var setsOfStrangers = new HashSet<string>();
        int remembered = 0;
        for (int i = 0; i < 400; ++i)
        {
            var pair = OnSquare(count, 0.1, new Vector3((float)random.NextDouble() - 0.5f, 0, (float)random.NextDouble() - 0.5f) * 5e-5f);
            sets.Add(Ids(Harness.Run(pair, ref remembered)));
            setsOfStrangers.Add(Ids(Harness.Run(pair)));
        }
        Assert.Single(sets);
        Assert.True(setsOfStrangers.Count > 1, "nothing would have changed anyway");
    }

    [Fact]
    public void ACornerThatIsReallyDeeperTakesOver()
    {
        int remembered = 0;
        Harness.Run(OnSquare(6, 0.1), ref remembered);
        for (int i = 0; i < 12; ++i)
        {
            double angle = i * Math.Tau / 12;
            var pair = OnSquare(6, 0.1, new Vector3((float)Math.Sin(angle), 0, (float)Math.Cos(angle)) * 1e-3f);
            Assert.Equal(Harness.Run(pair).Deepest, Harness.Run(pair, ref remembered).Deepest, 1e-7);
        }
    }

    [Fact]
    public void PairsWithoutContactsKeepWhatIsRemembered()
    {
        int remembered = 0x0305;
        var apart = OnSquare(6, 0.1) with { Depth = -0.2f };
        Assert.Empty(Harness.Run(apart, ref remembered).Contacts);
        Assert.Equal(0x0305, remembered);
    }

    static string Ids(FaceContacts contacts) => string.Join(' ', contacts.Contacts.Select(contact => contact.FeatureId).Order());

    [Theory]
    [InlineData(6)]
    [InlineData(8)]
    [InlineData(10)]
    [InlineData(64)]
    public void AStackOfPrismsAtRestKeepsItsFeatureIds(int sideCount)
    {
        const int Count = 10;
        const float HalfHeight = 0.3f;
        var settings = AccuracySettings.For(Effort.Accurate);
        var pool = new BufferPool();
        var manifolds = new SortedDictionary<(uint, uint), string>();
        var simulation = Simulation.Create(pool, new Recorder(manifolds), new WorldGravity(settings), new SolveDescription(1, 16));
        var hull = new ConvexHull(Solids.Prism(sideCount, 0.5, HalfHeight), pool, out _);
        var shape = simulation.Shapes.Add(hull);
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -1, 0), Quaternion.Identity, simulation.Shapes.Add(new Box(9, 2, 9))));
        for (int i = 0; i < Count; ++i)
        {
            simulation.Bodies.Add(BodyDescription.CreateDynamic(
                new RigidPose(new Vector3(0, (2 * i + 1) * HalfHeight, 0)), hull.ComputeInertia(1), new CollidableDescription(shape),
                new BodyActivityDescription(-1)));
        }
        for (int i = 0; i < 180; ++i)
            simulation.Timestep(1 / 60f);
        Assert.Equal(Count, manifolds.Count);
        var before = manifolds.ToArray();
        for (int i = 0; i < 300; ++i)
        {
            simulation.Timestep(1 / 60f);
            Assert.Equal(before, manifolds);
        }
        simulation.Dispose();
        hull.Dispose(pool);
        pool.Clear();
    }

    /// <summary>Notes the feature ids of each pair, in order.</summary>
    readonly struct Recorder(SortedDictionary<(uint A, uint B), string> manifolds) : INarrowPhaseCallbacks
    {
        public void Initialize(Simulation simulation)
        {
        }

        public bool AllowContactGeneration(int workerIndex, CollidableReference a, CollidableReference b, ref float speculativeMargin) => true;

        public bool AllowContactGeneration(int workerIndex, CollidablePair pair, int childIndexA, int childIndexB) => true;

        public bool ConfigureContactManifold<TManifold>(
            int workerIndex, CollidablePair pair, ref TManifold manifold, out PairMaterialProperties pairMaterial)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            var ids = new int[manifold.Count];
            for (int i = 0; i < ids.Length; ++i)
                ids[i] = manifold.GetFeatureId(i);
            Array.Sort(ids);
            manifolds[(pair.A.Packed, pair.B.Packed)] = string.Join(' ', ids);
            pairMaterial = new(0.5f, 2, default);
            return true;
        }

        public bool ConfigureContactManifold(
            int workerIndex, CollidablePair pair, int childIndexA, int childIndexB, ref ConvexContactManifold manifold) => true;

        public void Dispose()
        {
        }
    }
}
