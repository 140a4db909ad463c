using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Scenes;
using DemoTests.Support;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection.Sweeps;

/// <summary>Pairs of shapes of any types, both of which may move.</summary>
public sealed unsafe class SweepTaskTests(ITestOutputHelper output) : IDisposable
{
    static readonly SweepTaskRegistry registry = new();

    readonly ConvexPairLibrary library = new();
    readonly BufferPool pool = new();

    public void Dispose()
    {
        library.Dispose();
        pool.AssertEmpty();
        pool.Clear();
    }

    struct Counter(List<(int, int)> asked) : ISweepFilter
    {
        public readonly bool AllowTest(int childA, int childB)
        {
            asked.Add((childA, childB));
            return true;
        }
    }

    readonly record struct Result(bool IsHit, float T, Vector3 Place, Vector3 Normal);

    Result Sweep<TA, TB>(TA a, Quaternion orientationA, BodyVelocity velocityA, TB b, Vector3 offsetB, Quaternion orientationB, BodyVelocity velocityB,
        Shapes shapes, float maximumT = 1, List<(int, int)>? asked = null) where TA : unmanaged, IShape where TB : unmanaged, IShape
    {
        var filter = new Counter(asked ?? []);
        var task = registry.GetTask<TA, TB>()!;
        var isHit = task.Sweep(&a, TA.TypeId, orientationA, velocityA, &b, TB.TypeId, offsetB, orientationB, velocityB, maximumT, 0, 0, 1024, ref filter,
            shapes, registry, pool, out var t0, out var t1, out var place, out var normal);
        Assert.Equal(t0, t1);
        return new(isHit, t1, place, normal);
    }

    [Fact]
    public void There_is_a_task_for_every_pair_but_two_half_spaces()
    {
        for (int a = 0; a <= HalfSpace.Id; ++a)
        {
            for (int b = 0; b <= HalfSpace.Id; ++b)
            {
                var task = registry.GetTask(a, b);
                Assert.Equal(a != HalfSpace.Id || b != HalfSpace.Id, task is not null);
                Assert.Same(task, registry.GetTask(b, a));
            }
        }
        Assert.Null(registry.GetTask(-1, 0));
        Assert.Null(registry.GetTask(0, 77));
    }

    [Theory]
    [InlineData(ConvexKind.Box, ConvexKind.Cylinder)]
    [InlineData(ConvexKind.Hull, ConvexKind.Triangle)]
    [InlineData(ConvexKind.Capsule, ConvexKind.Sphere)]
    public void Who_is_first_makes_no_difference(ConvexKind a, ConvexKind b)
    {
        using var shapes = new DisposableShapes(pool);
        for (int i = 0; i < 60; ++i)
        {
            var pair = Next(a, b, i);
            var one = MovingPairs.Sweep(pair, shapes.Shapes, pool);
            var other = MovingPairs.Sweep(new(pair.B, pair.A, -pair.OffsetB, pair.OrientationB, pair.OrientationA, pair.VelocityB, pair.VelocityA),
                shapes.Shapes, pool);
            Assert.Equal(one.IsHit, other.IsHit);
            Assert.InRange(other.T, one.T - 2e-4f, one.T + 2e-4f);
        }
    }

    [Fact]
    public void A_pair_of_any_size_anywhere_is_the_same_pair()
    {
        using var shapes = new DisposableShapes(pool);
        for (int i = 0; i < 100; ++i)
        {
            var random = new Random(i);
            Vector3 sizes = TestWorld.Scatter(random, 1) + new Vector3(1), offset = TestWorld.Scatter(random, 8);
            BodyVelocity velocity = new(offset * 2, TestWorld.Scatter(random, 20));
            Quaternion orientationA = TestWorld.Turn(random), orientationB = TestWorld.Turn(random);
            Result At(float scale) => Sweep(new Box(sizes.X * scale, sizes.Y * scale, sizes.Z * scale), orientationA,
                velocity with { Linear = velocity.Linear * scale }, new Cylinder(.6f * scale, scale), offset * scale, orientationB, default, shapes.Shapes);
            var one = At(1);
            // Powers of two.
            foreach (var scale in new[] { 1 / 1048576f, 1024 })
                Assert.Equal(one with { Place = one.Place * scale }, At(scale));
        }
    }

    // What is told without numbers is what a million rounds would tell.
    [Fact]
    public void No_pair_comes_near_the_limit_of_rounds()
    {
        using var shapes = new DisposableShapes(pool);
        int[] limits = [25, 64, 256, 1024, 16_384];
        var less = new int[limits.Length];
        int count = 0;
        foreach (var a in Enum.GetValues<ConvexKind>())
        {
            foreach (var b in Enum.GetValues<ConvexKind>())
            {
                for (int i = 0; i < 18; ++i, ++count)
                {
                    var pair = Next(a, b, i);
                    // Those that turn on the spot, or spin: by up to 20,000 rad.
                    if (i % 2 == 0)
                        pair = pair with { VelocityA = pair.VelocityA with { Angular = pair.VelocityA.Angular * 100 } };
                    var full = MovingPairs.Sweep(pair, shapes.Shapes, pool, maximumRounds: 1 << 20);
                    for (int j = 0; j < limits.Length; ++j)
                        less[j] += MovingPairs.Sweep(pair, shapes.Shapes, pool, maximumRounds: limits[j]) != full ? 1 : 0;
                }
            }
        }
        output.WriteLine($"of {count} motions, {less[0]} take more than 25 rounds, {less[1]} more than 64, {less[2]} more than 256, " +
            $"{less[3]} more than 1,024, {less[4]} more than 16,384");
        Assert.Equal(0, less[4]);
    }

