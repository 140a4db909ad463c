using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Finds the triangles of meshes whose boxes meet a box, for several boxes at once.</summary>
/// <remarks>
/// A box that is alone waits for memory at every node on its way, then for the triangles, and for their corners. So nodes are looked at in the order in which
/// they were met, of all boxes in one queue: each is asked for when it is met, and the others are looked at until it is there.
/// </remarks>
unsafe ref struct MeshQueries
{
    /// <summary>Greatest number of boxes.</summary>
    public const int Capacity = 8;

    // Boxes that meet more are looked at one by one.
    const int VisitCapacity = 256, LeafCapacity = 128;
    const int None = -1;

    struct Box
    {
        public Vector128<float> Min, Max;
        public MeshHeader* Mesh;
        // Leaves are in a list, in the order in which they were met.
        public int FirstLeaf, LastLeaf;
        public bool HasNoRoom;
    }

    readonly record struct Visit(int Node, int Box);

    struct Leaf
    {
        public int Place, Count, Next;
    }

    [InlineArray(Capacity)]
    struct Boxes
    {
        Box first;
    }

    [InlineArray(VisitCapacity)]
    struct Visits
    {
        Visit first;
    }

    [InlineArray(LeafCapacity)]
    struct Leaves
    {
        Leaf first;
    }

    Boxes boxes;
    Visits visits;
    Leaves leaves;
    int boxCount, visitCount, leafCount;

    /// <summary>Forgets all boxes.</summary>
    public void Clear() => boxCount = visitCount = leafCount = 0;

    /// <summary>Adds a box; there is room for it.</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="min">Least corner of the box, before scaling.</param>
    /// <param name="max">Greatest corner of the box, before scaling.</param>
    public void Add(MeshHeader* mesh, Vector3 min, Vector3 max)
    {
        ref var box = ref boxes[boxCount];
        box.Min = min.AsVector128();
        box.Max = max.AsVector128();
        box.Mesh = mesh;
        box.FirstLeaf = box.LastLeaf = None;
        box.HasNoRoom = false;
        visits[visitCount++] = new(0, boxCount++);
    }

    /// <summary>Goes down the trees of all boxes.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public void Descend()
    {
        for (int i = 0; i < visitCount; ++i)
        {
            var visit = visits[i];
            ref var box = ref boxes[visit.Box];
            var nodes = box.Mesh->Nodes;
            var node = nodes + visit.Node;
            var mask = MeshNode.FindOverlaps(node, box.Min, box.Max);
            for (var met = mask & ~node->NodeMask; met != 0; met &= met - 1)
                AddLeaf(ref box, node, BitOperations.TrailingZeroCount(met));
            for (var met = mask & node->NodeMask; met != 0; met &= met - 1)
            {
                var next = node->Node(BitOperations.TrailingZeroCount(met));
                if (visitCount == VisitCapacity)
                {
                    box.HasNoRoom = true;
                    break;
                }
                Prefetch.Read(nodes + next);
                Prefetch.Read((byte*)(nodes + next + 1) - 1);
                visits[visitCount++] = new(next, visit.Box);
            }
        }
        PrefetchCorners();
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    void AddLeaf(ref Box box, MeshNode* node, int child)
    {
        var count = node->TriangleCount(child);
        if (count == 0)
            return;
        if (leafCount == LeafCapacity)
        {
            box.HasNoRoom = true;
            return;
        }
        ref var leaf = ref leaves[leafCount];
        leaf.Place = node->Place(child);
        leaf.Count = count;
        leaf.Next = None;
        box.Mesh->Triangles.Prefetch(leaf.Place, count);
        if (box.LastLeaf == None)
            box.FirstLeaf = leafCount;
        else
            leaves[box.LastLeaf].Next = leafCount;
        box.LastLeaf = leafCount++;
    }

    void PrefetchCorners()
    {
        for (int i = 0; i < boxCount; ++i)
        {
            var mesh = boxes[i].Mesh;
            var triangles = mesh->Triangles;
            var vertices = mesh->Vertices;
            for (int leaf = boxes[i].FirstLeaf; leaf != None; leaf = leaves[leaf].Next)
            {
                var place = leaves[leaf].Place;
                for (int end = place + leaves[leaf].Count; place < end; ++place)
                {
                    var triangle = triangles.Get(place);
                    Prefetch.Read(vertices + triangle.A);
                    Prefetch.Read(vertices + triangle.B);
                    Prefetch.Read(vertices + triangle.C);
                }
            }
        }
    }

    /// <summary>Appends the triangles that one of the boxes meets, once <see cref="Descend"/> was called.</summary>
    /// <param name="index">Number of the box, in the order in which they were added.</param>
    /// <param name="found">Receives the places of the triangles.</param>
    /// <param name="pool">Source of the list's memory.</param>
    public void FindPlaces(int index, ref QuickList<int> found, BufferPool pool)
    {
        ref var box = ref boxes[index];
        if (box.HasNoRoom)
        {
            MeshQuery.FindPlaces(box.Mesh, box.Min, box.Max, ref found, pool);
            return;
        }
        for (int leaf = box.FirstLeaf; leaf != None; leaf = leaves[leaf].Next)
        {
            found.EnsureCapacity(found.Count + MeshNode.LeafSize, pool);
            MeshQuery.FindInLeaf(box.Mesh, leaves[leaf].Place, leaves[leaf].Count, box.Min, box.Max, ref found);
        }
    }
}
