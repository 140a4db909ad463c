using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using Xunit;

namespace DemoTests.Compounds;

/// <summary>What a mover touches anywhere on its way through a step is found, against the motion followed in doubles.</summary>
public class ContainerSweepTests
{
    const float Dt = 1 / 30f;
    const int Samples = 200;
    const float Radius = .2f;

    readonly struct Callbacks(HashSet<(int Pair, int A, int B)> found) : ICollisionCallbacks
    {
        public bool AllowCollisionTesting(int pairId, int childA, int childB) => !found.Add((pairId, childA, childB));

        public void OnChildPairCompleted(int pairId, int childA, int childB, ref ConvexContactManifold manifold) { }

        public void OnPairCompleted<TManifold>(int pairId, ref TManifold manifold) where TManifold : unmanaged, IContactManifold<TManifold> { }
    }

    readonly record struct Point(double X, double Y, double Z)
    {
        public static implicit operator Point(Vector3 v) => new(v.X, v.Y, v.Z);
        public static Point operator +(Point a, Point b) => new(a.X + b.X, a.Y + b.Y, a.Z + b.Z);
        public static Point operator -(Point a, Point b) => new(a.X - b.X, a.Y - b.Y, a.Z - b.Z);
        public static Point operator *(Point a, double b) => new(a.X * b, a.Y * b, a.Z * b);
        public static Point Cross(Point a, Point b) => new(a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);
        public double Dot(Point b) => X * b.X + Y * b.Y + Z * b.Z;
        public double Length => Math.Sqrt(Dot(this));

        /// <summary>Turned around an axis by its length (Rodrigues).</summary>
        public Point Turned(Point turn)
        {
            var angle = turn.Length;
            if (angle == 0)
                return this;
            var axis = turn * (1 / angle);
            return this * Math.Cos(angle) + Cross(axis, this) * Math.Sin(angle) + axis * (axis.Dot(this) * (1 - Math.Cos(angle)));
        }

        public Point Turned(Quaternion q)
        {
            var axis = new Point(q.X, q.Y, q.Z);
            var t = Cross(axis, this) * 2;
            return this + t * q.W + Cross(axis, t);
        }
    }

    // Spheres against boxes: the distance of a point from a box is exact.
    static double Distance(Point center, Point boxCenter, Quaternion boxTurn, Point turn, Vector3 half)
    {
        var local = (center - boxCenter).Turned(turn * -1).Turned(Quaternion.Conjugate(boxTurn));
        var outside = new Point(Math.Max(0, Math.Abs(local.X) - half.X), Math.Max(0, Math.Abs(local.Y) - half.Y), Math.Max(0, Math.Abs(local.Z) - half.Z));
        return outside.Length;
    }

