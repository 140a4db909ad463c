using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;
using DemoTests.Collidables.Meshes;

namespace DemoTests.Compounds;

/// <summary>Makes compounds; its pool must be empty in the end.</summary>
sealed class CompoundWorkshop : IDisposable
{
    public CompoundWorkshop(int seed)
    {
        Random = new Random(seed);
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
    public TypedIndex AddHills()
    {
        var heights = new float[13 * 11];
        foreach (ref var height in heights.AsSpan())
            height = Next(-.4f, .4f);
        return Shapes.Add(new HeightField(13, 11, .7f, .9f, heights, Pool));
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

    /// <summary>Removes all shapes and what they own.</summary>
    public void Dispose()
    {
        for (int type = Shapes.RegisteredTypeSpan - 1; type >= 0; --type)
        {
            for (int i = 0; Shapes[type] is { } batch && i < batch.Capacity; ++i)
            {
                if (batch.Exists(i))
                    Shapes.RecursivelyRemoveAndDispose(new TypedIndex(type, i), Pool);
            }
        }
        Shapes.Dispose();
        Pool.AssertEmpty();
        Pool.Clear();
    }
}
