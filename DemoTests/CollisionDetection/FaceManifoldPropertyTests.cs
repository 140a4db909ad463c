using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using DemoTests.CollisionDetection.References;
using Xunit;
using Xunit.Abstractions;
using Harness = DemoTests.CollisionDetection.FaceHarness<
    DemoTests.CollisionDetection.FaceTestPolygon, DemoTests.CollisionDetection.FaceTestPolygonWide, DemoTests.CollisionDetection.FaceTestFeature,
    DemoTests.CollisionDetection.FaceTestPolygon, DemoTests.CollisionDetection.FaceTestPolygonWide, DemoTests.CollisionDetection.FaceTestFeature>;
using Pair = DemoTests.CollisionDetection.FacePair<DemoTests.CollisionDetection.FaceTestPolygon, DemoTests.CollisionDetection.FaceTestPolygon>;

namespace DemoTests.CollisionDetection;

/// <summary>Random polygons of 2 to 16 vertices against a clipping of polygons in double precision.</summary>
public class FaceManifoldPropertyTests(ITestOutputHelper output)
{
    // Of the smaller polygon; borders are wider by 1e-5 of it, and corners of narrow angles reach farther out.
    const double PlaceTolerance = 5e-5;

    /// <summary>A convex polygon around a centre in a plane, counter-clockwise around the plane's normal.</summary>
    static Vector3[] CreatePolygon(ref PairRandom random, int count, Vector3 center, Vector3 planeNormal, float radius, float narrowness)
    {
        var u = Vector3.Normalize(Vector3.Cross(planeNormal, MathF.Abs(planeNormal.X) < 0.6f ? Vector3.UnitX : Vector3.UnitY));
        var v = Vector3.Cross(planeNormal, u);
        var turn = random.Next(0, Math.Tau);
        var vertices = new Vector3[count];
        for (int i = 0; i < count; ++i)
        {
            // One vertex in each part of the circle, so that all have distances and the middle is inside.
            var angle = (i + random.Next(0, 0.8)) / count * MathF.Tau;
            float x = radius * MathF.Cos(angle), y = radius * narrowness * MathF.Sin(angle);
            vertices[i] = center + u * (x * MathF.Cos(turn) - y * MathF.Sin(turn)) + v * (x * MathF.Sin(turn) + y * MathF.Cos(turn));
        }
        return vertices;
    }

    static Vector3 Tilt(ref PairRandom random, Vector3 direction, double most) =>
        Vector3.Normalize(direction + Vector3.Cross(direction, random.NextDirection()) * random.Next(0, most));

    static List<Double3> VerticesOf(in FaceTestPolygon polygon, Vector3 offset, Quaternion orientation)
    {
        Double3 x = Double3.RotatedAxis(orientation, 0), y = Double3.RotatedAxis(orientation, 1), z = Double3.RotatedAxis(orientation, 2);
        List<Double3> vertices = [];
        for (int i = 0; i < polygon.Count; ++i)
        {
            var v = polygon.Vertices[i];
            vertices.Add(new Double3(offset) + x * v.X + y * v.Y + z * v.Z);
        }
        return vertices;
    }

    static FaceReference Reference(in Pair pair) => new(
        VerticesOf(pair.A, default, Quaternion.Identity), VerticesOf(pair.B, pair.LocalOffsetB, pair.LocalOrientationB), new(pair.Normal));

