using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A convex shape of those that the library comes with, as its bytes.</summary>
unsafe struct ShapeCopy
{
    /// <summary>The shape.</summary>
    public fixed byte Bytes[Capacity];

    const int Capacity = 40;

    static ReadOnlySpan<byte> ByteCounts => [4, 8, 12, 40, 8, 16];

    /// <summary>Whether the shapes of a type can be copied.</summary>
    public static bool Fits(int typeId) => (uint)typeId < (uint)ByteCounts.Length;

    /// <summary>The shape, which is of this type.</summary>
    public readonly TShape Read<TShape>() where TShape : unmanaged
    {
        fixed (byte* bytes = Bytes)
            return Unsafe.ReadUnaligned<TShape>(bytes);
    }

    /// <summary>Copies a shape.</summary>
    // By the words that it is made of: a triangle was just written by these, and a wider load would have to wait for them.
    public void Write(int typeId, void* shape)
    {
        fixed (byte* bytes = Bytes)
        {
            for (int i = 0; i < ByteCounts[typeId]; i += sizeof(uint))
                *(uint*)(bytes + i) = *(uint*)((byte*)shape + i);
        }
    }
}

/// <summary>Two children with their shapes and poses, for as long as their parent is open.</summary>
/// <remarks>Shapes are copied: some are made up when they are asked for, and those of a batch are gone when it is expanded.</remarks>
unsafe struct PlacedChildren
{
    /// <summary>Type ids of the shapes; negative for those that cannot be looked at along a direction.</summary>
    public int TypeA, TypeB;
    /// <summary>The shapes.</summary>
    public ShapeCopy ShapeA, ShapeB;
    /// <summary>Position of B's child less that of A's.</summary>
    public Vector3 OffsetB;
    /// <summary>Rotations from the children's frames to the world.</summary>
    public Quaternion OrientationA, OrientationB;
    /// <summary>What is next to a triangle.</summary>
    public TriangleCone ConeA, ConeB;

    /// <summary>Greatest distance at which a contact exists, m.</summary>
    public float SpeculativeMargin;

    /// <summary>How A moves relative to B within the step; not at all where nobody has said.</summary>
    public ChildMotion Motion;

    /// <summary>Whether the mover is B: what touches the others, and tells how high a lip is that does not stop it.</summary>
    public bool MoverIsB;

    /// <summary>Whether both shapes are among those that can be looked at along a direction.</summary>
    public readonly bool AreKnown => TypeA >= 0 && TypeB >= 0;

    /// <summary>Number of contacts from which on they may be carried along while the shapes hardly move; more than there can be of shapes that are not known.
    /// </summary>
    public readonly int LeastCarriedContactCount => FindLeastCarriedContactCount(TypeA, TypeB);

    /// <summary>That of shapes of two types.</summary>
    public static int FindLeastCarriedContactCount(int typeA, int typeB) => ShapeCopy.Fits(typeA) && ShapeCopy.Fits(typeB)
        ? RollingContacts.LeastCarriedCount(IsRound(typeA) || IsRound(typeB)) : ConvexContactManifold.MaximumContactCount + 1;

    /// <summary>Whether shapes of a type have an axis that they may roll about: that of their y, or any.</summary>
    public static bool IsRound(int typeId) => typeId == Sphere.Id || typeId == Capsule.Id || typeId == Cylinder.Id;

    /// <summary>Keeps what a task has said of two children; how they move is written beside it.</summary>
    public void Write(in ChildShapes children, bool moverIsB, float speculativeMargin)
    {
        SpeculativeMargin = speculativeMargin;
        MoverIsB = moverIsB;
        TypeA = Keep(children.TypeA, children.ShapeA, ref ShapeA);
        TypeB = Keep(children.TypeB, children.ShapeB, ref ShapeB);
        OffsetB = children.OffsetB - children.OffsetA;
        OrientationA = children.OrientationA;
        OrientationB = children.OrientationB;
        ConeA = children.ConeA;
        ConeB = children.ConeB;
    }

    static int Keep(int typeId, void* shape, ref ShapeCopy copy)
    {
        if (!ShapeCopy.Fits(typeId))
            return -1;
        copy.Write(typeId, shape);
        return typeId;
    }

    /// <summary>Whether both shapes are triangles.</summary>
    public readonly bool AreTriangles => TypeA == Triangle.Id && TypeB == Triangle.Id;

    /// <summary>
    /// Radius of a ball that lies in the mover, m; of a triangle, which is flat, that of the other, and if that is one too, of a circle in the mover.
    /// </summary>
    public readonly float InnerRadius()
    {
        if (AreTriangles)
            return InnerRadius((MoverIsB ? ShapeB : ShapeA).Read<Triangle>());
        var radius = MoverIsB ? InnerRadius(TypeB, ShapeB) : InnerRadius(TypeA, ShapeA);
        if (radius > 0)
            return radius;
        return MoverIsB ? InnerRadius(TypeA, ShapeA) : InnerRadius(TypeB, ShapeB);
    }

    // Twice the area over the length of the border.
    static float InnerRadius(in Triangle triangle)
    {
        var (ab, bc, ca) = (triangle.B - triangle.A, triangle.C - triangle.B, triangle.A - triangle.C);
        return Exact.Length(Exact.Cross(ab, bc)) / (Exact.Length(ab) + Exact.Length(bc) + Exact.Length(ca));
    }

    static float InnerRadius(int typeId, in ShapeCopy shape)
    {
        switch (typeId)
        {
            case Sphere.Id:
                return shape.Read<Sphere>().Radius;
            case Capsule.Id:
                return shape.Read<Capsule>().Radius;
            case Box.Id:
                var box = shape.Read<Box>();
                return MathHelper.Min(MathHelper.Min(box.HalfWidth, box.HalfHeight), box.HalfLength);
            case Cylinder.Id:
                var cylinder = shape.Read<Cylinder>();
                return MathHelper.Min(cylinder.Radius, cylinder.HalfLength);
            case ConvexHull.Id:
                return shape.Read<ConvexHull>().Header->InnerRadius;
            default:
                return 0;
        }
    }

    /// <summary>By how much A has to move along a unit direction, from B to A, to be off B, m; of shapes that are known.</summary>
    public readonly float DepthAlong(in Vector3 normal) =>
        Exact.Dot(OffsetB, normal) + new ShapeReach(TypeB, ShapeB, OrientationB).Along(normal) + new ShapeReach(TypeA, ShapeA, OrientationA).Along(-normal);

    /// <summary>
    /// Whether a test along a unit direction would find for sure that two shapes are deeper than so much, m; of shapes that are known. It looks along faces,
    /// too, which are within 1e-2 rad of the direction: a point at a distance comes nearer by no more than a hundredth of that.
    /// </summary>
    public readonly bool AreDeeper(in Vector3 normal, float depth)
    {
        const float near = 1.01e-2f;
        var across = Exact.Dot(OffsetB, normal) - near * (Exact.Length(OffsetB) + ShapeReach.SizeOf(TypeA, ShapeA) + ShapeReach.SizeOf(TypeB, ShapeB));
        return across + ShapeReach.AlongOnce(TypeA, ShapeA, OrientationA, -normal) + ShapeReach.AlongOnce(TypeB, ShapeB, OrientationB, normal) > depth;
    }
}
