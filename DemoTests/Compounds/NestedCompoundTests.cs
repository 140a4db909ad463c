using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Collidables.Meshes;
using Xunit;

namespace DemoTests.Compounds;

/// <summary>Compounds of children that are made of children themselves: numbers of pieces, bounds, rays, inertia, and what may be a child.</summary>
public sealed class NestedCompoundTests : IDisposable
{
    readonly CompoundWorkshop workshop = new(17);

    Shapes Shapes => workshop.Shapes;

    public void Dispose() => workshop.Dispose();

    Buffer<CompoundChild> Children(params TypedIndex[] names)
    {
        workshop.Pool.Take(names.Length, out Buffer<CompoundChild> children);
        for (int i = 0; i < names.Length; ++i)
            children[i] = new(new RigidPose(new Vector3(i, 0, 0)), names[i]);
        return children;
    }

    TypedIndex AddBoxMesh(Vector3 half, Vector3 offset = default)
    {
        var sample = MeshSample.Box(half).Moved(offset);
        return Shapes.Add(new Mesh(sample.Vertices, sample.Indices, Vector3.One, workshop.Pool));
    }

    [Fact]
    public void Each_piece_has_a_number_of_its_own_that_says_where_it_is_from()
    {
        var sphere = Shapes.Add(new Sphere(1));
        var inner = workshop.AddCompound(5, 1, isBig: true);
        var compound = new Compound(Children(sphere, AddBoxMesh(Vector3.One), sphere, inner));
        var numbers = new HashSet<int>();
        foreach (var (child, count) in ((int, int)[])[(0, 1), (1, 12), (2, 1), (3, 5)])
        {
            for (int i = 0; i < count; ++i)
            {
                var number = compound.GetPieceIndex(child, i);
                Assert.True(numbers.Add(number));
                compound.FindPiece(number, out var foundChild, out var foundInner);
                Assert.Equal((child, i), (foundChild, foundInner));
            }
        }
        Assert.Equal((0, 2), (compound.GetPieceIndex(0), compound.GetPieceIndex(2)));
        foreach (var number in (int[])[-1, 1, 3, 4, int.MinValue, int.MaxValue])
            Assert.Throws<ArgumentOutOfRangeException>(() => compound.FindPiece(number, out _, out _));
        foreach (var (child, piece) in ((int, int)[])[(-1, 0), (4, 0), (0, 1), (1, -1), (1, int.MaxValue)])
            Assert.Throws<ArgumentOutOfRangeException>(() => compound.GetPieceIndex(child, piece));
        // What follows a child that goes has other numbers, and these say so.
        compound.RemoveAt(0, workshop.Pool);
        compound.FindPiece(compound.GetPieceIndex(0, 4), out var moved, out var piece4);
        Assert.Equal((0, 4, inner), (moved, piece4, compound.GetChild(0).ShapeIndex));
        compound.Dispose(workshop.Pool);
    }

    [Theory, InlineData(false), InlineData(true)]
    public void Bounds_hold_all_pieces_however_it_is_turned(bool isBig)
    {
        var name = workshop.AddNested(isBig);
        Assert.True(Shapes.GetBatch(name.Type).IsForStaticsOnly(name.Index));
        var pieces = workshop.PiecesOf(name);
        var radius = Shapes.GetBatch(name.Type).MaximumRadius(name.Index);
        for (int i = 0; i < 10; ++i)
        {
            var turn = i == 0 ? Quaternion.Identity : workshop.NextTurn();
            Shapes.UpdateBounds(new RigidPose(default, turn), name, out var whole);
            var union = BoundingBox.Empty;
            foreach (var piece in pieces)
            {
                Shapes.UpdateBounds(piece.Place(turn), piece.Shape, out var bounds);
                union = BoundingBox.CreateMerged(union, bounds);
            }
            Assert.True(whole.Min.X <= union.Min.X + 1e-5f && whole.Min.Y <= union.Min.Y + 1e-5f && whole.Min.Z <= union.Min.Z + 1e-5f);
            Assert.True(whole.Max.X >= union.Max.X - 1e-5f && whole.Max.Y >= union.Max.Y - 1e-5f && whole.Max.Z >= union.Max.Z - 1e-5f);
            var farthest = Math.Max(Math.Max(union.Max.X, -union.Min.X), Math.Max(union.Max.Y, -union.Min.Y));
            Assert.InRange(farthest, 0, radius * 1.00001f);
        }
    }

