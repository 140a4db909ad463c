using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Collidables.Meshes;
using DemoTests.Support;

namespace DemoTests.Compounds;

/// <summary>A convex piece of a shape: its number, and where it is in the frame of the shape.</summary>
readonly record struct Piece(int Number, RigidPose Pose, TypedIndex Shape)
{
    /// <summary>Where it is while the shape is turned and at the origin.</summary>
    public RigidPose Place(Quaternion orientation) =>
        new(Exact.Rotate(Pose.Position, orientation), Exact.Concatenate(Pose.Orientation, orientation));
}

/// <summary>Makes compounds; its pool must be empty in the end.</summary>
sealed class CompoundWorkshop : IDisposable
{
    public CompoundWorkshop(int seed)
    {
        Random = new Random(LevelSeeds.Of(seed));
        Shapes = new Shapes(Pool, 2);
    }

    public BufferPool Pool { get; } = new();

    public Shapes Shapes { get; }

    public Random Random { get; }

    /// <summary>Types of shapes that may be children.</summary>
    public static readonly int[] ConvexTypes = [Sphere.Id, Capsule.Id, Box.Id, Triangle.Id, Cylinder.Id, ConvexHull.Id];

    public float Next(float min, float max) => min + (max - min) * Random.NextSingle();

    public Vector3 NextVector(float size) => new(Next(-size, size), Next(-size, size), Next(-size, size));

    public Quaternion NextTurn() => Quaternion.Normalize(new(Next(-1, 1), Next(-1, 1), Next(-1, 1), Next(-1, 1)));

    /// <summary>Adds a shape of a type, of about a metre.</summary>
    public TypedIndex AddShape(int type) => type switch
    {
        Sphere.Id => Shapes.Add(new Sphere(Next(.3f, .6f))),
        Capsule.Id => Shapes.Add(new Capsule(Next(.2f, .4f), Next(.3f, 1))),
        Box.Id => Shapes.Add(new Box(Next(.4f, 1), Next(.4f, 1), Next(.4f, 1))),
        Triangle.Id => Shapes.Add(new Triangle(new(-.5f, 0, Next(-.5f, 0)), new(.5f, Next(-.2f, .2f), -.5f), new(0, 0, .6f)) { TwoSided = true }),
        Cylinder.Id => Shapes.Add(new Cylinder(Next(.3f, .5f), Next(.3f, .8f))),
        _ => Shapes.Add(NextHull()),
    };

    ConvexHull NextHull()
    {
        var points = new Vector3[12];
        foreach (ref var point in points.AsSpan())
            point = Vector3.Normalize(NextVector(1)) * .5f;
        return new ConvexHull(points, Pool, out _);
    }

    /// <summary>Children of all types in turn, in a ball.</summary>
    public Buffer<CompoundChild> CreateChildren(int count, float radius, int firstType = 0)
    {
        Pool.Take(count, out Buffer<CompoundChild> children);
        for (int i = 0; i < count; ++i)
            children[i] = new(new RigidPose(NextVector(radius), NextTurn()), AddShape(ConvexTypes[(i + firstType) % ConvexTypes.Length]));
        return children;
    }

    public TypedIndex Add(Buffer<CompoundChild> children, bool isBig) => isBig
        ? Shapes.Add(new BigCompound(children, Shapes, Pool))
        : Shapes.Add(new Compound(children));

    public TypedIndex AddCompound(int count, float radius, bool isBig, int firstType = 0) => Add(CreateChildren(count, radius, firstType), isBig);

    /// <summary>Whether a shape is made of children.</summary>
    public static bool IsContainer(TypedIndex name) => name.Type is Compound.Id or BigCompound.Id or Mesh.Id or HeightField.Id;

    /// <summary>Children of a shape: itself, for one without.</summary>
    public CompoundChild[] ChildrenOf(TypedIndex name) => name.Type switch
    {
        Compound.Id => Copy(Shapes.GetShape<Compound>(name.Index).Children),
        BigCompound.Id => Copy(Shapes.GetShape<BigCompound>(name.Index).Children),
        Mesh.Id => CopyTriangles(Shapes.GetShape<Mesh>(name.Index), Shapes.GetShape<Mesh>(name.Index).ChildCount),
        HeightField.Id => CopyTriangles(Shapes.GetShape<HeightField>(name.Index), 2 * Shapes.GetShape<HeightField>(name.Index).CellCountX *
            Shapes.GetShape<HeightField>(name.Index).CellCountZ),
        _ => [new(RigidPose.Identity, name)],
    };

