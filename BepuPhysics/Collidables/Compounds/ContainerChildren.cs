using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Trees;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>Children of a compound that are made of children themselves: it shows what they are made of, its pieces, as if it were its own.</summary>
/// <remarks>
/// A convex child is a piece and has its own number. Pieces of other children, and their nodes, have numbers behind those of all children and of the
/// compound's own nodes (<see cref="PieceNumbers"/>).
/// </remarks>
static unsafe class ContainerChildren
{
    /// <summary>Whether shapes of a type are made of children.</summary>
    public static bool IsContainer(int typeId) => typeId is Compound.Id or BigCompound.Id or Mesh.Id or HeightField.Id;

    /// <summary>Whether a child is made of children.</summary>
    public static bool IsContainer(in CompoundChild child) => IsContainer(child.ShapeIndex.Type);

    /// <summary>Numbers of the pieces of children.</summary>
    public static PieceNumbers Pieces(Buffer<CompoundChild> children) => new(children.Length, children.Length);

    static PieceNumbers Nodes(Buffer<CompoundChild> children, int ownNodeCount) => new(ownNodeCount, children.Length);

    static IContainerBatch BatchOf(in CompoundChild child, Shapes shapes) => (IContainerBatch)shapes.GetBatch(child.ShapeIndex.Type);

    /// <summary>Makes a node of a leaf that is such a child: of the root of the child.</summary>
    public static void Mark(Buffer<CompoundChild> children, int ownNodeCount, Shapes shapes, ref NodeChild node)
    {
        ref var child = ref children[~node.Index];
        if (!IsContainer(child))
            return;
        node.LeafCount = BatchOf(child, shapes).ChildCount(child.ShapeIndex.Index);
        node.Index = Nodes(children, ownNodeCount).Of(~node.Index, 0);
    }

    /// <summary>Greatest number of nodes below a node of a child.</summary>
    public static int FanOut(Buffer<CompoundChild> children, int ownNodeCount, int node, Shapes shapes)
    {
        var (number, inner) = Nodes(children, ownNodeCount).Find(node);
        ref var child = ref children[number];
        return BatchOf(child, shapes).FanOut(child.ShapeIndex.Index, inner);
    }

    /// <summary>Writes the nodes below a node of a child, in the frame of the compound.</summary>
    public static int Open(Buffer<CompoundChild> children, int ownNodeCount, int node, Shapes shapes, NodeChild* below)
    {
        var nodes = Nodes(children, ownNodeCount);
        var pieces = Pieces(children);
        var (number, inner) = nodes.Find(node);
        ref var child = ref children[number];
        var frame = new ChildFrame(child);
        var count = BatchOf(child, shapes).Open(child.ShapeIndex.Index, inner, below);
        for (int i = 0; i < count; ++i)
        {
            frame.ToCompound(ref below[i]);
            below[i].Index = below[i].Index < 0 ? ~pieces.Of(number, ~below[i].Index) : nodes.Of(number, below[i].Index);
        }
        return count;
    }

    /// <summary>Finds the pieces of a child whose boxes overlap or touch a box in the frame of the compound.</summary>
    public static void FindOverlaps(
        Buffer<CompoundChild> children, int number, Vector3 min, Vector3 max, Shapes shapes, ref QuickList<int> found, BufferPool pool)
    {
        ref var child = ref children[number];
        var pieces = Pieces(children);
        new ChildFrame(child).ToChild(ref min, ref max);
        int first = found.Count;
        BatchOf(child, shapes).FindOverlaps(child.ShapeIndex.Index, min, max, ref found, pool);
        for (int i = first; i < found.Count; ++i)
            found[i] = pieces.Of(number, found[i]);
    }

    /// <summary>Gets a piece.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static void Get(Buffer<CompoundChild> children, int index, Shapes shapes, void* scratch, out ContainerChild result)
    {
        if (index < children.Length)
            CompoundChildren.Get(children, index, shapes, out result);
        else
            GetInner(children, index, shapes, scratch, out result);
    }

    // A piece of a child.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void GetInner(Buffer<CompoundChild> children, int index, Shapes shapes, void* scratch, out ContainerChild result)
    {
        var (number, inner) = Pieces(children).Find(index);
        ref var child = ref children[number];
        BatchOf(child, shapes).GetChild(child.ShapeIndex.Index, inner, scratch, out result);
        result.Pose = new(
            child.LocalPosition + Exact.Rotate(result.Pose.Position, child.LocalOrientation),
            Exact.Concatenate(result.Pose.Orientation, child.LocalOrientation));
        if (!result.Name.Exists)
            result.Name = child.ShapeIndex;
    }
}