    static bool TryCreate(ref PairRandom random, double mostTilt, double leastRatio, float margin, bool allowSegments, out Pair pair)
    {
        var least = allowSegments ? 2 : 3;
        var radius = random.NextLogarithmic(1e-2, 1e2);
        var radiusB = radius * random.NextLogarithmic(leastRatio, 1);
        if (random.Next(2) == 0)
            (radius, radiusB) = (radiusB, radius);
        var smaller = Math.Min(radius, radiusB);
        var normal = random.NextDirection();
        var normalA = Tilt(ref random, -normal, mostTilt);
        var normalB = Tilt(ref random, normal, mostTilt);
        var orientationB = random.NextOrientation();
        var toB = Quaternion.Conjugate(orientationB);
        var side = random.NextDirection() * (random.Next(0, 0.7) * (radius + radiusB));
        side -= normal * Vector3.Dot(normal, side);
        var verticesA = CreatePolygon(ref random, least + random.Next(17 - least), random.NextDirection() * radius, normalA, radius,
            random.NextLogarithmic(0.05, 1));
        var middle = verticesA.Aggregate((p, q) => p + q) / verticesA.Length;
        var verticesB = CreatePolygon(ref random, least + random.Next(17 - least), default, normalB, radiusB, random.NextLogarithmic(0.05, 1));
        var a = Finish(verticesA, normalA, -normal);
        var b = Finish(verticesB, normalB, normal);
        for (int i = 0; i < FaceTestPolygon.MaximumCount; ++i)
            b.Vertices[i] = Vector3.Transform(b.Vertices[i], toB);
        b.PlaneNormal = Vector3.Transform(b.PlaneNormal, toB);
        pair = new(a, b, middle + side, orientationB, random.NextOrientation(), normal, 0, default, margin);

        // Moved along the normal to be as deep as wanted, then looked at once more, as it is after rounding.
        var reference = Reference(pair);
        if (reference.Corners.Count == 0)
            return false;
        var wanted = smaller * random.Next(-0.01, 0.05);
        pair.LocalOffsetB += normal * (float)(wanted - reference.FindDeepest().Depth);
        reference = Reference(pair);
        if (reference.Corners.Count == 0)
            return false;
        var (depth, point) = reference.FindDeepest();
        pair.Depth = (float)depth;
        pair.PointOnA = new((float)point.X, (float)point.Y, (float)point.Z);
        return true;

        static FaceTestPolygon Finish(Vector3[] vertices, Vector3 planeNormal, Vector3 outwards)
        {
            if (vertices.Length == 2)
            {
                var along = Vector3.Normalize(vertices[1] - vertices[0]);
                planeNormal = outwards - along * Vector3.Dot(along, outwards);
            }
            return new(vertices, planeNormal);
        }
    }

    static List<Pair> CreateMany(ulong seed, int count, double mostTilt, double leastRatio, float margin, bool allowSegments = false)
    {
        var random = new PairRandom(seed);
        List<Pair> pairs = [];
        while (pairs.Count < count)
        {
            if (TryCreate(ref random, mostTilt, leastRatio, margin, allowSegments, out var pair) && !(pair.A.Count == 2 && pair.B.Count == 2))
                pairs.Add(pair);
        }
        return pairs;
    }

    [Theory]
    [InlineData(1, 0.0, 1.0)]
    [InlineData(2, 0.01, 0.1)]
    [InlineData(3, 1.0, 0.1)]
    [InlineData(4, 0.1, 0.01)]
    public void ContactsAreCornersOfTheOverlap(int seed, double mostTilt, double leastRatio)
    {
        var pairs = CreateMany((ulong)seed, 6000, mostTilt, leastRatio, float.MaxValue, allowSegments: true);
        var results = Harness.Run(pairs);
        List<double> places = [], depths = [], heights = [], shares = [], deepest = [];
        for (int i = 0; i < pairs.Count; ++i)
        {
            var pair = pairs[i];
            var contacts = results[i];
            var reference = Reference(pair);
            var size = Math.Min(Extent(pair.A), Extent(pair.B));
            // Planes of narrow polygons follow from vertices that are rounded.
            var scale = size + Math.Max(pair.A.Size, pair.B.Size) * 0.1;
            Assert.InRange(contacts.Contacts.Length, 1, 4);
            Assert.Equal(contacts.Contacts.Length, contacts.Contacts.Select(contact => contact.FeatureId).Distinct().Count());
            List<FacePoint> points = [];
            foreach (var contact in contacts.Contacts)
            {
                var point = reference.Project(contact.Offset);
                points.Add(point);
                places.Add(reference.Outside(point.X, point.Y) / scale);
                var depth = Math.Min(reference.DepthAt(point.X, point.Y), pair.Depth);
                depths.Add(Math.Abs(contact.Depth - depth) / scale);
                var middle = reference.HeightOfA(point.X, point.Y) + contact.Depth * 0.5;
                heights.Add(Math.Abs(point.Height - middle) / scale);
            }
            deepest.Add((pair.Depth - contacts.Deepest) / size);
            if (pair.A.Count > 2 && pair.B.Count > 2 && reference.Area > 1e-3 * size * size)
                shares.Add(FaceReference.HullArea(points) / reference.Area);
        }
        output.WriteLine($"outside {places.Max():e1}, depth {depths.Max():e1}, middle {heights.Max():e1}, deepest {deepest.Max():e1}, " +
            $"area: least {shares.Min():f3}, mean {shares.Average():f3} of {shares.Count}");
        Assert.True(places.Max() < PlaceTolerance, $"outside {places.Max()}");
        Assert.True(depths.Max() < PlaceTolerance, $"depth {depths.Max()}");
        Assert.True(heights.Max() < PlaceTolerance, $"middle {heights.Max()}");
        Assert.True(deepest.Max() < 2e-4, $"deepest {deepest.Max()}");
        Assert.True(shares.Min() > 0.3, $"area {shares.Min()}");
    }

