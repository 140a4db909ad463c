using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;

namespace Demos.Fuzz.Operations;

/// <summary>Calls to shapes and to the collection of them.</summary>
static class ShapeOperations
{
    const int MaximumShapes = 24;

    public static FuzzOperation[] All { get; } =
    [
        new("Shapes.Add sphere", 10, w => Add(w, new Sphere(Size(w)))),
        new("Shapes.Add capsule", 10, w => Add(w, new Capsule(Size(w), Size(w)))),
        new("Shapes.Add box", 14, w => Add(w, new Box(Size(w), Size(w), Size(w)))),
        new("Shapes.Add cylinder", 10, w => Add(w, new Cylinder(Size(w), Size(w)))),
        new("Shapes.Add triangle", 8, w => Add(w, new Triangle(w.Random.Vector(1), w.Random.Vector(1), w.Random.Vector(1)))),
        new("Shapes.Add hull", 12, AddHull),
        new("Shapes.Add compound", 8, w => AddCompound(w, false)),
        new("Shapes.Add big compound", 8, w => AddCompound(w, true)),
        new("Shapes.Add mesh", 5, AddMesh),
        new("Shapes.Add height field", 4, AddField),
        new("Compound.FindPiece", 4, FindPiece),
        new("Shapes.Add nothing", 1, w => w.Shapes.Add(default(ConvexHull))),
        new("Shapes.Remove", 5, w => w.Shapes.Remove(w.RemovableShape())),
        new("Shapes.RemoveAndDispose", 4, w => RemoveAndDispose(w, false)),
        new("Shapes.RecursivelyRemoveAndDispose", 4, w => RemoveAndDispose(w, true)),
        new("Shapes.Exists", 2, w => w.Shapes.Exists(w.AnyShape())),
        new("Shapes.UpdateBounds", 4, w => w.Shapes.UpdateBounds(w.Random.Spoil(w.AnyPose()), w.AnyShape(), out BoundingBox _)),
        new("Shapes.EnsureBatchCapacities", 2, w => w.Shapes.EnsureBatchCapacities(w.AnyCount())),
        new("Shapes.ResizeBatches", 2, w => w.Shapes.ResizeBatches(w.AnyCount())),
        new("Shapes[]", 2, w => _ = w.Shapes[w.Random.Below(12) - 2]?.Capacity),
        new("Shapes.GetShape", 3, w => _ = w.Has(FuzzScope.StaleReferences) ? w.Shapes.GetShape<Box>(w.AnyShape().Index).Width : 0),
        new("ConvexHull of any points", 5, MakeHull),
        new("ConvexHullHelper.CreateTransformedCopy", 4, CopyHull),
        new("ComputeInertia", 4, w => _ = new Box(Size(w), Size(w), Size(w)).ComputeInertia(w.Random.Spoil(1f, 40))),
        new("CreateConvexDynamic", 3, w => AddConvex(w, new Cylinder(Size(w), Size(w)))),
    ];

    static float Size(FuzzWorld w)
    {
        float size = w.Random.Spoil(w.Random.Number(0.2f, 1.2f), 4);
        w.Tell($"{size}");
        return size;
    }

    static void Add<TShape>(FuzzWorld w, TShape shape) where TShape : unmanaged, IConvexShape
    {
        if (w.ShapeNames.Live.Count < MaximumShapes)
            w.ShapeNames.Live.Add(w.Shapes.Add(w.Random.Spoil(shape, 6)));
    }

    static void AddConvex<TShape>(FuzzWorld w, TShape shape) where TShape : unmanaged, IConvexShape
    {
        if (w.ShapeNames.Live.Count >= MaximumShapes)
            return;
        w.ShapeNames.Live.Add(
            BodyDescription.CreateConvexDynamic(w.AnyPose(), w.Random.Spoil(1f, 20), w.Shapes, shape).Collidable.Shape);
    }

    static void AddHull(FuzzWorld w)
    {
        if (w.ShapeNames.Live.Count >= MaximumShapes)
            return;
        Vector3[] points = Points(w);
        // What one accepts, the other accepts.
        if (!ConvexHullHelper.TryCreateShape(points, w.Pool, out _, out ConvexHull hull, out HullFailure failure))
        {
            if (failure == HullFailure.None)
                throw new FuzzFailure("no hull, without a reason");
            return;
        }
        TypedIndex name;
        try
        {
            name = w.Shapes.Add(hull);
        }
        catch (Exception error)
        {
            hull.Dispose(w.Pool);
            if (error is ArgumentException)
                throw new FuzzFailure("a hull was created and then refused: " + error.Message, error);
            throw;
        }
        w.ShapeNames.Live.Add(name);
        w.Owners.Add(name, () => hull.Dispose(w.Pool));
    }

