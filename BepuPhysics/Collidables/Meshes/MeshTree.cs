using System;
using System.Numerics;
using System.Runtime.Intrinsics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Makes the tree of a mesh.</summary>
/// <remarks>
/// A binary tree over the triangles comes first. Then each node takes eight descendants as its children: two to begin with, and then,
/// as long as there is room, the one with the largest surface gives way to its own two (Ylitie, Karras, Laine, "Efficient Incoherent Ray
/// Traversal on GPUs Through Compressed Wide BVHs", 2017). What has no more triangles than a leaf may have becomes a leaf.
/// </remarks>
static unsafe class MeshTree
{
    /// <summary>Greatest number of nodes above each other: no more than of the binary tree.</summary>
    public const int MaximumHeight = Tree.MaximumHeight;

    /// <summary>Finds the nodes, without their boxes, and the order of the triangles.</summary>
    public static void Build(int* indices, int triangleCount, Vector3* vertices, int placedCount,
        ref QuickList<MeshNode> nodes, int* order, BufferPool pool, IThreadDispatcher? dispatcher)
    {
        pool.TakeAtLeast<BoundingBox>(placedCount, out var boxes);
        pool.TakeAtLeast<int>(placedCount, out var triangles);
        var count = 0;
        for (int triangle = 0; triangle < triangleCount; ++triangle)
        {
            var corners = indices + 3 * triangle;
            if (corners[0] < 0)
                continue;
            GetBounds(vertices[corners[0]], vertices[corners[1]], vertices[corners[2]], out boxes[count].Min, out boxes[count].Max);
            triangles[count++] = triangle;
        }
        var tree = new Tree(pool, placedCount);
        tree.BinnedBuild(boxes.AsSpan()[..placedCount], pool, dispatcher);
        pool.Return(ref boxes);
        Collapse(tree, triangles.Memory, ref nodes, order, pool);
        tree.Dispose(pool);
        pool.Return(ref triangles);
    }

    static void GetBounds(Vector3 a, Vector3 b, Vector3 c, out Vector3 min, out Vector3 max)
    {
        Vector128<float> x = a.AsVector128(), y = b.AsVector128(), z = c.AsVector128();
        min = BoxMath.Min(BoxMath.Min(x, y), z).AsVector3();
        max = BoxMath.Max(BoxMath.Max(x, y), z).AsVector3();
    }

    /// <summary>The two children of a node of the binary tree that are still to become a node of eight.</summary>
    struct Pending
    {
        public NodeChild* Children;
        public int Node;
    }

    static void Collapse(in Tree tree, int* triangles, ref QuickList<MeshNode> nodes, int* order, BufferPool pool)
    {
        // Of each level at most seven wait while the first goes on.
        var stack = stackalloc Pending[MeshNode.Width * MaximumHeight];
        var stackCount = 0;
        var places = 0;
        nodes.Allocate(pool) = default;
        stack[stackCount++] = new() { Children = tree.Children };
        var chosen = stackalloc NodeChild*[MeshNode.Width];
        while (stackCount > 0)
        {
            var pending = stack[--stackCount];
            var count = Choose(tree, pending.Children, chosen);
            var nodeMask = 0;
            var counts = 0ul;
            var firstPlace = places;
            for (int i = 0; i < count; ++i)
            {
                if (chosen[i]->LeafCount > MeshNode.LeafSize)
                {
                    nodeMask |= 1 << i;
                    continue;
                }
                counts |= (ulong)chosen[i]->LeafCount << (8 * i);
                Place(tree, chosen[i], triangles, order, ref places);
            }
            var firstNode = nodes.Count;
            for (int i = 0; i < count; ++i)
            {
                if ((nodeMask >> i & 1) != 0)
                    nodes.Allocate(pool) = default;
            }
            // The first is the next to be taken.
            for (int i = count - 1, node = nodes.Count; i >= 0; --i)
            {
                if ((nodeMask >> i & 1) != 0)
                    stack[stackCount++] = new() { Children = tree.Children + 2 * chosen[i]->Index, Node = --node };
            }
            ref var target = ref nodes[pending.Node];
            target.SetChildren(nodeMask, counts);
            target.FirstNode = firstNode;
            target.FirstPlace = firstPlace;
        }
    }

