using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Diagnostics;

namespace BepuPhysics.Collidables;

/// <summary>The point of a mesh's surface that is nearest to a point, in the mesh's frame.</summary>
/// <remarks>
/// Nearest may be a point of an edge or a corner, which several triangles have. Which side of the surface the point is on is said by that one of them
/// which it is farthest in front of or behind: another one's plane may be seen from its other side, past the edge.
/// </remarks>
unsafe ref struct MeshNearest
{
    // By how much squared distances of one and the same point may differ, as a part; and boxes be too near, by the roundings of their scale.
    const float Tie = 1e-5f;
    const int StackSize = MeshTree.MaximumHeight * MeshNode.Width;

    struct Entry
    {
        public float SquaredDistance;
        /// <summary>Number of triangles of a leaf; zero for a node.</summary>
        public int Count;
        /// <summary>Number of the node, or place of the leaf's first triangle.</summary>
        public int Index;
    }

    readonly Mesh mesh;
    readonly Vector3 query;
    float squaredDistance = float.MaxValue;

    /// <summary>Number of the triangle; negative if there is none.</summary>
    public int Triangle = -1;
    /// <summary>Unit normal of the triangle's front.</summary>
    public Vector3 Normal;
    /// <summary>From the point that was asked for to the nearest point.</summary>
    public Vector3 Offset;
    /// <summary>Height of the point that was asked for over the triangle's plane; negative behind it, m.</summary>
    public float Height;

    /// <summary>Finds the point of the surface that is nearest to a point.</summary>
    public MeshNearest(in Mesh mesh, Vector3 query)
    {
        this.mesh = mesh;
        this.query = query;
        var stack = stackalloc Entry[StackSize];
        stack[0] = default;
        for (int count = 1; count > 0;)
        {
            var entry = stack[--count];
            if (entry.SquaredDistance > Limit)
                continue;
            if (entry.Count > 0)
                TestLeaf(entry.Index, entry.Count);
            else
                Open(mesh.Header->Nodes + entry.Index, stack, ref count);
        }
    }

    readonly float Limit => squaredDistance + squaredDistance * Tie;

    // Pushes the children that may have something nearer, the nearest last.
    readonly void Open(MeshNode* node, Entry* stack, ref int count)
    {
        var bottom = count;
        for (int child = 0; child < MeshNode.Width; ++child)
        {
            var isNode = (node->NodeMask >> child & 1) != 0;
            var triangleCount = node->TriangleCount(child);
            if (!isNode && triangleCount == 0)
                continue;
            node->GetBounds(child, out var min, out var max);
            mesh.ApplyScale(ref min, ref max);
            var squared = Exact.LengthSquared(Exact.Max(Vector3.Zero, Exact.Max(min - query, query - max)));
            if (squared > Limit)
                continue;
            Check.That(count < StackSize);
            var place = count++;
            for (; place > bottom && stack[place - 1].SquaredDistance < squared; --place)
                stack[place] = stack[place - 1];
            stack[place] = new()
            {
                SquaredDistance = squared,
                Count = triangleCount,
                Index = isNode ? node->Node(child) : node->Place(child),
            };
        }
    }

    void TestLeaf(int place, int count)
    {
        for (int i = 0; i < count; ++i)
        {
            var number = mesh.Header->Triangles.GetNumber(place + i);
            mesh.GetChild(number, out var triangle);
            Vector3 a = triangle.A - query, b = triangle.B - query, c = triangle.C - query;
            var normal = Exact.Normalize(Exact.Cross(c - a, b - a));
            var height = -Exact.Dot(normal, a);
            // Seen from the point below or above it in the plane: a great height would leave nothing of what is across it.
            var foot = normal * -height;
            var offset = foot + NearestToOrigin(a - foot, b - foot, c - foot);
            var squared = Exact.LengthSquared(offset);
            if (squared > Limit)
                continue;
            if (squared + squared * Tie >= squaredDistance && MathF.Abs(height) <= MathF.Abs(Height))
                continue;
            squaredDistance = MathHelper.Min(squared, squaredDistance);
            Triangle = number;
            Normal = normal;
            Offset = offset;
            Height = height;
        }
    }

    /// <summary>The point of a triangle that is nearest to the origin.</summary>
    // Which corner, edge or face has it is a matter of signs: of the dot products of the edges with the ways from their ends to the origin, and of the
    // areas that the origin's projection makes with the edges (Ericson, Real-Time Collision Detection, 5.1.5).
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector3 NearestToOrigin(Vector3 a, Vector3 b, Vector3 c)
    {
        Vector3 ab = b - a, ac = c - a;
        float fromAToB = -Exact.Dot(ab, a), fromAToC = -Exact.Dot(ac, a);
        if (fromAToB <= 0 && fromAToC <= 0)
            return a;
        float fromBToB = -Exact.Dot(ab, b), fromBToC = -Exact.Dot(ac, b);
        if (fromBToB >= 0 && fromBToC <= fromBToB)
            return b;
        var areaC = fromAToB * fromBToC - fromBToB * fromAToC;
        if (fromAToB >= 0 && fromBToB <= 0 && areaC <= 0)
            return a + ab * (fromAToB / (fromAToB - fromBToB));
        float fromCToB = -Exact.Dot(ab, c), fromCToC = -Exact.Dot(ac, c);
        if (fromCToC >= 0 && fromCToB <= fromCToC)
            return c;
        var areaB = fromCToB * fromAToC - fromAToB * fromCToC;
        if (fromAToC >= 0 && fromCToC <= 0 && areaB <= 0)
            return a + ac * (fromAToC / (fromAToC - fromCToC));
        var areaA = fromBToB * fromCToC - fromCToB * fromBToC;
        float alongToC = fromBToC - fromBToB, alongToB = fromCToB - fromCToC;
        if (areaA <= 0 && alongToC >= 0 && alongToB >= 0)
            return b + (c - b) * (alongToC / (alongToC + alongToB));
        return a + (ab * areaB + ac * areaC) / (areaA + areaB + areaC);
    }
}
