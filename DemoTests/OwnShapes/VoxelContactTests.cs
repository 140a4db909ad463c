using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Collidables.Meshes;
using DemoTests.Compounds;
using Xunit;
using static DemoTests.Quality.DocSamples;

namespace DemoTests.OwnShapes;

/// <summary>The contacts of voxels are those of a compound of the same cubes, bit for bit, with whatever they are tested.</summary>
public class VoxelContactTests
{
    const float Margin = .1f;

    // Contacts of children, and what becomes of those of a pair.
    readonly struct Callbacks(Dictionary<(int Pair, int A, int B), string> children) : ICollisionCallbacks
    {
        public bool AllowCollisionTesting(int pairId, int childA, int childB) => true;

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold)
        {
            if (manifold.Count > 0)
                children.Add((pairId, childA, childB), Describe(ref manifold));
        }

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> { }

        static string Describe(ref ConvexContactManifold manifold)
        {
            var text = $"{manifold.Count} {Bits(manifold.Normal)}";
            for (int i = 0; i < manifold.Count; ++i)
            {
                var contact = ConvexContactManifold.GetConvexContactReference(ref manifold, i);
                text += $" {Bits(contact.Offset)} {BitConverter.SingleToInt32Bits(contact.Depth)} {contact.FeatureId}";
            }
            return text;
        }

