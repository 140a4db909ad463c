using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

// A mesh as a container of triangles, which are made when they are asked for.
public unsafe partial struct Mesh : IContainer
{
    readonly int IContainer.FanOut(int node, Shapes shapes) => MeshNode.Width * MeshNode.LeafSize;

    // A leaf is opened together with its node: below a node there are nodes and triangles.
    readonly int IContainer.Open(int node, Shapes shapes, NodeChild* below)
    {
        ref readonly var opened = ref Header->Nodes[node];
        var count = 0;
        for (int child = 0; child < MeshNode.Width; ++child)
        {
            if ((opened.NodeMask >> child & 1) != 0)
            {
                opened.GetBounds(child, out var min, out var max);
                ApplyScale(ref min, ref max);
                below[count++] = new() { Min = min, Max = max, Index = opened.Node(child) };
                continue;
            }
            var place = opened.Place(child);
            for (int i = 0; i < opened.TriangleCount(child); ++i)
            {
                GetChildAt(place + i, out var corners);
                below[count++] = new()
                {
                    Min = Exact.Min(Exact.Min(corners.A, corners.B), corners.C),
                    Max = Exact.Max(Exact.Max(corners.A, corners.B), corners.C),
                    Index = ~Header->Triangles.GetNumber(place + i),
                    LeafCount = 1,
                };
            }
        }
        if (opened.NodeMask != 0)
            CountBelow(below, count);
        return count;
    }

    // What is below a node begins where that below the one before it ends.
    readonly void CountBelow(NodeChild* below, int count)
    {
        var nodes = Header->Nodes;
        var end = -1;
        for (int i = count - 1; i >= 0; --i)
        {
            var node = below[i].Index;
            if (node < 0)
                continue;
            var start = nodes[node].FirstPlace;
            below[i].LeafCount = end < 0 ? MeshTree.CountTriangles(nodes, node) : end - start;
            Check.That(below[i].LeafCount == MeshTree.CountTriangles(nodes, node));
            end = start;
        }
    }

    static bool IContainer.IsList => false;

    static bool IContainer.IsSurface => true;

    // What is found is asked for by its number soon; its corners were just looked at.
    readonly void IContainer.FindOverlaps(Vector3 min, Vector3 max, Shapes shapes, NodeChild* list, ref QuickList<int> found, BufferPool pool)
    {
        FindLocalOverlaps(min, max, ref found, pool);
        for (int i = 0; i < found.Count; ++i)
            Header->Prefetch(found[i]);
    }

    readonly void IContainer.GetChild(int index, Shapes shapes, void* scratch, out ContainerChild child)
    {
        GetCenteredChild(index, out *(Triangle*)scratch, out var center);
        child = new() { TypeId = Triangle.TypeId, Shape = scratch, Pose = new(center) };
        GetCone(index, out child.Cone);
    }
}
