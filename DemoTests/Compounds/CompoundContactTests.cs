using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Xunit;

namespace DemoTests.Compounds;

/// <summary>The contacts of a compound are those of its children, bit for bit, each as if alone.</summary>
public class CompoundContactTests
{
    const float Margin = .1f;

    readonly struct Callbacks(Dictionary<(int Pair, int A, int B), ConvexContactManifold> found) : ICollisionCallbacks
    {
        public bool AllowCollisionTesting(int pairId, int childA, int childB) => true;

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) =>
            found.Add((pairId, childA, childB), manifold);

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> =>
            found.Add((pairId, -1, -1), manifold is ConvexContactManifold convex ? convex : default);
    }

    static string Describe(in ConvexContactManifold manifold)
    {
        var copy = manifold;
        var text = $"{copy.Count} {Bits(copy.Normal)}";
        for (int i = 0; i < copy.Count; ++i)
        {
            var contact = ConvexContactManifold.GetConvexContactReference(ref copy, i);
            text += $" {Bits(contact.Offset)} {BitConverter.SingleToInt32Bits(contact.Depth)} {contact.FeatureId}";
        }
        return text;
    }

    // Zeros of either sign are the same place.
    static string Bits(Vector3 v) =>
        string.Join(",", MemoryMarshal.Cast<Vector3, int>(new ReadOnlySpan<Vector3>(ref v)).ToArray().Select(i => i == int.MinValue ? 0 : i));

    static void Compare(CompoundWorkshop workshop, TypedIndex a, TypedIndex b, float spread, bool isTurned, int count, BodyVelocity velocityB = default)
    {
        var registry = DefaultTypes.CreateDefaultCollisionTaskRegistry();
        var found = new Dictionary<(int, int, int), ConvexContactManifold>();
        var batcher = new CollisionBatcher<Callbacks>(workshop.Pool, workshop.Shapes, registry, 1 / 60f, new(found));
        var alone = new Dictionary<(int, int, int), ConvexContactManifold>();
        var tester = new CollisionBatcher<Callbacks>(workshop.Pool, workshop.Shapes, registry, 1 / 60f, new(alone));
        var expected = new List<(int Pair, int A, int B, Vector3 OffsetA)>();
        var (childrenA, childrenB) = (workshop.PiecesOf(a), workshop.PiecesOf(b));
        for (int pair = 0; pair < count; ++pair)
        {
            var offset = workshop.NextVector(spread);
            var turnA = isTurned ? workshop.NextTurn() : Quaternion.Identity;
            var turnB = isTurned ? workshop.NextTurn() : Quaternion.Identity;
            batcher.Add(a, b, offset, turnA, turnB, default, velocityB, Margin, 1, new(pair));
            foreach (var pieceA in childrenA)
            {
                foreach (var pieceB in childrenB)
                {
                    var placeA = CompoundWorkshop.IsContainer(a) ? pieceA.Place(turnA) : new(default, turnA);
                    var placeB = CompoundWorkshop.IsContainer(b) ? pieceB.Place(turnB) : new(default, turnB);
                    tester.Add(pieceA.Shape, pieceB.Shape, offset + placeB.Position - placeA.Position, placeA.Orientation,
                        placeB.Orientation, Margin, new(expected.Count));
                    expected.Add((pair, pieceA.Number, pieceB.Number, placeA.Position));
                }
            }
        }
        batcher.Flush();
        tester.Flush();
        int touching = 0;
        for (int i = 0; i < expected.Count; ++i)
        {
            var manifold = alone[(i, -1, -1)];
            var key = (expected[i].Pair, expected[i].A, expected[i].B);
            for (int j = 0; j < manifold.Count; ++j)
                ConvexContactManifold.GetConvexContactReference(ref manifold, j).Offset += expected[i].OffsetA;
            if (manifold.Count > 0)
            {
                ++touching;
                Assert.True(found.ContainsKey(key), $"{key} has contacts and was not found");
            }
            if (found.TryGetValue(key, out var actual))
                Assert.Equal(manifold.Count == 0 ? "0" : Describe(manifold), actual.Count == 0 ? "0" : Describe(actual));
        }
        Assert.InRange(touching, count / 20, int.MaxValue);
        var foundChildren = found.Keys.Count(key => key.Item2 >= 0);
        // A box is wider than what is in it; but not all children are near, unless to what has no end.
        if (a.Type != HalfSpace.Id && b.Type != HalfSpace.Id && childrenA.Count * childrenB.Count > 8)
            Assert.InRange(foundChildren, touching, expected.Count / 2);
    }

    public static TheoryData<int, bool, bool> ConvexAndCompound()
    {
        var data = new TheoryData<int, bool, bool>();
        foreach (var type in CompoundWorkshop.ConvexTypes)
        {
            foreach (var isBig in (bool[])[false, true])
            {
                data.Add(type, isBig, false);
                data.Add(type, isBig, true);
            }
        }
        return data;
    }

    [Theory, MemberData(nameof(ConvexAndCompound))]
    public void A_convex_shape_meets_each_child_as_if_alone(int type, bool isBig, bool compoundIsA)
    {
        using var workshop = new CompoundWorkshop(type * 4 + (isBig ? 2 : 0) + (compoundIsA ? 1 : 0));
        foreach (var isTurned in (bool[])[false, true])
        {
            var shape = workshop.AddShape(type);
            var compound = workshop.AddCompound(24, 3, isBig);
            Compare(workshop, compoundIsA ? compound : shape, compoundIsA ? shape : compound, 3, isTurned, 100);
        }
    }

    [Theory]
    [InlineData(Compound.Id, false), InlineData(Compound.Id, true), InlineData(BigCompound.Id, false), InlineData(BigCompound.Id, true)]
    [InlineData(Mesh.Id, false), InlineData(Mesh.Id, true)]
    public void What_is_made_of_children_meets_the_ground_child_by_child_as_if_alone(int type, bool groundIsA)
    {
        using var workshop = new CompoundWorkshop(type * 2 + (groundIsA ? 1 : 0));
        foreach (var isTurned in (bool[])[false, true])
        {
            var shape = type == Mesh.Id ? workshop.AddMesh() : workshop.AddCompound(12, 1, type == BigCompound.Id);
            var plane = workshop.Shapes.Add(new HalfSpace(workshop.NextVector(1)));
            var hills = workshop.AddHills();
            Compare(workshop, groundIsA ? plane : shape, groundIsA ? shape : plane, 2, isTurned, 100);
            // Of two with many triangles all are compared with all.
            Compare(workshop, groundIsA ? hills : shape, groundIsA ? shape : hills, 4, isTurned, type == Mesh.Id ? 12 : 40);
        }
    }

    [Theory]
    [InlineData(false, false, 5, 7)]
    [InlineData(false, true, 3, 30)]
    [InlineData(true, false, 30, 3)]
    [InlineData(true, true, 1, 40)]
    [InlineData(true, true, 40, 2)]
    [InlineData(true, true, 30, 30)]
    public void Compounds_meet_child_by_child_as_if_alone(bool isBigA, bool isBigB, int countA, int countB)
    {
        using var workshop = new CompoundWorkshop(countA * 100 + countB);
        foreach (var isTurned in (bool[])[false, true])
        {
            var a = workshop.AddCompound(countA, countA < 4 ? .3f : 3, isBigA, 1);
            var b = workshop.AddCompound(countB, countB < 4 ? .3f : 3, isBigB, 2);
            Compare(workshop, a, b, 3, isTurned, 40);
        }
    }

    [Theory, MemberData(nameof(ConvexAndCompound))]
    public void A_convex_shape_meets_each_piece_of_children_as_if_alone(int type, bool isBig, bool compoundIsA)
    {
        using var workshop = new CompoundWorkshop(type * 4 + (isBig ? 2 : 0) + (compoundIsA ? 1 : 0));
        foreach (var isTurned in (bool[])[false, true])
        {
            var shape = workshop.AddShape(type);
            var compound = workshop.AddNested(isBig);
            Compare(workshop, compoundIsA ? compound : shape, compoundIsA ? shape : compound, 2, isTurned, 20);
        }
    }

    public enum Partner
    {
        Compound,
        BigCompound,
        Nested,
        Mesh,
        Hills,
        Plane,
    }

    [Theory]
    [InlineData(Partner.Compound), InlineData(Partner.BigCompound), InlineData(Partner.Nested)]
    [InlineData(Partner.Mesh), InlineData(Partner.Hills), InlineData(Partner.Plane)]
    public void What_is_made_of_children_meets_each_piece_of_children_as_if_alone(Partner partner)
    {
        using var workshop = new CompoundWorkshop(50 + (int)partner);
        for (int i = 0; i < 4; ++i)
        {
            var compound = workshop.AddNested(isBig: i % 2 == 0, isForBodies: partner is Partner.Hills or Partner.Plane);
            var other = partner switch
            {
                Partner.Compound => workshop.AddCompound(4, 1, isBig: false),
                Partner.BigCompound => workshop.AddCompound(5, 1, isBig: true, 3),
                Partner.Nested => workshop.AddNested(i < 2, isForBodies: true),
                Partner.Mesh => workshop.AddMesh(),
                Partner.Hills => workshop.AddHills(4, 4),
                _ => workshop.Shapes.Add(new HalfSpace(workshop.NextVector(1))),
            };
            Compare(workshop, i < 2 ? compound : other, i < 2 ? other : compound, 1.5f, isTurned: i > 0, 2);
        }
    }

    [Fact]
    public void A_margin_finds_what_is_beside_the_way_of_a_fast_mover()
    {
        using var workshop = new CompoundWorkshop(3);
        Compare(workshop, workshop.AddShape(Box.Id), workshop.AddCompound(24, 3, isBig: true), 3, isTurned: true, 200,
            new(new Vector3(30, 0, 0), new Vector3(0, 5, 0)));
    }
}
