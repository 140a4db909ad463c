using System;
using System.Numerics;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Boxes of a bundle of children, which may be of several types.</summary>
ref struct ChildBoxes(Span<int> shapeIndices)
{
    readonly Span<int> shapeIndices = shapeIndices;
    Vector3Wide position, min, max;
    Vector<float> maximumRadius, maximumAngularExpansion;

    /// <summary>Number of children.</summary>
    public int Count { get; private set; }

    /// <summary>Computes the boxes of the children from one on, their compound at the origin.</summary>
    public void Compute(Buffer<CompoundChild> children, int start, in Quaternion orientation, Shapes shapes)
    {
        Count = Math.Min(Vector<float>.Count, children.Length - start);
        var orientations = default(QuaternionWide);
        for (int i = 0; i < Count; ++i)
        {
            Lanes.Write(children[start + i].LocalPosition, ref position, i);
            Lanes.Write(children[start + i].LocalOrientation, ref orientations, i);
        }
        // What is not turned is not rounded.
        if (orientation != Quaternion.Identity)
        {
            var parent = Lanes.Broadcast<Quaternion, QuaternionWide>(orientation);
            position = parent * position;
            orientations = QuaternionWide.Concatenate(orientations, parent);
        }
        int done = 0;
        for (int first = 0; first < Count; ++first)
        {
            if ((done & 1 << first) != 0)
                continue;
            // All lanes of this shape type at once. The others have no shape.
            var type = children[start + first].ShapeIndex.Type;
            int lanes = 0;
            for (int i = 0; i < Vector<float>.Count; ++i)
            {
                var same = i >= first && i < Count && children[start + i].ShapeIndex.Type == type;
                shapeIndices[i] = same ? children[start + i].ShapeIndex.Index : -1;
                lanes |= same ? 1 << i : 0;
            }
            done |= lanes;
            shapes.GetBatch(type).GetBounds(shapeIndices, orientations, out var radius, out var expansion, out var typeMin, out var typeMax);
            Take(lanes, radius, expansion, typeMin, typeMax);
        }
    }

    void Take(int lanes, Vector<float> radius, Vector<float> expansion, in Vector3Wide typeMin, in Vector3Wide typeMax)
    {
        var mask = Vector<int>.Zero;
        for (int i = 0; i < Vector<float>.Count; ++i)
            GatherScatter.Get(ref mask, i) = (lanes & 1 << i) == 0 ? 0 : -1;
        maximumRadius = Wide.Select(mask, radius, maximumRadius);
        maximumAngularExpansion = Wide.Select(mask, expansion, maximumAngularExpansion);
        min = Vector3Wide.Select(mask, position + typeMin, min);
        max = Vector3Wide.Select(mask, position + typeMax, max);
    }

    /// <summary>Box of a child.</summary>
    public void Get(int i, out Vector3 childMin, out Vector3 childMax)
    {
        childMin = Lanes.Read<Vector3, Vector3Wide>(ref min, i);
        childMax = Lanes.Read<Vector3, Vector3Wide>(ref max, i);
    }

    /// <summary>Adds a child to what is known of its compound.</summary>
    public void AddTo(ref CompoundExtent extent, int i)
    {
        Get(i, out var childMin, out var childMax);
        extent.Add(childMin, childMax, Lanes.Read<Vector3, Vector3Wide>(ref position, i), maximumRadius[i], maximumAngularExpansion[i]);
    }
}
