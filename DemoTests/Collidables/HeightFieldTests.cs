using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Collidables;

/// <summary>The triangles of height fields: which there are, which a box and a ray meet, after edits too; and what is refused.</summary>
public sealed unsafe class HeightFieldTests : IDisposable
{
    readonly BufferPool pool = new();
    readonly List<HeightField> fields = [];
    readonly Random random = new(LevelSeeds.Of(12));

    public void Dispose()
    {
        foreach (var field in fields)
            field.Dispose(pool);
        pool.AssertEmpty();
        pool.Dispose();
    }

    public static TheoryData<int, int> Sizes => new() { { 2, 2 }, { 2, 9 }, { 9, 9 }, { 10, 3 }, { 18, 17 }, { 40, 70 }, { 131, 66 } };

    HeightField Create(int countX, int countZ, bool withCells = true)
    {
        var heights = Enumerable.Range(0, countX * countZ).Select(_ => Next(-1, 1)).ToArray();
        var cells = Enumerable.Range(0, (countX - 1) * (countZ - 1))
            .Select(_ => new HeightFieldCell(random.Next(64), countX > 2 && random.Next(10) == 0, random.Next(2) == 0)).ToArray();
        var field = new HeightField(countX, countZ, .7f, 1.3f, heights, pool, withCells ? cells : default);
        fields.Add(field);
        return field;
    }

    float Next(double min, double max) => (float)(min + (max - min) * random.NextDouble());

    static List<int> Children(HeightField field)
    {
        var children = new List<int>();
        for (int i = 0; i < field.ChildCount; ++i)
        {
            if (!field.GetCell(i / 2 % field.CellCountX, i / 2 / field.CellCountX).IsHole)
                children.Add(i);
        }
        return children;
    }

    static (Vector3 Min, Vector3 Max) Bounds(HeightField field, int child)
    {
        field.GetLocalChild(child, out var t);
        return (Vector3.Min(t.A, Vector3.Min(t.B, t.C)), Vector3.Max(t.A, Vector3.Max(t.B, t.C)));
    }

    [Theory]
    [MemberData(nameof(Sizes))]
    public void Triangles_cover_their_cells_and_look_up(int countX, int countZ)
    {
        var field = Create(countX, countZ);
        for (int i = 0; i < field.ChildCount; ++i)
        {
            field.GetLocalChild(i, out var t);
            t.Validate();
            var normal = Vector3.Cross(t.C - t.A, t.B - t.A);
            // Twice the area seen from above is that of the cell.
            Assert.Equal(.7f * 1.3f, normal.Y, 1e-4f);
            int x = i / 2 % field.CellCountX, z = i / 2 / field.CellCountX;
            var rising = field.GetCell(x, z).HasRisingDiagonal;
            Vector3 diagonal0 = Sample(field, rising ? x : x + 1, z), diagonal1 = Sample(field, rising ? x + 1 : x, z + 1);
            Vector3[] corners = [t.A, t.B, t.C];
            Assert.Contains(diagonal0, corners);
            Assert.Contains(diagonal1, corners);
            var third = corners.Single(corner => corner != diagonal0 && corner != diagonal1);
            Assert.Equal(i % 2 == 0, third == Sample(field, rising ? x + 1 : x, z));
        }
    }

    static Vector3 Sample(HeightField field, int x, int z) => new(x * field.CellWidth, field.GetHeight(x, z), z * field.CellLength);

    [Theory]
    [MemberData(nameof(Sizes))]
    public void A_box_finds_the_triangles_whose_boxes_it_meets(int countX, int countZ)
    {
        var field = Create(countX, countZ);
        CheckBoxes(field);
    }

