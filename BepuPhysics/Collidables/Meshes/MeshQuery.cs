using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities.Collections;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Finds the triangles of a mesh whose boxes meet a box.</summary>
static unsafe class MeshQuery
{
    /// <summary>Children of a node that are still to be looked at.</summary>
    struct Entry
    {
        public MeshNode* Node;
        public int Mask;
    }

    /// <summary>Appends the triangles, in the order of the tree.</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="min">Least corner of the box, before scaling.</param>
    /// <param name="max">Greatest corner of the box, before scaling.</param>
    /// <param name="found">Receives the places of the triangles.</param>
    /// <param name="pool">Source of the list's memory.</param>
    public static void FindPlaces(MeshHeader* mesh, Vector3 min, Vector3 max, ref QuickList<int> found, BufferPool pool) =>
        FindPlaces(mesh, min.AsVector128(), max.AsVector128(), ref found, pool);

    /// <summary>Appends the triangles, in the order of the tree; the fourth lanes of corners say nothing.</summary>
    public static void FindPlaces(MeshHeader* mesh, Vector128<float> low, Vector128<float> high, ref QuickList<int> found, BufferPool pool)
    {
        var stack = stackalloc Entry[MeshTree.MaximumHeight];
        var nodes = mesh->Nodes;
        var stackCount = 0;
        var node = nodes;
        while (true)
        {
            var mask = MeshNode.FindOverlaps(node, low, high);
            for (var leaves = mask & ~node->NodeMask; leaves != 0; leaves &= leaves - 1)
            {
                var leaf = BitOperations.TrailingZeroCount(leaves);
                var count = node->TriangleCount(leaf);
                found.EnsureCapacity(found.Count + MeshNode.LeafSize, pool);
                FindInLeaf(mesh, node->Place(leaf), count, low, high, ref found);
            }
            mask &= node->NodeMask;
            if (mask == 0)
            {
                if (--stackCount < 0)
                    return;
                node = stack[stackCount].Node;
                mask = stack[stackCount].Mask;
            }
            var next = nodes + node->Node(BitOperations.TrailingZeroCount(mask));
            mask &= mask - 1;
            if (mask != 0)
            {
                Check.That(stackCount < MeshTree.MaximumHeight);
                stack[stackCount].Node = node;
                stack[stackCount++].Mask = mask;
            }
            node = next;
        }
    }

    /// <summary>Appends the triangles of a leaf. There is room for them.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void FindInLeaf(MeshHeader* mesh, int place, int count, Vector128<float> low, Vector128<float> high, ref QuickList<int> found)
    {
        var triangles = mesh->Triangles;
        var vertices = (float*)mesh->Vertices;
        var target = found.Span.Memory + found.Count;
        for (int i = 0; i < count; ++i)
        {
            var triangle = triangles.Get(place + i);
            var a = Vector128.Load(vertices + 3 * triangle.A);
            var b = Vector128.Load(vertices + 3 * triangle.B);
            var c = Vector128.Load(vertices + 3 * triangle.C);
            // Apart on an axis where all three corners are on one side.
            var separate = (Vector128.GreaterThan(a, high) & Vector128.GreaterThan(b, high) & Vector128.GreaterThan(c, high)) |
                (Vector128.LessThan(a, low) & Vector128.LessThan(b, low) & Vector128.LessThan(c, low));
            // Written in any case and counted if it is one: whether it is is a coin toss to the branch predictor.
            *target = place + i;
            target += (separate.ExtractMostSignificantBits() & 7) == 0 ? 1 : 0;
        }
        found.Count = (int)(target - found.Span.Memory);
    }
}
