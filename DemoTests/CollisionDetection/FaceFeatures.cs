using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using DemoTests.CollisionDetection.References;

namespace DemoTests.CollisionDetection;

/// <summary>A feature of one shape.</summary>
sealed record FaceFeature(Vector3[] Vertices, Vector3[] Padding, Vector3 PlaneNormal, int Id, float Margin, float Roundness, float Size)
{
    /// <summary>Vertices of what stands for a disc here: 2e-5 of the radius is missing in the middles of its sides.</summary>
    public const int DiscVertexCount = 512;

    /// <summary>Asks for a feature in one lane of a bundle; the others are not wanted.</summary>
    public static FaceFeature Find<TShape, TShapeWide, TFeature>(TShape shape, Vector3 direction, int lane = 0)
        where TShape : unmanaged where TShapeWide : unmanaged, IWide<TShape> where TFeature : unmanaged, IContactFeature<TShapeWide>
    {
        var wide = default(TShapeWide);
        Lanes.Write(shape, ref wide, lane);
        Vector3Wide directions = default;
        Lanes.Write(direction, ref directions, lane);
        var done = new Vector<int>(-1);
        GatherScatter.Get(ref done, lane) = 0;
        var vertices = new Vector3Wide[TFeature.MaximumVertexCount];
        TFeature.Find(wide, directions, done, ref vertices[0], out var feature);
        var count = feature.VertexCount[lane];
        List<Vector3> used = [], padding = [];
        if (TFeature.IsDisc && count > 2)
        {
            var center = Lanes.Read<Vector3, Vector3Wide>(ref vertices[0], lane);
            used.AddRange(Enumerable.Range(0, DiscVertexCount).Select(i => center + TFeature.DiscRadius(wide)[lane] * OnRim(i, feature.PlaneNormal.Y[lane])));
        }
        else
        {
            for (int i = 0; i < vertices.Length; ++i)
                (i < count ? used : padding).Add(Lanes.Read<Vector3, Vector3Wide>(ref vertices[i], lane));
        }
        return new([.. used], [.. padding], Lanes.Read<Vector3, Vector3Wide>(ref feature.PlaneNormal, lane), feature.Id[lane],
            feature.Margin[lane], feature.Roundness[lane], feature.Size[lane]);
    }

    // Counter-clockwise seen along the way that the disc looks to.
    static Vector3 OnRim(int index, float up)
    {
        var (sine, cosine) = Math.SinCos(index * Math.Tau / DiscVertexCount);
        return new((float)sine * up, 0, (float)cosine);
    }

    /// <summary>The vertices in another frame, pushed out along a direction by the margin.</summary>
    public IEnumerable<Double3> VerticesAt(Vector3 offset, Quaternion orientation, Vector3 outwards)
    {
        Double3 x = Double3.RotatedAxis(orientation, 0), y = Double3.RotatedAxis(orientation, 1), z = Double3.RotatedAxis(orientation, 2);
        foreach (var v in Vertices)
            yield return new Double3(offset) + x * v.X + y * v.Y + z * v.Z + new Double3(outwards) * Margin;
    }
}