    static int Choose(in Tree tree, NodeChild* pair, NodeChild** chosen)
    {
        chosen[0] = pair;
        chosen[1] = pair + 1;
        // The second side of a tree with a single leaf is nothing.
        var count = pair[1].LeafCount == 0 ? 1 : 2;
        while (count < MeshNode.Width)
        {
            var best = ChooseNext(chosen, count);
            if (best < 0)
                break;
            var children = tree.Children + 2 * chosen[best]->Index;
            for (int i = count; i > best + 1; --i)
                chosen[i] = chosen[i - 1];
            chosen[best] = children;
            chosen[best + 1] = children + 1;
            ++count;
        }
        return count;
    }

    // The one to give way: the largest, but one that would be a node of few children before that.
    static int ChooseNext(NodeChild** chosen, int count)
    {
        var best = -1;
        var bestArea = -1f;
        var bestIsSmall = false;
        for (int i = 0; i < count; ++i)
        {
            var leafCount = chosen[i]->LeafCount;
            if (leafCount <= MeshNode.LeafSize)
                continue;
            // Two leaves take one place more here, and a whole node of their own otherwise.
            var isSmall = leafCount <= 2 * MeshNode.LeafSize;
            var area = BoxMath.HalfArea(chosen[i]);
            // Where sizes are beyond the range of floats areas may be no numbers: any choice is good.
            if (best >= 0 && (bestIsSmall == isSmall ? !(area > bestArea) : bestIsSmall))
                continue;
            best = i;
            bestArea = area;
            bestIsSmall = isSmall;
        }
        return best;
    }

    static void Place(in Tree tree, NodeChild* child, int* triangles, int* order, ref int places)
    {
        if (child->Index < 0)
        {
            order[places++] = triangles[~child->Index];
            return;
        }
        var children = tree.Children + 2 * child->Index;
        Place(tree, children, triangles, order, ref places);
        Place(tree, children + 1, triangles, order, ref places);
    }

    /// <summary>Number of triangles below a node.</summary>
    // Those of a node's leaves come first, then those below its nodes one after the other: the last ones end where those below it end.
    public static int CountTriangles(MeshNode* nodes, int node)
    {
        var last = nodes + node;
        while (last->NodeMask != 0)
            last = nodes + last->FirstNode + BitOperations.PopCount((uint)last->NodeMask) - 1;
        return last->FirstPlace + last->TotalTriangleCount - nodes[node].FirstPlace;
    }

    /// <summary>Writes the boxes of all nodes around the vertices as they are.</summary>
    public static void Refit(MeshHeader* mesh) => Refit(mesh, 0, out mesh->Min, out mesh->Max);

    // Exact boxes go up, so that those which are kept are rounded once.
    static void Refit(MeshHeader* mesh, int nodeIndex, out Vector3 min, out Vector3 max)
    {
        var node = mesh->Nodes + nodeIndex;
        Span<Vector3> mins = stackalloc Vector3[MeshNode.Width];
        Span<Vector3> maxes = stackalloc Vector3[MeshNode.Width];
        min = new(float.MaxValue);
        max = new(-float.MaxValue);
        var count = 0;
        for (; count < MeshNode.Width; ++count)
        {
            if ((node->NodeMask >> count & 1) != 0)
                Refit(mesh, node->Node(count), out mins[count], out maxes[count]);
            else if (node->TriangleCount(count) > 0)
                GetLeafBounds(mesh, node, count, out mins[count], out maxes[count]);
            else
                break;
            min = Exact.Min(min, mins[count]);
            max = Exact.Max(max, maxes[count]);
        }
        node->SetBounds(mins[..count], maxes[..count]);
    }

    static void GetLeafBounds(MeshHeader* mesh, MeshNode* node, int child, out Vector3 min, out Vector3 max)
    {
        var place = node->Place(child);
        min = new(float.MaxValue);
        max = new(-float.MaxValue);
        for (int i = 0; i < node->TriangleCount(child); ++i)
        {
            mesh->GetCornersAt(place + i, out var a, out var b, out var c);
            GetBounds(a, b, c, out var low, out var high);
            min = Exact.Min(min, low);
            max = Exact.Max(max, high);
        }
    }
}