    /// <summary>The same pair with B first; contacts in A's frame again.</summary>
    static FaceContacts RunSwapped(in Pair pair)
    {
        var toB = Quaternion.Conjugate(pair.LocalOrientationB);
        var pointOnB = pair.PointOnA + pair.Normal * pair.Depth;
        var (offset, orientation) = (pair.LocalOffsetB, pair.LocalOrientationB);
        var contacts = Harness.Run(new Pair(pair.B, pair.A, Vector3.Transform(-offset, toB), toB, pair.OrientationA,
            Vector3.Transform(-pair.Normal, toB), pair.Depth, Vector3.Transform(pointOnB - offset, toB), pair.SpeculativeMargin));
        Double3 x = Double3.RotatedAxis(orientation, 0), y = Double3.RotatedAxis(orientation, 1), z = Double3.RotatedAxis(orientation, 2);
        return new(x * contacts.Normal.X + y * contacts.Normal.Y + z * contacts.Normal.Z, [.. contacts.Contacts.Select(contact => contact with
        {
            Offset = new Double3(offset) + x * contact.Offset.X + y * contact.Offset.Y + z * contact.Offset.Z,
        })]);
    }

    [Fact]
    public void TheOtherWayRoundTheContactsAreTheSame()
    {
        var compared = 0;
        foreach (var pair in CreateMany(11, 4000, 0.3, 0.1, float.MaxValue, allowSegments: true))
        {
            var contacts = Harness.Run(pair);
            var swapped = RunSwapped(pair);
            var size = Math.Min(Extent(pair.A), Extent(pair.B));
            var tolerance = 3e-4 * size + 1e-5 * Math.Max(pair.A.Size, pair.B.Size);
            Assert.True((contacts.Normal + swapped.Normal).Length < 1e-5);
            Assert.Equal(contacts.Deepest, swapped.Deepest, 2e-4 * size);
            var reference = Reference(pair);
            var corners = reference.Corners;
            // Of more corners other four may be kept, and of corners that are close together another one.
            if (corners.Count > 4 || !AreApart(corners, 0.05 * size))
                continue;
            ++compared;
            Assert.Equal(contacts.Contacts.Length, swapped.Contacts.Length);
            foreach (var contact in contacts.Contacts)
            {
                Assert.Contains(swapped.Contacts, other =>
                    (other.Offset - contact.Offset).Length < tolerance && Math.Abs(other.Depth - contact.Depth) < tolerance);
            }
        }
        Assert.True(compared > 300, $"{compared}");
    }

    static bool AreApart(IReadOnlyList<FacePoint> corners, double distance)
    {
        for (int i = 0; i < corners.Count; ++i)
        {
            FacePoint p = corners[i], q = corners[(i + 1) % corners.Count], r = corners[(i + 2) % corners.Count];
            var pq = new Double3(q.X - p.X, q.Y - p.Y, 0);
            var qr = new Double3(r.X - q.X, r.Y - q.Y, 0);
            // Where edges meet at a small angle the border moves their corner far.
            if (pq.Length < distance || (corners.Count > 2 && Double3.Cross(pq, qr).Length < 0.1 * pq.Length * qr.Length))
                return false;
        }
        return true;
    }

    [Fact]
    public void FeatureIdsStayTheSameUnderSmallMotion()
    {
        var random = new PairRandom(12);
        int all = 0, kept = 0, near = 0;
        foreach (var pair in CreateMany(13, 3000, 0.01, 0.1, float.MaxValue, allowSegments: true))
        {
            var size = (float)Math.Min(Extent(pair.A), Extent(pair.B));
            var moved = pair;
            var motion = 1e-4f * size;
            moved.LocalOffsetB += random.NextDirection() * motion;
            var pose = Reference(moved);
            if (pose.Corners.Count == 0)
                continue;
            var (depth, point) = pose.FindDeepest();
            moved.Depth = (float)depth;
            moved.PointOnA = new((float)point.X, (float)point.Y, (float)point.Z);
            var before = Harness.Run(pair);
            var after = Harness.Run(moved);
            foreach (var contact in before.Contacts)
            {
                ++all;
                var same = after.Contacts.Where(other => other.FeatureId == contact.FeatureId).ToArray();
                if (same.Length == 0)
                    continue;
                ++kept;
                near += (same[0].Offset - contact.Offset).Length < 20 * motion ? 1 : 0;
            }
        }
        output.WriteLine($"{all} contacts, {kept} kept their id, {near} of these are near to where they were");
        Assert.True(kept > 0.97 * all);
        Assert.True(near > 0.97 * kept);
    }