    void CheckBoxes(HeightField field)
    {
        var children = Children(field);
        var all = children.Select(child => Bounds(field, child)).ToArray();
        var found = new QuickList<int>(4, pool);
        var size = new Vector3(field.CellCountX * field.CellWidth, 2, field.CellCountZ * field.CellLength);
        for (int i = 0; i < 300; ++i)
        {
            var center = new Vector3(Next(-.2, 1.2) * size.X, Next(-1.2, 1.2), Next(-.2, 1.2) * size.Z);
            // Some touch borders of cells exactly, some are everything.
            if (i % 3 == 0)
                center = new(random.Next(field.SampleCountX) * field.CellWidth, 0, random.Next(field.SampleCountZ) * field.CellLength);
            var half = i % 7 == 0 ? new Vector3(1e6f) : i % 3 == 0 ? new(0, 2, 0) : new Vector3(Next(0, 2), Next(0, 1), Next(0, 2));
            found.Count = 0;
            ((IContainer)field).FindOverlaps(center - half, center + half, default, null!, null, ref found, pool);
            Vector3 min = center - half, max = center + half;
            var expected = children.Where((_, j) => Meets(all[j], min, max)).ToArray();
            // A triangle has half a cell, and is found with the whole of it.
            Assert.Equal(expected, found.AsSpan().ToArray());
        }
        found.Dispose(pool);
    }

    static bool Meets((Vector3 Min, Vector3 Max) box, Vector3 min, Vector3 max) =>
        min.X <= box.Max.X && max.X >= box.Min.X && min.Y <= box.Max.Y && max.Y >= box.Min.Y && min.Z <= box.Max.Z && max.Z >= box.Min.Z;

    [Theory]
    [MemberData(nameof(Sizes))]
    public void Its_nodes_hold_each_triangle_once(int countX, int countZ)
    {
        var field = Create(countX, countZ);
        var container = (IContainer)field;
        pool.Take<NodeChild>(container.FanOut(0, null!), out var below);
        var seen = new List<int>();
        var open = new Queue<NodeChild>();
        open.Enqueue(new NodeChild { Min = new(float.MinValue), Max = new(float.MaxValue) });
        while (open.TryDequeue(out var node))
        {
            var count = container.Open(node.Index, null!, below.Memory);
            Assert.InRange(count, 0, container.FanOut(0, null!));
            for (int i = 0; i < count; ++i)
            {
                Assert.Equal(Vector3.Max(node.Min, below[i].Min), below[i].Min);
                Assert.Equal(Vector3.Min(node.Max, below[i].Max), below[i].Max);
                if (below[i].Index >= 0)
                {
                    open.Enqueue(below[i]);
                    continue;
                }
                seen.Add(~below[i].Index);
                Assert.Equal(Bounds(field, ~below[i].Index), (below[i].Min, below[i].Max));
            }
        }
        pool.Return(ref below);
        seen.Sort();
        Assert.Equal(Children(field), seen);
    }

    struct Nearest : IShapeRayHitHandler
    {
        public float T;
        public Vector3 Normal;
        public int Child, Refused;

        public readonly bool AllowTest(int childIndex) => childIndex != Refused;

