using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
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

    static bool IContainer.TakesOutlines => true;

    static bool IContainer.AsksTogether => true;

    readonly void IContainer.FindOverlaps(
        Vector3 min, Vector3 max, in ShapeOutline outline, Shapes shapes, NodeChild* list, ref QuickList<int> found, BufferPool pool) =>
        Find(min, max, outline, false, ref found, pool);

    readonly bool Find(Vector3 min, Vector3 max, in ShapeOutline outline, bool leavesToNeighbours, ref QuickList<int> found, BufferPool pool)
    {
        var first = found.Count;
        FindPlaces(min, max, ref found, pool);
        return Take(outline, leavesToNeighbours, ref found, first);
    }

    static void IContainer.FindTogether(Span<ContainerQuestion> questions, ref QuickList<int> found, BufferPool pool)
    {
        if (questions.Length == 1)
        {
            ref var question = ref questions[0];
            question.LeavesToNeighbours = ((Mesh*)question.Container)->Find(
                question.Min, question.Max, question.Outline, question.LeavesToNeighbours, ref found, pool);
            question.End = found.Count;
            return;
        }
        Unsafe.SkipInit(out MeshQueries queries);
        for (int start = 0; start < questions.Length; start += MeshQueries.Capacity)
        {
            var asked = questions.Slice(start, Math.Min(MeshQueries.Capacity, questions.Length - start));
            queries.Clear();
            foreach (ref var question in asked)
            {
                var mesh = (Mesh*)question.Container;
                mesh->ToVertices(ref question.Min, ref question.Max);
                queries.Add(mesh->Header, question.Min, question.Max);
            }
            queries.Descend();
            for (int i = 0; i < asked.Length; ++i)
            {
                var first = found.Count;
                queries.FindPlaces(i, ref found, pool);
                asked[i].LeavesToNeighbours = ((Mesh*)asked[i].Container)->Take(
                    asked[i].Outline, asked[i].LeavesToNeighbours, ref found, first);
                asked[i].End = found.Count;
            }
        }
    }

    // Of places in the tree, those of triangles that a shape is beside or in front of, or that are near it only where a neighbour is. Returns whether there are
    // such as the last.
    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly bool LeaveOut(in ShapeOutline outline, bool leavesToNeighbours, ref QuickList<int> found, int first)
    {
        var sides = new OutlineSides(outline, IsMirrored);
        var knowsNeighbours = leavesToNeighbours && KnowsNeighbours;
        var places = found.Span.Memory;
        var count = first;
        leavesToNeighbours = false;
        for (int i = first; i < found.Count; ++i)
        {
            var side = sides.Find(CornersAt(places[i]), out var beyond);
            if (side == OutlineSide.IsBeyondEdge && knowsNeighbours)
            {
                GetCone(Header->Triangles.GetNumber(places[i]), out var cone);
                if (sides.IsOfNeighbour(beyond, cone))
                {
                    side = OutlineSide.IsApart;
                    leavesToNeighbours = true;
                }
            }
            places[count] = places[i];
            count += side == OutlineSide.IsApart ? 0 : 1;
        }
        found.Count = count;
        return leavesToNeighbours;
    }

    // A, B, C and A of the triangle at a place.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly OutlineSides.Lanes CornersAt(int place)
    {
        var triangle = Header->Triangles.Get(place);
        var vertices = Header->Vertices;
        var a = (float*)(vertices + triangle.A);
        var b = (float*)(vertices + triangle.B);
        var c = (float*)(vertices + triangle.C);
        return new(
            Vector128.Create(a[0], b[0], c[0], a[0]) * Vector128.Create(scale.X),
            Vector128.Create(a[1], b[1], c[1], a[1]) * Vector128.Create(scale.Y),
            Vector128.Create(a[2], b[2], c[2], a[2]) * Vector128.Create(scale.Z));
    }

    // Of numbers of triangles that a ball touches beyond a neighbour only, the complements, if it touches another for sure: that one is the first then.
    [MethodImpl(MethodImplOptions.NoInlining)]
    readonly void MarkOfNeighbours(in ShapeOutline ball, ref QuickList<int> found, int first)
    {
        var sides = new BallSides(ball);
        var touched = -1;
        for (int i = first; i < found.Count; ++i)
        {
            GetCone(found[i], out var cone);
            var side = sides.Find(CornersAt(Header->GetPlace(found[i])), cone);
            if (side == BallSide.IsOfNeighbour)
                found[i] = ~found[i];
            else if (side == BallSide.Touches)
                touched = i;
        }
        if (touched >= 0)
        {
            (found[first], found[touched]) = (found[touched], found[first]);
            return;
        }
        for (int i = first; i < found.Count; ++i)
            found[i] = Math.Max(found[i], ~found[i]);
    }

    // Of places in the tree to numbers. What is found is asked for by its number soon; its corners were just looked at. Returns whether triangles are left out
    // of which what is near is a neighbour's.
    readonly bool Take(in ShapeOutline outline, bool leavesToNeighbours, ref QuickList<int> found, int first)
    {
        leavesToNeighbours = outline.IsKnown && LeaveOut(outline, leavesToNeighbours, ref found, first);
        for (int i = first; i < found.Count; ++i)
        {
            found[i] = Header->Triangles.GetNumber(found[i]);
            Header->Prefetch(found[i]);
        }
        if (outline.IsBall && found.Count - first > 1 && KnowsNeighbours)
            MarkOfNeighbours(outline, ref found, first);
        return leavesToNeighbours;
    }

    readonly void IContainer.GetChild(int index, Shapes shapes, void* scratch, out ContainerChild child)
    {
        Unsafe.SkipInit(out child);
        // Field by field: what is made elsewhere first is copied as a whole, and waits for its parts.
        GetCenteredChild(index, out *(Triangle*)scratch, out child.Pose.Position);
        child.Pose.Orientation = Quaternion.Identity;
        child.TypeId = Triangle.TypeId;
        child.Shape = scratch;
        child.Name = default;
        GetCone(index, out child.Cone);
    }
}