    [Theory]
    [InlineData(false, false, 0f)]
    [InlineData(false, true, 0f)]
    [InlineData(true, false, 0f)]
    [InlineData(true, true, 0f)]
    [InlineData(false, true, .3f)]
    [InlineData(true, true, .3f)]
    public void Children_on_the_way_are_found(bool moverIsCompound, bool isBig, float margin)
    {
        using var workshop = new CompoundWorkshop(moverIsCompound ? 7 : 8);
        var half = new Vector3(.3f, .2f, .4f);
        var box = workshop.Shapes.Add(new Box(2 * half.X, 2 * half.Y, 2 * half.Z));
        var sphere = workshop.Shapes.Add(new Sphere(Radius));
        var container = workshop.Add(CreateChildren(workshop, box, 40, 2), isBig);
        var mover = moverIsCompound ? workshop.Add(CreateChildren(workshop, sphere, 6, .6f), isBig) : sphere;
        var found = new HashSet<(int, int, int)>();
        var batcher = new CollisionBatcher<Callbacks>(
            workshop.Pool, workshop.Shapes, DefaultTypes.CreateDefaultCollisionTaskRegistry(), Dt, new(found));
        var touched = new HashSet<(int, int, int)>();
        const int Count = 60;
        for (int pair = 0; pair < Count; ++pair)
        {
            var offset = workshop.NextVector(moverIsCompound ? 4 : 2);
            var (turnA, turnB) = (workshop.NextTurn(), workshop.NextTurn());
            var moverIsA = pair % 2 == 0;
            var velocityA = new BodyVelocity(workshop.NextVector(20), workshop.NextVector(pair % 3 * 8));
            var velocityB = new BodyVelocity(workshop.NextVector(20), workshop.NextVector(pair % 5 * 4));
            batcher.Add(moverIsA ? mover : container, moverIsA ? container : mover, offset, turnA, turnB, velocityA, velocityB, margin, float.MaxValue,
                new(pair));
            var (a, b) = (workshop.ChildrenOf(moverIsA ? mover : container), workshop.ChildrenOf(moverIsA ? container : mover));
            for (int sample = 0; sample <= Samples; ++sample)
            {
                double t = Dt * (double)sample / Samples;
                for (int i = 0; i < a.Length; ++i)
                {
                    for (int j = 0; j < b.Length; ++j)
                    {
                        var placeA = ((Point)velocityA.Linear * t) + ((Point)a[i].LocalPosition).Turned(turnA).Turned((Point)velocityA.Angular * t);
                        var placeB = (Point)offset + ((Point)velocityB.Linear * t) +
                            ((Point)b[j].LocalPosition).Turned(turnB).Turned((Point)velocityB.Angular * t);
                        var (ball, place) = moverIsA ? (placeA, placeB) : (placeB, placeA);
                        var (child, turn, spin) = moverIsA ? (b[j], turnB, velocityB.Angular) : (a[i], turnA, velocityA.Angular);
                        var distance = Distance(ball, place, Quaternion.Concatenate(child.LocalOrientation, turn), (Point)spin * t, half);
                        if (distance <= Radius + (sample == 0 ? margin : 0))
                            touched.Add((pair, i, j));
                    }
                }
            }
        }
        batcher.Flush();
        Assert.Empty(touched.Except(found));
        Assert.InRange(touched.Count, 30, int.MaxValue);
        // Not everything: boxes around ways are wider than these, by not too much.
        Assert.InRange(found.Count, touched.Count, Count * 40 * (moverIsCompound ? 6 : 1) * 2 / 3);
    }

    static BepuUtilities.Memory.Buffer<CompoundChild> CreateChildren(CompoundWorkshop workshop, TypedIndex shape, int count, float spread)
    {
        workshop.Pool.Take<CompoundChild>(count, out var children);
        for (int i = 0; i < count; ++i)
            children[i] = new(new RigidPose(workshop.NextVector(spread), workshop.NextTurn()), shape);
        return children;
    }

    [Fact]
    public void An_expansion_is_no_greater_than_allowed()
    {
        using var workshop = new CompoundWorkshop(5);
        var sphere = workshop.Shapes.Add(new Sphere(Radius));
        workshop.Pool.Take<CompoundChild>(3, out var children);
        for (int i = 0; i < 3; ++i)
            children[i] = new(new RigidPose(new Vector3(i, 0, 0)), sphere);
        var compound = workshop.Add(children, isBig: false);
        foreach (var (limit, reached) in ((float, int)[])[(0, 1), (.7f, 2), (5, 3)])
        {
            var found = new HashSet<(int, int, int)>();
            var batcher = new CollisionBatcher<Callbacks>(
                workshop.Pool, workshop.Shapes, DefaultTypes.CreateDefaultCollisionTaskRegistry(), 1, new(found));
            batcher.Add(sphere, compound, default, Quaternion.Identity, Quaternion.Identity, new Vector3(100, 0, 0), default, 0, limit, new(0));
            batcher.Flush();
            Assert.Equal(reached, found.Count);
        }
    }
}