        public void OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, int childIndex)
        {
            if (t < T)
                (T, Normal, Child) = (t, normal, childIndex);
            maximumT = MathF.Min(maximumT, t);
        }
    }

    static Nearest Cast(HeightField field, RigidPose pose, Vector3 origin, Vector3 direction, BufferPool pool, int refused = -1)
    {
        var handler = new Nearest { T = float.MaxValue, Child = -1, Refused = refused };
        var maximumT = 1e6f;
        field.RayTest(pose, new RayData { Origin = origin, Direction = direction }, ref maximumT, pool, ref handler);
        return handler;
    }

    [Theory]
    [MemberData(nameof(Sizes))]
    public void Rays_meet_the_nearest_triangle(int countX, int countZ)
    {
        var field = Create(countX, countZ);
        CheckRays(field);
    }

    void CheckRays(HeightField field)
    {
        var children = Children(field);
        var pose = new RigidPose(new(3, -2, 5), Quaternion.Normalize(new(.3f, .2f, -.1f, .8f)));
        var size = new Vector3(field.CellCountX * field.CellWidth, 1, field.CellCountZ * field.CellLength);
        int hits = 0;
        for (int i = 0; i < 400; ++i)
        {
            var from = new Vector3(Next(-.3, 1.3) * size.X, Next(-2, 3), Next(-.3, 1.3) * size.Z);
            var to = new Vector3(Next(0, 1) * size.X, Next(-1, 1), Next(0, 1) * size.Z);
            var origin = pose.Position + Vector3.Transform(from, pose.Orientation);
            var direction = Vector3.Transform(to - from, pose.Orientation) * (i % 2 == 0 ? 1 : .01f);
            var (t, nearest) = (float.MaxValue, -1);
            foreach (var child in children)
            {
                field.GetLocalChild(child, out var triangle);
                if (triangle.RayTest(pose, origin, direction, out var place, out _) && place < t)
                    (t, nearest) = (place, child);
            }
            var found = Cast(field, pose, origin, direction, pool);
            Assert.Equal(t, found.T);
            hits += nearest >= 0 ? 1 : 0;
            if (nearest < 0)
                continue;
            // Another may be as near, on an edge.
            field.GetLocalChild(found.Child, out var hit);
            Assert.True(hit.RayTest(pose, origin, direction, out _, out var normal));
            Assert.Equal(normal, found.Normal);
            Assert.NotEqual(found.Child, Cast(field, pose, origin, direction, pool, refused: found.Child).Child);
        }
        Assert.True(hits > 40, $"{hits} of 400 hit");
    }

    [Fact]
    public void No_ray_from_above_slips_through()
    {
        var field = Create(30, 20, withCells: false);
        for (int i = 0; i < 20_000; ++i)
        {
            var place = new Vector3(Next(0, 1) * 29 * .7f, 0, Next(0, 1) * 19 * 1.3f);
            // Through samples, along lines between them, and along diagonals.
            if (i % 4 == 1)
                place = new(random.Next(1, 29) * .7f, 0, random.Next(1, 19) * 1.3f);
            else if (i % 4 == 2)
                place.X = random.Next(1, 29) * .7f;
            else if (i % 4 == 3)
                place = Vector3.Lerp(new(12 * .7f, 0, 7 * 1.3f), new(11 * .7f, 0, 8 * 1.3f), Next(0, 1));
            var tilt = i % 2 == 0 ? default : new Vector3(Next(-1, 1), 0, Next(-1, 1)) * .3f;
            place.Y = 0;
            var hit = Cast(field, RigidPose.Identity, place + new Vector3(0, 5, 0) - 5 * tilt, new Vector3(0, -1, 0) + tilt, pool);
            // A tilted ray near the border may leave the field.
            var isInner = place.X is > 1 and < 19 && place.Z is > 1 and < 23;
            Assert.True(hit.Child >= 0 || (tilt != default && !isInner), $"{place}, tilt {tilt}");
        }
    }

    [Fact]
    public void From_below_nothing_is_met()
    {
        var field = Create(9, 9, withCells: false);
        Assert.Equal(-1, Cast(field, RigidPose.Identity, new(2, -10, 3), Vector3.UnitY, pool).Child);
        Assert.NotEqual(-1, Cast(field, RigidPose.Identity, new(2, 10, 3), -Vector3.UnitY, pool).Child);
    }

    [Fact]
    public void Edits_give_what_a_new_field_would_be()
    {
        var field = Create(45, 33, withCells: false);
        for (int i = 0; i < 20; ++i)
        {
            int x = random.Next(45), z = random.Next(33), countX = random.Next(1, 46 - x), countZ = random.Next(1, 34 - z);
            var height = i % 2 * 3;
            field.SetHeights(x, z, countX, countZ, [.. Enumerable.Range(0, countX * countZ).Select(_ => height + Next(-1, 1))]);
        }
        CheckBoxes(field);
        CheckRays(field);
        field.ComputeBounds(Quaternion.Identity, out var min, out var max);
        var heights = Enumerable.Range(0, 45 * 33).Select(i => field.GetHeight(i % 45, i / 45)).ToArray();
        Assert.Equal(heights.Min(), min.Y, 1e-6f);
        Assert.Equal(heights.Max(), max.Y, 1e-6f);
    }

    [Fact]
    public void Cells_can_be_changed()
    {
        var field = Create(9, 9);
        field.SetCell(3, 5, new(17, isHole: true, risingDiagonal: true));
        var cell = field.GetCell(3, 5);
        Assert.Equal((17, true, true), (cell.Material, cell.IsHole, cell.HasRisingDiagonal));
        Assert.DoesNotContain(2 * (5 * 8 + 3), Children(field));
        CheckBoxes(field);
        var plain = Create(3, 3, withCells: false);
        Assert.Throws<InvalidOperationException>(() => plain.SetCell(0, 0, default));
    }

    /// <summary>A mesh of the same triangles knows its neighbours by corners that are the same, and keeps their angles in a byte.</summary>
    [Theory]
    [MemberData(nameof(Sizes))]
    public void Its_edges_bend_as_those_of_a_mesh(int countX, int countZ)
    {
        var field = Create(countX, countZ);
        var children = Children(field);
        pool.Take<Triangle>(children.Count, out var triangles);
        for (int i = 0; i < children.Count; ++i)
            field.GetLocalChild(children[i], out triangles[i]);
        var mesh = new Mesh(triangles, Vector3.One, pool);
        var scratch = stackalloc byte[IContainer.ScratchByteCount];
        for (int i = 0; i < children.Count; ++i)
        {
            mesh.GetCone(i, out var expected);
            ((IContainer)field).GetChild(children[i], null!, scratch, out var child);
            Assert.Equal(expected.FreeMask, child.Cone.FreeMask);
            for (int edge = 0; edge < 3; ++edge)
            {
                double angle = Math.Atan2(child.Cone.Sines[edge], child.Cone.Cosines[edge]);
                double least = Math.Atan2(expected.Sines[edge], expected.Cosines[edge]);
                // The step of a byte is 2 pi q / 254^2, with q = 254 sqrt(angle / pi); the last is at a right angle.
                Assert.InRange(angle, least - 1e-5, least + 2 * Math.Sqrt(angle * Math.PI) / 254 + 1e-4);
            }
        }
        mesh.Dispose(pool);
    }

    [Fact]
    public void A_turned_field_is_in_its_box()
    {
        var field = Create(20, 30);
        var orientation = Quaternion.Normalize(new(.3f, .2f, -.1f, .8f));
        field.ComputeBounds(orientation, out var min, out var max);
        foreach (var child in Children(field))
        {
            field.GetLocalChild(child, out var t);
            foreach (var corner in (ReadOnlySpan<Vector3>)[t.A, t.B, t.C])
            {
                var place = Vector3.Transform(corner, orientation);
                Assert.True(Meets((min - new Vector3(1e-4f), max + new Vector3(1e-4f)), place, place));
            }
        }
    }

    [Fact]
    public void It_takes_little_more_than_its_heights()
    {
        var field = new HeightField(513, 257, 1, 1, new float[513 * 257], pool);
        fields.Add(field);
        Assert.InRange((double)field.ByteCount / field.ChildCount, 2, 2.4);
    }

    [Fact]
    public void Bad_fields_are_refused_by_name_and_take_nothing()
    {
        var nine = new float[9];
        Refuse<ArgumentOutOfRangeException>("sampleCountX", () => new HeightField(1, 9, 1, 1, nine, pool));
        Refuse<ArgumentOutOfRangeException>("sampleCountZ", () => new HeightField(3, int.MinValue, 1, 1, nine, pool));
        Refuse<ArgumentException>("8388609", () => new HeightField(8388610, 5, .01f, .01f, nine, pool));
        foreach (var side in (float[])[0, -1, float.NaN, float.PositiveInfinity, 1e-4f, 1e7f])
        {
            Refuse<ArgumentOutOfRangeException>("cellWidth", () => new HeightField(3, 3, side, 1, nine, pool));
            Refuse<ArgumentOutOfRangeException>("cellLength", () => new HeightField(3, 3, 1, side, nine, pool));
        }
        Refuse<ArgumentException>("factor", () => new HeightField(3, 3, 1, 101, nine, pool));
        Refuse<ArgumentException>("heights", () => new HeightField(3, 3, 1, 1, new float[8], pool));
        Refuse<ArgumentException>("cells", () => new HeightField(3, 3, 1, 1, nine, pool, new HeightFieldCell[3]));
        foreach (var height in (float[])[float.NaN, float.PositiveInfinity, -2e7f])
        {
            nine[5] = height;
            Refuse<ArgumentOutOfRangeException>("(2, 1)", () => new HeightField(3, 3, 1, 1, nine, pool));
        }
        nine[5] = 201;
        Refuse<ArgumentException>("cell (1, 0)", () => new HeightField(3, 3, 1, 1, nine, pool));
        Refuse<ArgumentNullException>("pool", () => new HeightField(3, 3, 1, 1, nine, null!));
        pool.AssertEmpty();

        var field = Create(5, 5, withCells: false);
        var before = Enumerable.Range(0, 25).Select(i => field.GetHeight(i % 5, i / 5)).ToArray();
        Refuse<ArgumentOutOfRangeException>("x", () => field.SetHeights(4, 0, 2, 1, [1, 1]));
        Refuse<ArgumentOutOfRangeException>("z", () => field.SetHeights(0, -1, 2, 1, [1, 1]));
        Refuse<ArgumentException>("heights", () => field.SetHeights(0, 0, 2, 1, [1]));
        Refuse<ArgumentOutOfRangeException>("(1, 4)", () => field.SetHeights(0, 4, 2, 1, [1, float.NaN]));
        Refuse<ArgumentException>("cell (2, 2)", () => field.SetHeights(3, 3, 1, 1, [250]));
        Refuse<ArgumentOutOfRangeException>("x", () => field.GetHeight(5, 0));
        Refuse<ArgumentOutOfRangeException>("z", () => field.GetCell(0, 4));
        Refuse<ArgumentOutOfRangeException>("childIndex", () => field.GetLocalChild(32, out _));
        Assert.Equal(before, Enumerable.Range(0, 25).Select(i => field.GetHeight(i % 5, i / 5)));
        var shapes = new Shapes(pool, 1);
        Assert.Throws<ArgumentException>(() => shapes.Add(default(HeightField)));
        shapes.Dispose();
    }

    static void Refuse<TException>(string word, Func<HeightField> create) where TException : Exception =>
        Refuse<TException>(word, () => { create(); });

    static void Refuse<TException>(string word, Action action) where TException : Exception =>
        Assert.Contains(word, Assert.Throws<TException>(action).Message, StringComparison.Ordinal);

    [Fact]
    public void Bodies_rest_on_it_and_fall_through_its_holes()
    {
        var cells = new HeightFieldCell[400];
        for (int z = 8; z < 12; ++z)
        {
            for (int x = 8; x < 12; ++x)
                cells[z * 20 + x] = new(0, isHole: true);
        }
        var field = new HeightField(21, 21, 1, 1, new float[441], pool, cells);
        var simulation = Simulation.Create(pool, new DefaultNarrowPhaseCallbacks(), new DefaultPoseIntegratorCallbacks(), new SolveDescription(1, 4));
        simulation.Statics.Add(new StaticDescription(new Vector3(-10, 0, -10), simulation.Shapes.Add(field)));
        var box = new Box(1, 1, 1);
        var shape = simulation.Shapes.Add(box);
        var resting = Add(new(-5.3f, .6f, 4.2f));
        var falling = Add(new(0, .6f, 0));
        for (int i = 0; i < 240; ++i)
            simulation.Timestep(1 / 60f);
        Assert.InRange(simulation.Bodies[resting].Pose.Position.Y, .499f, .5001f);
        Assert.InRange(simulation.Bodies[resting].Velocity.Linear.Length(), 0, 1e-3f);
        Assert.InRange(simulation.Bodies[falling].Pose.Position.Y, float.MinValue, -50);
        Assert.Throws<ArgumentException>(() => simulation.Bodies.Add(
            BodyDescription.CreateKinematic(RigidPose.Identity, simulation.Statics[new StaticHandle(0)].Shape, .01f)));
        simulation.Dispose();
        field.Dispose(pool);

        BodyHandle Add(Vector3 position) =>
            simulation.Bodies.Add(BodyDescription.CreateDynamic(position, box.ComputeInertia(1), shape, -1));
    }
}