    /// <summary>Convex pieces of a shape, with the numbers that callbacks know them by: of children that are made of children, the pieces of these.</summary>
    public List<Piece> PiecesOf(TypedIndex name)
    {
        var pieces = new List<Piece>();
        var children = name.Type switch
        {
            Compound.Id => Shapes.GetShape<Compound>(name.Index).Children,
            BigCompound.Id => Shapes.GetShape<BigCompound>(name.Index).Children,
            _ => default,
        };
        if (!children.Allocated)
        {
            foreach (var child in ChildrenOf(name))
                pieces.Add(new(pieces.Count, new(child.LocalPosition, child.LocalOrientation), child.ShapeIndex));
            return pieces;
        }
        for (int i = 0; i < children.Length; ++i)
        {
            var (place, turn) = (children[i].LocalPosition, children[i].LocalOrientation);
            foreach (var inner in IsContainer(children[i].ShapeIndex) ? PiecesOf(children[i].ShapeIndex) : [new(0, RigidPose.Identity, children[i].ShapeIndex)])
            {
                var pose = IsContainer(children[i].ShapeIndex)
                    ? new RigidPose(place + Exact.Rotate(inner.Pose.Position, turn), Exact.Concatenate(inner.Pose.Orientation, turn))
                    : new RigidPose(place, turn);
                pieces.Add(new(new Compound(children).GetPieceIndex(i, inner.Number), pose, inner.Shape));
            }
        }
        return pieces;
    }

    /// <summary>
    /// Adds a compound of a mesh, a mirrored mesh, ground with hills, the two kinds of compounds and convex shapes, turned and elsewhere; one more mesh where
    /// it is to be for bodies.
    /// </summary>
    public TypedIndex AddNested(bool isBig, bool isForBodies = false)
    {
        Pool.Take(9, out Buffer<CompoundChild> children);
        for (int i = 0; i < children.Length; ++i)
        {
            var shape = i switch
            {
                1 => AddRing(new(1, Next(.7f, 1.3f), 1)),
                2 => AddRing(new(-1, Next(.7f, 1.3f), 1)),
                4 => AddCompound(5, .8f, isBig: true, 2),
                5 => AddCompound(3, .5f, isBig: false, 4),
                7 => isForBodies ? AddRing(new(-1.2f)) : AddHills(5, 4),
                _ => AddShape(ConvexTypes[i % ConvexTypes.Length]),
            };
            children[i] = new(new RigidPose(NextVector(2), NextTurn()), shape);
        }
        return Add(children, isBig);
    }

    TypedIndex AddRing(Vector3 scale)
    {
        var torus = MeshSample.Torus(.7f, .3f, 5, 4);
        return Shapes.Add(new Mesh(torus.Vertices, torus.Indices, scale, Pool));
    }

    unsafe CompoundChild[] CopyTriangles<TContainer>(TContainer container, int count) where TContainer : unmanaged, IContainer
    {
        var copy = new CompoundChild[count];
        var scratch = stackalloc Vector4[IContainer.ScratchByteCount / sizeof(Vector4)];
        for (int i = 0; i < count; ++i)
        {
            container.GetChild(i, Shapes, scratch, out var child);
            copy[i] = new(child.Pose, Shapes.Add(*(Triangle*)child.Shape));
        }
        return copy;
    }

    /// <summary>Adds a closed mesh of about a metre.</summary>
    public TypedIndex AddMesh()
    {
        var torus = MeshSample.Torus(Next(.6f, 1), .3f, 9, 6);
        return Shapes.Add(new Mesh(torus.Vertices, torus.Indices, new(Next(.8f, 1.2f), 1, 1), Pool));
    }

    /// <summary>Adds ground with hills, about the origin.</summary>
    public TypedIndex AddHills(int countX = 13, int countZ = 11)
    {
        var heights = new float[countX * countZ];
        foreach (ref var height in heights.AsSpan())
            height = Next(-.4f, .4f);
        return Shapes.Add(new HeightField(countX, countZ, .7f, .9f, heights, Pool));
    }

    static CompoundChild[] Copy(Buffer<CompoundChild> children)
    {
        var copy = new CompoundChild[children.Length];
        for (int i = 0; i < copy.Length; ++i)
            copy[i] = children[i];
        return copy;
    }

    /// <summary>Where a child is while its compound is turned and at the origin.</summary>
    public static RigidPose Place(in CompoundChild child, Quaternion orientation) =>
        new(Exact.Rotate(child.LocalPosition, orientation), Exact.Concatenate(child.LocalOrientation, orientation));

    /// <summary>Removes all shapes and what they own: what is made of shapes that are made of others first.</summary>
    public static void RemoveAll(Shapes shapes, BufferPool pool)
    {
        for (int pass = 0; pass < 3; ++pass)
        {
            for (int type = 0; type < shapes.RegisteredTypeSpan; ++type)
            {
                for (int i = 0; shapes[type] is { } batch && i < batch.Capacity; ++i)
                {
                    if (batch.Exists(i) && (pass == 2 || (pass == 1 && type is Compound.Id or BigCompound.Id) || batch.HasContainer(i)))
                        shapes.RecursivelyRemoveAndDispose(new TypedIndex(type, i), pool);
                }
            }
        }
    }

    /// <summary>Removes all shapes and what they own.</summary>
    public void Dispose()
    {
        RemoveAll(Shapes, Pool);
        Shapes.Dispose();
        Pool.AssertEmpty();
        Pool.Clear();
    }
}