        // Zeros of either sign are the same place.
        static string Bits(Vector3 v) => string.Join(",", Enumerable.Range(0, 3).Select(i => BitConverter.SingleToInt32Bits(v[i] + 0f)));
    }

    readonly record struct Both(TypedIndex Voxels, TypedIndex Cubes, int[] CellOfCube);

    static Both Add(CompoundWorkshop workshop, int width, int height, int length, float size)
    {
        var corner = new Vector3(-width, -height, -length) * (size * .5f) + workshop.NextVector(.1f);
        var voxels = new Voxels(width, height, length, size, corner, workshop.Pool);
        var cube = workshop.Shapes.Add(new Box(size, size, size));
        List<int> cells = [];
        for (int i = 0; i < voxels.ChildCount; ++i)
        {
            voxels.Cells[i] = i == 0 || workshop.Random.Next(3) > 0;
            if (voxels.Cells[i])
                cells.Add(i);
        }
        workshop.Pool.Take(cells.Count, out Buffer<CompoundChild> children);
        for (int i = 0; i < cells.Count; ++i)
        {
            voxels.GetPosedLocalChild(cells[i], out _, out var pose);
            children[i] = new(pose, cube);
        }
        return new(workshop.Shapes.Add(voxels), workshop.Add(children, isBig: true), [.. cells]);
    }

    static Dictionary<(int Pair, int A, int B), string> Test(CompoundWorkshop workshop, TypedIndex a, TypedIndex b, (RigidPose A, RigidPose B)[] poses)
    {
        var registry = DefaultTypes.CreateDefaultCollisionTaskRegistry();
        registry.RegisterHomogeneousCompound<Voxels, Box, BoxWide>();
        var found = new Dictionary<(int, int, int), string>();
        using var batcher = new CollisionBatcher<Callbacks>(workshop.Pool, workshop.Shapes, registry, 1 / 60f, new(found));
        for (int i = 0; i < poses.Length; ++i)
        {
            var (poseA, poseB) = poses[i];
            batcher.Add(a, b, poseB.Position - poseA.Position, poseA.Orientation, poseB.Orientation, new(new(1, -2, .5f), new(.3f, 2, 1)),
                new(new(0, 1, 0)), Margin, 1, new(i));
        }
        batcher.Flush();
        return found;
    }

    static (RigidPose, RigidPose)[] Poses(CompoundWorkshop workshop, int count, float spread, bool isTurned) => [.. Enumerable.Range(0, count).Select(_ =>
        (new RigidPose(workshop.NextVector(spread), isTurned ? workshop.NextTurn() : Quaternion.Identity),
            new RigidPose(workshop.NextVector(.1f), isTurned ? workshop.NextTurn() : Quaternion.Identity)))];

    // With the voxels first, and second.
    static void Compare(CompoundWorkshop workshop, TypedIndex other, Both both, float spread, bool isTurned)
    {
        var poses = Poses(workshop, 60, spread, isTurned);
        var expected = Test(workshop, other, both.Cubes, poses).ToDictionary(
            pair => (pair.Key.Pair, pair.Key.A, both.CellOfCube[pair.Key.B]), pair => pair.Value);
        Assert.True(expected.Count > 20, $"{expected.Count} children touch.");
        AssertSame(expected, Test(workshop, other, both.Voxels, poses));
        var turned = Array.ConvertAll(poses, pose => (pose.Item2, pose.Item1));
        var flipped = Test(workshop, both.Cubes, other, turned).ToDictionary(
            pair => (pair.Key.Pair, both.CellOfCube[pair.Key.A], pair.Key.B), pair => pair.Value);
        AssertSame(flipped, Test(workshop, both.Voxels, other, turned));
    }

    static void AssertSame(Dictionary<(int, int, int), string> expected, Dictionary<(int, int, int), string> actual)
    {
        Assert.Equal(expected.Keys.Order(), actual.Keys.Order());
        Assert.All(expected, pair => Assert.Equal(pair.Value, actual[pair.Key]));
    }

    public static TheoryData<int, bool> Types
    {
        get
        {
            var data = new TheoryData<int, bool>();
            for (int type = Sphere.Id; type <= HalfSpace.Id; ++type)
            {
                data.Add(type, false);
                data.Add(type, true);
            }
            return data;
        }
    }

    [Theory, MemberData(nameof(Types))]
    public void They_are_those_of_cubes(int type, bool isTurned)
    {
        using var workshop = new CompoundWorkshop(11 + type);
        var both = Add(workshop, 5, 4, 6, .5f);
        var sample = MeshSample.Terrain(6, .3f);
        var field = new float[49];
        for (int i = 0; i < field.Length; ++i)
            field[i] = workshop.Next(-.2f, .2f);
        var other = type switch
        {
            HalfSpace.Id => workshop.Shapes.Add(new HalfSpace(Vector3.Normalize(new(.1f, 1, -.3f)))),
            Compound.Id or BigCompound.Id => workshop.AddCompound(7, 1, type == BigCompound.Id),
            Mesh.Id => workshop.Shapes.Add(new Mesh(sample.Vertices, sample.Indices, Vector3.One, workshop.Pool)),
            HeightField.Id => workshop.Shapes.Add(new HeightField(7, 7, .6f, .6f, field, workshop.Pool)),
            _ => workshop.AddShape(type),
        };
        Compare(workshop, other, both, type is HalfSpace.Id or HeightField.Id ? 1.2f : 1.6f, isTurned);
    }

    [Theory, InlineData(false, 3), InlineData(true, 3), InlineData(true, 12)]
    public void Two_voxel_shapes_meet_as_two_compounds_do(bool isTurned, int size)
    {
        using var workshop = new CompoundWorkshop(31);
        var (a, b) = (Add(workshop, 4, 3, 2, .4f), Add(workshop, size, size, size, .5f));
        var poses = Poses(workshop, 60, .3f * size + .5f, isTurned);
        var expected = Test(workshop, a.Cubes, b.Cubes, poses).ToDictionary(
            pair => (pair.Key.Pair, a.CellOfCube[pair.Key.A], b.CellOfCube[pair.Key.B]), pair => pair.Value);
        Assert.True(expected.Count > 100, $"{expected.Count} children touch.");
        AssertSame(expected, Test(workshop, a.Voxels, b.Voxels, poses));
        // And one of each.
        AssertSame(expected, Test(workshop, a.Cubes, b.Voxels, poses).ToDictionary(
            pair => (pair.Key.Pair, a.CellOfCube[pair.Key.A], pair.Key.B), pair => pair.Value));
    }
}