    static void AddCompound(FuzzWorld w, bool isBig)
    {
        if (w.ShapeNames.Live.Count >= MaximumShapes)
            return;
        w.Pool.Take(1 + w.Random.Below(6), out Buffer<CompoundChild> children);
        for (int i = 0; i < children.Length; ++i)
            children[i] = new(w.Random.Spoil(w.AnyPose(), 60), w.AnyShape());
        Action dispose = () => w.Pool.Return(ref children);
        try
        {
            TypedIndex name;
            if (isBig)
            {
                var big = new BigCompound(children, w.Shapes, w.Pool);
                dispose = () => big.Dispose(w.Pool);
                name = w.Shapes.Add(big);
            }
            else
            {
                name = w.Shapes.Add(new Compound(children));
            }
            w.ShapeNames.Live.Add(name);
            w.Owners.Add(name, dispose);
        }
        catch
        {
            dispose();
            throw;
        }
    }

    static void AddMesh(FuzzWorld w)
    {
        if (w.ShapeNames.Live.Count >= MaximumShapes)
            return;
        var triangles = new Triangle[1 + w.Random.Below(12)];
        for (int i = 0; i < triangles.Length; ++i)
            triangles[i] = w.Random.Spoil(new Triangle(w.Random.Vector(1), w.Random.Vector(1), w.Random.Vector(1)), 2);
        AddOwner(w, new Mesh(triangles, w.Random.Spoil(new Vector3(1, -1, 1), 4), w.Pool));
    }

    static void AddField(FuzzWorld w)
    {
        if (w.ShapeNames.Live.Count >= MaximumShapes)
            return;
        int countX = 2 + w.Random.Below(4), countZ = 2 + w.Random.Below(4);
        var heights = new float[countX * countZ];
        for (int i = 0; i < heights.Length; ++i)
            heights[i] = w.Random.Spoil(w.Random.Number(-0.3f, 0.3f), 1);
        AddOwner(w, new HeightField(countX, countZ, Size(w), Size(w), heights, w.Pool));
    }

    static void AddOwner<TShape>(FuzzWorld w, TShape shape) where TShape : unmanaged, IDisposableShape
    {
        TypedIndex name;
        try
        {
            name = w.Shapes.Add(shape);
        }
        catch
        {
            shape.Dispose(w.Pool);
            throw;
        }
        w.ShapeNames.Live.Add(name);
        w.Owners.Add(name, () => shape.Dispose(w.Pool));
    }

    // What a number says is what makes the number.
    static void FindPiece(FuzzWorld w)
    {
        TypedIndex name = w.AnyShape();
        if (!w.Shapes.Exists(name) || name.Type != Compound.Id)
            return;
        Compound compound = w.Shapes.GetShape<Compound>(name.Index);
        int piece = w.Random.Percent(50) ? w.Random.Below(compound.ChildCount) : w.Random.Below(int.MaxValue);
        w.Tell($"{piece}");
        compound.FindPiece(piece, out int child, out int inner);
        if (compound.GetPieceIndex(child, inner) != piece)
            throw new FuzzFailure($"piece {piece} is {inner} of child {child}, which is another");
    }

    static void MakeHull(FuzzWorld w)
    {
        Vector3[] points = Points(w);
        for (int i = 0; i < points.Length; ++i)
            points[i] = w.Random.Spoil(points[i], 3);
        var hull = new ConvexHull(points, w.Pool, out _);
        hull.Dispose(w.Pool);
    }

    static void CopyHull(FuzzWorld w)
    {
        var hull = new ConvexHull(Points(w), w.Pool, out _);
        try
        {
            var transform = w.Random.Spoil(Matrix3x3.FromQuaternion(w.Random.Turn()), 25);
            w.Tell($"{transform.X} {transform.Y} {transform.Z}");
            ConvexHullHelper.CreateTransformedCopy(hull, transform, w.Pool, out ConvexHull copy);
            copy.Dispose(w.Pool);
        }
        finally
        {
            hull.Dispose(w.Pool);
        }
    }

    static Vector3[] Points(FuzzWorld w)
    {
        var points = new Vector3[w.Random.Percent(95) ? 4 + w.Random.Below(12) : w.Random.Below(4)];
        var scale = new Vector3(1, w.Random.Percent(70) ? 1 : w.Random.Magnitude(1e-6f, 1), w.Random.Percent(70) ? 1 : w.Random.Magnitude(1e-6f, 1));
        float size = w.Random.Percent(90) ? 0.7f : w.Random.Magnitude(1e-12f, 1e12f);
        Quaternion turn = w.Random.Turn();
        for (int i = 0; i < points.Length; ++i)
            points[i] = Vector3.Transform(w.Random.Vector(size) * scale, turn);
        w.Tell($"{points.Length} points, size {size}, scale {scale}");
        return points;
    }

    static void RemoveAndDispose(FuzzWorld w, bool recursively)
    {
        TypedIndex shape = w.RemovableShape();
        if (recursively)
            w.Shapes.RecursivelyRemoveAndDispose(shape, w.Pool);
        else
            w.Shapes.RemoveAndDispose(shape, w.Pool);
        // What went with it has disposed of itself.
        foreach (TypedIndex name in new List<TypedIndex>(w.Owners.Keys))
        {
            if (!w.Shapes.Exists(name))
                w.Owners.Remove(name);
        }
    }
}