    struct Hits : IShapeRayHitHandler
    {
        public List<(int Piece, float T, Vector3 Normal)> All;
        public HashSet<int> Asked;
        public int Forbidden;
        public bool OnlyNearest;

        public readonly bool AllowTest(int childIndex)
        {
            Asked?.Add(childIndex);
            return childIndex != Forbidden;
        }

        public readonly void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, int childIndex)
        {
            All.Add((childIndex, t, normal));
            if (OnlyNearest)
                maximumT = t;
        }
    }

    /// <summary>Piece by piece, each a shape of its own where it lies in the world.</summary>
    [Theory, InlineData(false), InlineData(true)]
    public void Rays_hit_the_pieces_that_they_hit_alone(bool isBig)
    {
        var name = workshop.AddNested(isBig);
        var pieces = workshop.PiecesOf(name);
        int hitCount = 0;
        for (int i = 0; i < 150; ++i)
        {
            var pose = new RigidPose(workshop.NextVector(5), workshop.NextTurn());
            var start = workshop.NextVector(4);
            var ray = new RayData { Origin = pose.Position + start, Direction = workshop.NextVector(.5f) - start * .4f, Id = i };
            var expected = new Hits { All = [], Forbidden = -1 };
            foreach (var piece in pieces)
            {
                var place = piece.Place(pose.Orientation);
                place.Position += pose.Position;
                var one = new Hits { All = [], Forbidden = -1 };
                var whole = 8f;
                Shapes.GetBatch(piece.Shape.Type).RayTest(piece.Shape.Index, place, ray, ref whole, workshop.Pool, ref one);
                expected.All.AddRange(one.All.Select(hit => (piece.Number, hit.T, hit.Normal)));
            }
            var order = expected.All.OrderBy(hit => hit.Piece).ToArray();
            var all = new Hits { All = [], Asked = [], Forbidden = i % 2 == 1 && order.Length > 0 ? order[0].Piece : -1 };
            var maximumT = 8f;
            Shapes.GetBatch(name.Type).RayTest(name.Index, pose, ray, ref maximumT, workshop.Pool, ref all);
            var actual = all.All.OrderBy(hit => hit.Piece).ToArray();
            order = [.. order.Where(hit => hit.Piece != all.Forbidden)];
            Assert.Equal(order.Select(hit => hit.Piece), actual.Select(hit => hit.Piece));
            Assert.All(order, hit => Assert.Contains(hit.Piece, all.Asked));
            for (int j = 0; j < order.Length; ++j)
            {
                Assert.Equal(order[j].T, actual[j].T, 1e-5f);
                Assert.InRange((order[j].Normal - actual[j].Normal).Length(), 0, 1e-4f);
            }
            var nearest = new Hits { All = [], Forbidden = all.Forbidden, OnlyNearest = true };
            Shapes.GetBatch(name.Type).RayTest(name.Index, pose, ray, ref maximumT, workshop.Pool, ref nearest);
            if (order.Length > 0)
                Assert.Equal(order.Min(hit => hit.T), nearest.All[^1].T, 1e-5f);
            hitCount += order.Length;
        }
        Assert.InRange(hitCount, 40, int.MaxValue);
    }

    [Fact]
    public void What_children_are_made_of_is_removed_with_them_unless_something_else_uses_it()
    {
        var mesh = AddBoxMesh(Vector3.One);
        var sphere = Shapes.Add(new Sphere(1));
        var inner = workshop.Add(Children(sphere, sphere), isBig: true);
        var other = workshop.Add(Children(inner), isBig: false);
        // The sphere is a child of both, and of a child.
        var outer = workshop.Add(Children(mesh, inner, sphere, inner), isBig: false);
        foreach (var name in (TypedIndex[])[mesh, inner, sphere])
            Assert.Throws<InvalidOperationException>(() => Shapes.RemoveAndDispose(name, workshop.Pool));
        for (int i = 0; i < 2; ++i)
            Assert.Throws<InvalidOperationException>(() => Shapes.RecursivelyRemoveAndDispose(outer, workshop.Pool));
        foreach (var name in (TypedIndex[])[mesh, inner, sphere, outer, other])
            Assert.True(Shapes.Exists(name));
        Shapes.RemoveAndDispose(other, workshop.Pool);
        // Deep inside, a body has it.
        Shapes.BeginUse(sphere);
        Assert.Throws<InvalidOperationException>(() => Shapes.RecursivelyRemoveAndDispose(outer, workshop.Pool));
        Shapes.EndUse(sphere);
        Assert.Throws<InvalidOperationException>(() => Shapes.Remove(inner));
        Assert.Throws<InvalidOperationException>(() => Shapes.Remove(sphere));
        Shapes.RecursivelyRemoveAndDispose(outer, workshop.Pool);
        foreach (var name in (TypedIndex[])[mesh, inner, sphere, outer])
            Assert.False(Shapes.Exists(name));
    }

    [Fact]
    public void A_compound_with_ground_in_it_is_for_statics()
    {
        using var world = new CompoundWorld();
        var shapes = world.Simulation.Shapes;
        world.Pool.Take(1, out Buffer<CompoundChild> children);
        children[0] = new(RigidPose.Identity, shapes.Add(new HeightField(3, 3, 1, 1, new float[9], world.Pool)));
        var name = shapes.Add(new Compound(children));
        var thrown = Assert.Throws<ArgumentException>(() => world.Simulation.Bodies.Add(BodyDescription.CreateKinematic(RigidPose.Identity, name, -1f)));
        Assert.Contains("statics", thrown.Message, StringComparison.Ordinal);
        world.Simulation.Statics.Add(new StaticDescription(RigidPose.Identity, name));
    }

    [Fact]
    public void A_child_has_no_more_pieces_than_there_are_numbers_for()
    {
        var mesh = AddBoxMesh(Vector3.One);
        var child = new CompoundChild(RigidPose.Identity, mesh);
        // Of 2^31 - 1 numbers each of n children has a share of (2^31 - 1 - n) / n: twelve up to 165,191,049 children.
        CompoundChildren.CheckShape(child, 3, Shapes, 165_191_049);
        var thrown = Assert.Throws<ArgumentException>(() => CompoundChildren.CheckShape(child, 3, Shapes, 165_191_050));
        Assert.Contains("up to 11", thrown.Message, StringComparison.Ordinal);
    }

    /// <summary>Two halves of a box, one of them a mesh about a point far from its middle, are a box.</summary>
    [Theory, InlineData(false), InlineData(true)]
    public void A_closed_mesh_is_what_it_encloses(bool isBig)
    {
        var offset = new Vector3(3, -2, 5);
        var turn = Quaternion.CreateFromAxisAngle(Vector3.Normalize(new(1, 2, 3)), 1);
        var mesh = AddBoxMesh(new(.5f, 1, 1.5f), offset);
        var box = Shapes.Add(new Box(1, 2, 3));
        workshop.Pool.Take(2, out Buffer<CompoundChild> children);
        children[0] = new(new RigidPose(new Vector3(9.5f, 4, 0)), box);
        children[1] = new(new RigidPose(new Vector3(10.5f, 4, 0) - offset), mesh);
        var expected = new Box(2, 2, 3).ComputeInertia(12);
        var whole = workshop.Add(children, isBig);
        var inertia = isBig
            ? Shapes.GetShape<BigCompound>(whole.Index).ComputeInertia([6f, 6], Shapes, out var center)
            : Shapes.GetShape<Compound>(whole.Index).ComputeInertia([6f, 6], Shapes, out center);
        Assert.InRange((center - new Vector3(10, 4, 0)).Length(), 0, 1e-5f);
        Assert.InRange((children[1].LocalPosition - new Vector3(.5f, 0, 0) + offset).Length(), 0, 1e-5f);
        AssertClose(expected.InverseInertiaTensor, inertia.InverseInertiaTensor);
        Assert.Equal(expected.InverseMass, inertia.InverseMass, 1e-7f);
        // Around the origin, which is the middle now, and as part of something that is turned.
        var again = CompoundBuilder.ComputeInertia(CompoundChildren.Span(children), [6f, 6], Shapes);
        AssertClose(expected.InverseInertiaTensor, again.InverseInertiaTensor);
        var single = new CompoundChild[] { new(new RigidPose(new Vector3(1, 2, 3), turn), mesh) };
        var turned = CompoundBuilder.ComputeInertia(single, [6f], Shapes, out center);
        Assert.InRange((center - new Vector3(1, 2, 3) - Vector3.Transform(offset, turn)).Length(), 0, 1e-5f);
        var symmetric = new Box(1, 2, 3).ComputeInertia(6).InverseInertiaTensor;
        for (int i = 0; i < 3; ++i)
        {
            var axis = i == 0 ? Vector3.UnitX : i == 1 ? Vector3.UnitY : Vector3.UnitZ;
            var along = Vector3.Transform(axis, turn);
            var moment = i == 0 ? symmetric.XX : i == 1 ? symmetric.YY : symmetric.ZZ;
            Assert.InRange((turned.InverseInertiaTensor * along - along * moment).Length() / moment, 0, 2e-5f);
        }
    }

    static void AssertClose(in Symmetric3x3 expected, in Symmetric3x3 actual)
    {
        var error = expected - actual;
        var sum = Math.Abs(error.XX) + Math.Abs(error.YX) + Math.Abs(error.YY) + Math.Abs(error.ZX) + Math.Abs(error.ZY) + Math.Abs(error.ZZ);
        Assert.InRange(sum / (expected.XX + expected.YY + expected.ZZ), 0, 1e-5f);
    }

    [Fact]
    public void What_has_no_inertia_of_its_own_is_refused_and_says_what_to_do()
    {
        var open = Shapes.Add(new Mesh((ReadOnlySpan<Triangle>)[new(default, Vector3.UnitX, Vector3.UnitZ)], Vector3.One, workshop.Pool));
        var field = Shapes.Add(new HeightField(3, 3, 1, 1, new float[9], workshop.Pool));
        var compound = workshop.AddCompound(2, 1, isBig: false);
        foreach (var (name, word) in ((TypedIndex, string)[])[(open, "ComputeOpenInertia"), (field, "Add"), (compound, "Add")])
        {
            var child = new CompoundChild(new RigidPose(Vector3.One), name);
            var thrown = Assert.Throws<ArgumentException>(() => CompoundBuilder.ComputeInertia([child], [1f], Shapes));
            Assert.Contains(word, thrown.Message, StringComparison.Ordinal);
            Assert.Contains("Child 0", thrown.Message, StringComparison.Ordinal);
            using var builder = new CompoundBuilder(workshop.Pool, Shapes, 1);
            builder.Add(name, RigidPose.Identity, new Box(1, 1, 1).ComputeInertia(2));
            builder.BuildDynamicCompound(out var children, out var inertia, out _);
            Assert.Equal(new Box(1, 1, 1).ComputeInertia(2).InverseMass, inertia.InverseMass, 1e-6f);
            workshop.Pool.Return(ref children);
        }
    }
}
