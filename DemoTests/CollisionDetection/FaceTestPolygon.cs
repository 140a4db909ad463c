using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.CollisionDetection;
using BepuUtilities;

namespace DemoTests.CollisionDetection;

/// <summary>A shape that is nothing but a polygon of up to 16 vertices.</summary>
public struct FaceTestPolygon
{
    public const int MaximumCount = 16;

    [InlineArray(MaximumCount)]
    public struct VertexArray
    {
        Vector3 first;
    }

    public int Count;
    public Vector3 PlaneNormal;
    public float Size;
    public VertexArray Vertices;

    public FaceTestPolygon(ReadOnlySpan<Vector3> vertices, Vector3 planeNormal)
    {
        Count = vertices.Length;
        PlaneNormal = planeNormal;
        Vertices = default;
        for (int i = 0; i < MaximumCount; ++i)
        {
            Vertices[i] = vertices[i < Count ? i : 0];
            Size = Math.Max(Size, Vertices[i].Length());
        }
    }
}

public struct FaceTestPolygonWide : IWide<FaceTestPolygon>
{
    [InlineArray(FaceTestPolygon.MaximumCount)]
    public struct VertexArray
    {
        Vector3Wide first;
    }

    public Vector<int> Count;
    public Vector3Wide PlaneNormal;
    public Vector<float> Size;
    public VertexArray Vertices;
}

readonly struct FaceTestFeature : IContactFeature<FaceTestPolygonWide>
{
    public static int MaximumVertexCount => FaceTestPolygon.MaximumCount;

    public static void Find(in FaceTestPolygonWide shape, in Vector3Wide direction, Vector<int> done, ref Vector3Wide vertices,
        out ContactFeatureWide feature)
    {
        for (int i = 0; i < MaximumVertexCount; ++i)
            Unsafe.Add(ref vertices, i) = shape.Vertices[i];
        feature.VertexCount = shape.Count;
        feature.PlaneNormal = shape.PlaneNormal;
        feature.Id = new Vector<int>(3);
        feature.Margin = feature.Roundness = Vector<float>.Zero;
        feature.Size = shape.Size;
    }
}