    [Fact]
    public void Containers_are_their_children_whoever_moves()
    {
        using var shapes = new DisposableShapes(pool);
        var box = shapes.Shapes.Add(new Box(1, .5f, .7f));
        var ball = shapes.Shapes.Add(new Sphere(.5f));
        pool.Take<CompoundChild>(2, out var children);
        children[0] = new(new RigidPose(new(-1, 0, 0), Quaternion.CreateFromAxisAngle(Vector3.UnitY, .5f)), box);
        children[1] = new(new RigidPose(new(1, .2f, 0)), ball);
        var compound = new Compound(children);
        var big = new BigCompound(children, shapes.Shapes, pool);
        var mesh = new Mesh([new(new(-1, 0, -1), new(1, 0, -1), new(0, 0, 1)), new(new(-1, 0, -1), new(0, 0, 1), new(-1, 0, 1))], Vector3.One, pool)
        {
            TwoSided = true,
        };
        int hits = 0;
        for (int i = 0; i < 200; ++i)
        {
            var random = new Random(i);
            var offset = TestWorld.Scatter(random, 10);
            Quaternion orientationA = TestWorld.Turn(random), orientationB = TestWorld.Turn(random);
            BodyVelocity a = new(offset * random.NextSingle(), TestWorld.Scatter(random, 6)), b = new(-offset, TestWorld.Scatter(random, 6));
            var capsule = new Capsule(.2f, .6f);
            var expected = FirstOf(
                Child(0, new Box(1, .5f, .7f)), Child(1, new Sphere(.5f)));

            // The reference: a child alone, about the container's centre, is a compound of one.
            Result Child<TShape>(int index, TShape shape) where TShape : unmanaged, IConvexShape
            {
                pool.Take<CompoundChild>(1, out var one);
                one[0] = children[index];
                var result = Sweep(capsule, orientationA, a, new Compound(one), offset, orientationB, b, shapes.Shapes);
                pool.Return(ref one);
                return result;
            }

            var asked = new List<(int, int)>();
            Assert.Equal(expected, Sweep(capsule, orientationA, a, compound, offset, orientationB, b, shapes.Shapes, asked: asked));
            Assert.All(asked, children => Assert.True(children.Item1 == 0 && children.Item2 is 0 or 1));
            Assert.Equal(expected, Sweep(capsule, orientationA, a, big, offset, orientationB, b, shapes.Shapes));
            asked.Clear();
            var flipped = Sweep(compound, orientationB, b, capsule, -offset, orientationA, a, shapes.Shapes, asked: asked);
            Assert.All(asked, children => Assert.True(children.Item2 == 0 && children.Item1 is 0 or 1));
            Assert.Equal((expected.IsHit, expected.T, -expected.Normal), (flipped.IsHit, flipped.T, flipped.Normal));
            if (expected.IsHit && expected.T > 0)
                Assert.InRange(Vector3.Distance(expected.Place - offset, flipped.Place), 0, 1e-4f);

            // Two containers, from either side.
            var pair = Sweep(compound, orientationA, a, mesh, offset, orientationB, b, shapes.Shapes);
            var back = Sweep(mesh, orientationB, b, big, -offset, orientationA, a, shapes.Shapes);
            Assert.Equal(pair.IsHit, back.IsHit);
            Assert.InRange(back.T, pair.T - 1e-4f, pair.T + 1e-4f);
            hits += (expected.IsHit ? 1 : 0) + (pair.IsHit ? 1 : 0);
            // And the ground, which may be either.
            var ground = new HalfSpace(Vector3.UnitY);
            var onGround = Sweep(compound, orientationA, a, ground, offset - new Vector3(0, 4, 0), orientationB, default, shapes.Shapes);
            var underneath = Sweep(ground, orientationB, default, compound, new Vector3(0, 4, 0) - offset, orientationA, a, shapes.Shapes);
            Assert.Equal((onGround.IsHit, onGround.T), (underneath.IsHit, underneath.T));
            if (onGround.IsHit && onGround.T > 0)
                Assert.InRange(Vector3.Distance(onGround.Normal, -underneath.Normal), 0, 1e-6f);
        }
        Assert.True(hits > 60, $"{hits}");
        pool.Return(ref children);
        big.Tree.Dispose(pool);
        mesh.Dispose(pool);

        static Result FirstOf(Result first, Result second) => !first.IsHit || (second.IsHit && second.T < first.T) ? second : first;
    }

    MovingPair Next(ConvexKind a, ConvexKind b, int index)
    {
        var kinds = Enum.GetValues<SweepMotionKind>();
        var random = new ConvexRandom(9, (ulong)(((int)a * 6 + (int)b) << 20 | index));
        var (sizeA, sizeB) = ConvexPoses.NextSizes(random);
        var shapeA = library.Create(ConvexGenerator.Create(a, ConvexGenerator.NextForm(random), sizeA, random));
        var shapeB = library.Create(ConvexGenerator.Create(b, ConvexGenerator.NextForm(random), sizeB, random));
        return MovingPairs.Create(shapeA, shapeB, kinds[index % kinds.Length], random);
    }
}
