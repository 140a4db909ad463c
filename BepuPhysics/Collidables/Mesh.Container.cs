using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

// A mesh as a container of triangles, which are made when they are asked for.
public unsafe partial struct Mesh : IContainer
{
    readonly int IContainer.FanOut(int node, Shapes shapes) => MeshNode.Width * MeshNode.LeafSize;

    // A leaf is opened together with its node: below a node there are nodes and triangles.
    readonly int IContainer.Open(int node, Shapes shapes, NodeChild* below)
    {
        var nodes = Header->Nodes;
        var count = 0;
        for (int child = 0; child < MeshNode.Width; ++child)
        {
            if ((nodes[node].NodeMask >> child & 1) != 0)
            {
                nodes[node].GetBounds(child, out var min, out var max);
                ApplyScale(ref min, ref max);
                var index = nodes[node].Node(child);
                below[count++] = new() { Min = min, Max = max, Index = index, LeafCount = MeshTree.CountTriangles(nodes, index) };
                continue;
            }
            var place = nodes[node].Place(child);
            for (int i = 0; i < nodes[node].TriangleCount(child); ++i)
            {
                var triangle = Header->Triangles.GetNumber(place + i);
                GetChild(triangle, out var corners);
                below[count++] = new()
                {
                    Min = Exact.Min(Exact.Min(corners.A, corners.B), corners.C),
                    Max = Exact.Max(Exact.Max(corners.A, corners.B), corners.C),
                    Index = ~triangle,
                    LeafCount = 1,
                };
            }
        }
        return count;
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