    [Theory]
    [InlineData(14, 0.0, 1.0)]
    [InlineData(15, 0.01, 0.1)]
    public void WhateverIsRememberedTheDeepestContactIsAsDeepAsThePair(int seed, double mostTilt, double leastRatio)
    {
        var pairs = CreateMany((ulong)seed, 3000, mostTilt, leastRatio, float.MaxValue, allowSegments: true);
        var random = new Random(seed);
        var remembered = new int[pairs.Count];
        for (int i = 0; i < pairs.Count; ++i)
            remembered[i] = random.Next(4) == 0 ? random.Next() : random.Next(1, 33) | random.Next(1, 33) << 8;
        var again = remembered.ToArray();
        var results = Harness.Run(pairs, remembered: remembered);
        var changed = 0;
        for (int i = 0; i < pairs.Count; ++i)
        {
            var pair = pairs[i];
            var smaller = Math.Min(pair.A.Size, pair.B.Size);
            Assert.InRange(results[i].Deepest, pair.Depth - 2.01e-4 * smaller, pair.Depth);
            changed += results[i].SameBits(Harness.Run(pair)) ? 0 : 1;
        }
        Assert.True(changed > (mostTilt == 0 ? 100 : 0), $"only {changed} pairs had other contacts than without it");

        // And all of it for every lane by itself.
        var order = Enumerable.Range(0, pairs.Count).OrderBy(_ => random.Next()).ToArray();
        var shuffled = Harness.Run(pairs, order, remembered: again);
        for (int i = 0; i < pairs.Count; ++i)
            Assert.True(results[i].SameBits(shuffled[i]), $"pair {i}");
        Assert.Equal(remembered, again);
    }

    [Fact]
    public void PolygonsWithoutAnAreaHaveTheirWitness()
    {
        var square = new FaceTestPolygon([new(-1, 0, 1), new(1, 0, 1), new(1, 0, -1), new(-1, 0, -1)], Vector3.UnitY);
        var normal = -Vector3.UnitY;
        FaceTestPolygon[] shapes =
        [
            new([new(0.2f, 0, 0.3f), new(0.2f, 0, 0.3f), new(0.2f, 0, 0.3f)], normal),
            new([new(0.2f, 0, 0.3f), new(0.4f, 0, 0.3f), new(0.2f, 0, 0.3f), new(0.2f, 0, 0.3f)], normal),
            new([new(0.2f, 0, 0.3f), new(0.4f, 0, 0.5f), new(0.3f, 0, 0.4f)], Vector3.Zero),
            new([new(0.2f, 0, 0.3f), new(0.2f, 1, 0.3f)], normal),
            new([new(0.2f, 0, 0.3f), new(0.2f, 0, 0.3f)], Vector3.Zero),
            new([new(0.2f, 0, 0.3f)], normal),
        ];
        foreach (var shape in shapes)
        {
            var pair = new Pair(shape, square, default, Quaternion.Identity, Quaternion.Identity, Vector3.UnitY, 0, new(0.2f, 0, 0.3f), 0.1f);
            var contacts = Harness.Run(pair);
            Assert.NotEmpty(contacts.Contacts);
            Assert.Contains(contacts.Contacts, contact => (contact.Offset - new Double3(0.2f, 0, 0.3f)).Length < 1e-6);
            Assert.All(contacts.Contacts, contact => Assert.Equal(0, contact.Depth, 1e-6));
            Assert.NotEmpty(RunSwapped(pair).Contacts);
        }
    }

    static double Extent(in FaceTestPolygon polygon)
    {
        double extent = 0;
        for (int i = 1; i < polygon.Count; ++i)
            extent = Math.Max(extent, (polygon.Vertices[i] - polygon.Vertices[0]).Length());
        return extent;
    }
}
