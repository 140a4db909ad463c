using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Expands a convex shape and a container into pairs of the shape and each child that it may touch.</summary>
/// <typeparam name="TConvex">The convex shape.</typeparam>
/// <typeparam name="TConvexWide">Wide form of the convex shape.</typeparam>
/// <typeparam name="TContainer">The shape made of children; its type id is greater than that of the convex shape.</typeparam>
sealed unsafe class ConvexContainerTask<TConvex, TConvexWide, TContainer> : ExpandingTask<TConvex, TContainer>
    where TConvex : unmanaged, IConvexShape where TConvexWide : unmanaged, IShapeWide<TConvex> where TContainer : unmanaged, IContainer
{
    const int InitialCapacity = 64;

    // Behind the pairs is room for a child that is made on the way.
    internal override int BatchByteCount => ScratchStart + IContainer.ScratchByteCount;

    int ScratchStart => (base.BatchByteCount + 15) & ~15;

    internal override void FindChildren(in PairBatch batch, Shapes shapes, float dt, ref QuickList<FoundChild> found, BufferPool pool)
    {
        var children = new QuickList<int>(InitialCapacity, pool);
        if (TContainer.AsksTogether)
            FindTogether(batch, dt, JoinsChildren && typeof(TConvex) != typeof(Triangle), ref children, ref found, pool);
        else
            FindEach(batch, shapes, dt, ref children, ref found, pool);
        children.Dispose(pool);
    }

    static void FindEach(in PairBatch batch, Shapes shapes, float dt, ref QuickList<int> children, ref QuickList<FoundChild> found, BufferPool pool)
    {
        var entries = Entries(batch);
        var list = default(Buffer<NodeChild>);
        var listed = default(TypedIndex);
        for (int start = 0; start < batch.Count; start += Vector<float>.Count)
        {
            var count = Math.Min(Vector<float>.Count, batch.Count - start);
            FindBoxes(entries + start, count, dt, out var boxes);
            if (TContainer.IsList && IsOneList(entries + start, count))
            {
                List(entries[start], shapes, ref list, ref listed, pool);
                if (TryFindInList(entries, start, count, boxes, shapes, list.Memory, ref found, pool))
                    continue;
            }
            for (int i = 0; i < count; ++i)
            {
                ref var entry = ref entries[start + i];
                if (LeadsOut(entry, out var child))
                {
                    found.Add(new(start + i, Ids(entry.Pair, child)) { LeadsOut = true }, pool);
                    continue;
                }
                children.Count = 0;
                if (TContainer.IsList)
                    List(entry, shapes, ref list, ref listed, pool);
                var outline = default(ShapeOutline);
                if (TContainer.TakesOutlines)
                    Outline(entry.A, ref boxes, i, ref outline);
                entry.B.FindOverlaps(Read(ref boxes.Min, i), Read(ref boxes.Max, i), outline, shapes, list.Memory, ref children, pool);
                Add(start + i, entry.Pair, children.AsSpan(), false, ref found, pool);
            }
        }
        pool.ReturnIfTaken(ref list);
    }

    static bool IsOneList(Entry* entries, int count)
    {
        var name = NameOf(entries[0].Pair);
        var isOne = name.Exists;
        for (int i = 1; i < count; ++i)
            isOne &= NameOf(entries[i].Pair).Packed == name.Packed;
        return isOne;
    }

    // What touches one list asks each of its children together; for all else there is the list's own way.
    static bool TryFindInList(Entry* entries, int start, int count, in Boxes boxes, Shapes shapes, NodeChild* list, ref QuickList<FoundChild> found,
        BufferPool pool)
    {
        const int mostChildren = 64;
        var childCount = entries[start].B.FanOut(0, shapes);
        if (childCount > mostChildren)
            return false;
        var foundBy = stackalloc ulong[Vector<float>.Count];
        for (int i = 0; i < count; ++i)
            foundBy[i] = 0;
        for (int child = 0; child < childCount; ++child)
        {
            ref var node = ref list[child];
            if (node.Index >= 0)
                return false;
            Vector3Wide.Broadcast(node.Min, out var min);
            Vector3Wide.Broadcast(node.Max, out var max);
            var overlap = Vector.GreaterThanOrEqual(boxes.Max.X, min.X) & Vector.GreaterThanOrEqual(boxes.Max.Y, min.Y) &
                Vector.GreaterThanOrEqual(boxes.Max.Z, min.Z) & Vector.GreaterThanOrEqual(max.X, boxes.Min.X) &
                Vector.GreaterThanOrEqual(max.Y, boxes.Min.Y) & Vector.GreaterThanOrEqual(max.Z, boxes.Min.Z);
            for (var lanes = Wide.Bits(overlap) & ((1u << count) - 1); lanes != 0; lanes &= lanes - 1)
                foundBy[BitOperations.TrailingZeroCount(lanes)] |= 1ul << child;
        }
        for (int i = 0; i < count; ++i)
        {
            for (var children = foundBy[i]; children != 0; children &= children - 1)
            {
                // Field by field: what is made elsewhere first is copied as a whole.
                found.Allocate(pool) = new(start + i, Ids(entries[start + i].Pair, BitOperations.TrailingZeroCount(children)));
            }
        }
        return true;
    }

    // Who is inside of a solid asks nothing; a place in the order of the batch is kept for its way out.
    static void FindTogether(
        in PairBatch batch, float dt, bool leavesToNeighbours, ref QuickList<int> children, ref QuickList<FoundChild> found, BufferPool pool)
    {
        const int none = -1;
        var entries = Entries(batch);
        Span<ContainerQuestion> questions = stackalloc ContainerQuestion[PairBatch.Capacity];
        Span<int> waysOut = stackalloc int[PairBatch.Capacity];
        var questionCount = 0;
        for (int start = 0; start < batch.Count; start += Vector<float>.Count)
        {
            var count = Math.Min(Vector<float>.Count, batch.Count - start);
            FindBoxes(entries + start, count, dt, out var boxes);
            for (int i = 0; i < count; ++i)
            {
                ref var entry = ref entries[start + i];
                if (LeadsOut(entry, out waysOut[start + i]))
                    continue;
                waysOut[start + i] = none;
                ref var question = ref questions[questionCount++];
                question.Container = Unsafe.AsPointer(ref entry.B);
                question.Min = Read(ref boxes.Min, i);
                question.Max = Read(ref boxes.Max, i);
                Outline(entry.A, ref boxes, i, ref question.Outline);
                question.LeavesToNeighbours = leavesToNeighbours;
            }
        }
        TContainer.FindTogether(questions[..questionCount], ref children, pool);
        for (int i = 0, asked = 0, next = 0; i < batch.Count; ++i)
        {
            if (waysOut[i] != none)
            {
                found.Add(new(i, Ids(entries[i].Pair, waysOut[i])) { LeadsOut = true }, pool);
                continue;
            }
            ref var question = ref questions[asked++];
            var end = question.End;
            Add(i, entries[i].Pair, children.AsSpan()[next..end], question.LeavesToNeighbours, ref found, pool);
            next = end;
        }
    }

    static void Add(int parent, in ParentPair pair, Span<int> children, bool leavesToNeighbours, ref QuickList<FoundChild> found, BufferPool pool)
    {
        var first = found.Count;
        var hasOfNeighbours = false;
        foreach (int child in children)
        {
            var isOfNeighbour = child < 0;
            hasOfNeighbours |= isOfNeighbour;
            // Field by field: what is made elsewhere first is copied as a whole.
            ref var added = ref found.Allocate(pool);
            added.Write(parent, Ids(pair, isOfNeighbour ? ~child : child));
            added.IsOfNeighbour = isOfNeighbour;
            added.LeavesToNeighbours = leavesToNeighbours;
        }
        if (hasOfNeighbours)
            found[first].Touches = true;
    }

    static void Outline(TConvex convex, ref Boxes boxes, int lane, ref ShapeOutline outline)
    {
        ref var motion = ref boxes.Motion;
        var center = Read(ref motion.Position, lane);
        outline.Write(
            TConvex.TypeId, &convex, center, Lanes.Read<Quaternion, QuaternionWide>(ref motion.Orientation, lane), motion.Margin[lane]);
        if (!outline.IsKnown)
        {
            var (least, greatest) = (Read(ref boxes.Least, lane), Read(ref boxes.Greatest, lane));
            var middle = (least + greatest) * .5f;
            outline.Center = center + middle;
            outline.SetBox(Matrix3x3.Identity, greatest - middle);
        }
    }

    // A triangle has no middle: that of one which is a floor would be inside of whatever lies on it there.
    static bool LeadsOut(in Entry entry, out int child)
    {
        child = 0;
        if (!TContainer.MayBeSolid || typeof(TConvex) == typeof(Triangle) || !entry.B.IsSolid ||
            !WaysOut.Find(entry.Pair, entry.Pair.Flipped, entry.B, out var way))
            return false;
        child = way.Child;
        return true;
    }

    static ChildIds Ids(in ParentPair pair, int child) => pair.Flipped ? new(child, 0) : new(0, child);

    static TypedIndex NameOf(in ParentPair pair) => pair.Flipped ? pair.NameA : pair.NameB;

    // Measures the children of a container, unless they are those that were measured last.
    static void List(in Entry entry, Shapes shapes, ref Buffer<NodeChild> list, ref TypedIndex listed, BufferPool pool)
    {
        var name = NameOf(entry.Pair);
        if (name.Exists && name.Packed == listed.Packed)
            return;
        listed = name;
        ContainerPlaces.Open(entry.B, 0, shapes, ref list, pool);
    }

    // Shapes as they are, from their centres on; boxes around them and their places within the step; and where they are.
    struct Boxes
    {
        public Vector3Wide Least, Greatest, Min, Max;
        public RelativeMotionWide Motion;
    }

    static void FindBoxes(Entry* entries, int count, float dt, out Boxes boxes)
    {
        var parents = default(ParentMotionWide);
        var convex = default(TConvexWide);
        for (int i = 0; i < count; ++i)
        {
            parents.Write(entries[i].Pair, moverIsA: !entries[i].Pair.Flipped, i);
            Lanes.Write(entries[i].A, ref convex, i);
        }
        boxes.Motion = new RelativeMotionWide(parents, dt);
        convex.GetBounds(boxes.Motion.Orientation, out var maximumRadius, out var maximumAngularExpansion, out boxes.Least, out boxes.Greatest);
        (boxes.Min, boxes.Max) = (boxes.Least, boxes.Greatest);
        boxes.Motion.Widen(maximumRadius, maximumAngularExpansion, ref boxes.Min, ref boxes.Max);
    }

    static Vector3 Read(ref Vector3Wide wide, int lane) => Lanes.Read<Vector3, Vector3Wide>(ref wide, lane);

    internal override void GetChildren(in PairBatch batch, Shapes shapes, in FoundChild found, bool hasA, ref ChildShapes children)
    {
        ref var entry = ref Entries(batch)[found.Parent];
        if (found.LeadsOut)
        {
            SetWayOut(ref entry, batch.Bundles.Memory + ScratchStart, out children);
            return;
        }
        ContainerPlaces.Set(
            entry.Pair, containerIsA: entry.Pair.Flipped, entry.B, found.Children, TConvex.TypeId, Unsafe.AsPointer(ref entry.A), shapes,
            batch.Bundles.Memory + ScratchStart, out children);
    }

    static void SetWayOut(ref Entry entry, void* scratch, out ChildShapes children)
    {
        ref var pair = ref entry.Pair;
        ContainerPlaces.SetParents(pair, out children);
        ContainerPlaces.SetShape(ref children, isA: !pair.Flipped, TConvex.TypeId, Unsafe.AsPointer(ref entry.A));
        WaysOut.Find(pair, pair.Flipped, entry.B, out var way);
        WaysOut.Set(ref children, pair.Flipped, way, scratch);
    }
}
