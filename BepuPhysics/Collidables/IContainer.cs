using System;
using System.Diagnostics;
using System.Numerics;
using BepuPhysics.Trees;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>A convex child of a container, and where it is.</summary>
unsafe struct ContainerChild
{
    /// <summary>Type id of the child.</summary>
    public int TypeId;
    /// <summary>The child: a shape of a batch, or in the scratch memory that the container was given.</summary>
    public void* Shape;
    /// <summary>By what histories know the child; none for a child that is only known as a part of its container.</summary>
    public TypedIndex Name;
    /// <summary>Pose of the child's centre in the frame of the container.</summary>
    public RigidPose Pose;
    /// <summary>What is next to a triangle of a surface; nothing for all else.</summary>
    public TriangleCone Cone;
}

/// <summary>How something that is inside of a container gets out, in the container's frame.</summary>
struct WayOut
{
    /// <summary>The child that is passed.</summary>
    public int Child;
    /// <summary>Unit direction in which to go.</summary>
    public Vector3 Normal;
    /// <summary>Point of the surface that is passed.</summary>
    public Vector3 Place;
}

/// <summary>A box that a container is asked about together with others.</summary>
unsafe struct ContainerQuestion
{
    /// <summary>The container.</summary>
    public void* Container;
    /// <summary>Corners of the box in the container's frame.</summary>
    public Vector3 Min, Max;
    /// <summary>What the box is around.</summary>
    public ShapeOutline Outline;
    /// <summary>Of what was found, the end.</summary>
    public int End;
    /// <summary>
    /// Whether triangles may be left out that are near only where a neighbour is (<see cref="OutlineSides"/>): those of a surface agree on that, but two
    /// triangles may hold each other there. Then, whether there were such.
    /// </summary>
    public bool LeavesToNeighbours;
}

/// <summary>A shape made of convex children, numbered from zero, in a tree or in a list.</summary>
/// <remarks>
/// Children are found by boxes in the container's own frame. Everything that is found may be wider than it need be, never narrower. It must
/// depend on nothing but container and box: not on the width of vectors, nor on how often or by whom it was asked.
/// What is made of containers itself shows the children of these as its own (<see cref="ContainerChildren"/>): nobody else knows of it.
/// </remarks>
unsafe interface IContainer : IShape
{
    /// <summary>Size of the scratch memory that a child may be written to, bytes.</summary>
    const int ScratchByteCount = 128;

    /// <summary>Whether the children are in a list. Their boxes are then measured once for all that may touch it, one after the other.</summary>
    static abstract bool IsList { get; }

    /// <summary>
    /// Whether there are nodes. Of a container without any, children are found by boxes alone: <see cref="Open"/> then writes one box around all of
    /// them, which is not opened any further.
    /// </summary>
    static virtual bool HasNodes => true;

    /// <summary>Number of children: their numbers are below it. So are the indices of nodes, of which there are no more.</summary>
    int ChildCount { get; }

    /// <summary>Greatest number of nodes that <see cref="Open"/> writes for a node.</summary>
    /// <param name="node">Index of the node.</param>
    /// <param name="shapes">Shapes that children refer to.</param>
    int FanOut(int node, Shapes shapes);

    /// <summary>Writes the nodes below a node. Number 0 is the root, whether there is a tree or not: a list has all children below it.</summary>
    /// <param name="node">Index of the node.</param>
    /// <param name="shapes">Shapes that children refer to.</param>
    /// <param name="below">
    /// Receives boxes in the container's frame. As in a <see cref="Tree"/>, an index is that of a node below or, for a child, its
    /// complement; a leaf count tells which of two nodes is the larger one.
    /// </param>
    /// <returns>Number of nodes that were written; zero for a container without children.</returns>
    int Open(int node, Shapes shapes, NodeChild* below);

    /// <summary>Finds the children whose boxes overlap or touch a box, each once, in any fixed order.</summary>
    /// <param name="min">Lower corner in the container's frame, m.</param>
    /// <param name="max">Upper corner, nowhere below the lower.</param>
    /// <param name="outline">What the box is around: children beyond it may be left out, but none that it may have been pressed through.</param>
    /// <param name="shapes">Shapes that children refer to.</param>
    /// <param name="list">Of a list, what <see cref="Open"/> writes for its root.</param>
    /// <param name="found">
    /// Receives the numbers of the children, behind those that are in it. Of those that the shape touches beyond a neighbour only it may receive complements:
    /// the first one is touched for sure then, by itself, and the others have no contacts as long as that has.
    /// </param>
    /// <param name="pool">Source of the list's memory, and of temporary memory.</param>
    void FindOverlaps(Vector3 min, Vector3 max, in ShapeOutline outline, Shapes shapes, NodeChild* list, ref QuickList<int> found, BufferPool pool);

    /// <summary>Whether it is of use to say what a box is around.</summary>
    static virtual bool TakesOutlines => false;

    /// <summary>Whether it is of use to ask several containers at once.</summary>
    static virtual bool AsksTogether => false;

    /// <summary>Finds the children of several containers of this type as <see cref="FindOverlaps"/> does; of those that ask together.</summary>
    /// <param name="questions">The questions; each receives where in the list its children end.</param>
    /// <param name="found">Receives the numbers of the children, those of each question behind those of the one before.</param>
    /// <param name="pool">Source of the list's memory.</param>
    static virtual void FindTogether(Span<ContainerQuestion> questions, ref QuickList<int> found, BufferPool pool) => throw new UnreachableException();

    /// <summary>Whether the children are triangles of a surface, not bodies with a middle.</summary>
    static virtual bool IsSurface => false;

    /// <summary>Whether there are containers of this type which are solid. Of others neither of the next two is asked for.</summary>
    static virtual bool MayBeSolid => false;

    /// <summary>Whether what is inside is pushed out; of surfaces only.</summary>
    bool IsSolid => false;

    /// <summary>Finds the nearest way out for a point inside of a container that is solid.</summary>
    /// <param name="point">The point in the container's frame.</param>
    /// <param name="way">The way out.</param>
    /// <returns>Whether the point is inside.</returns>
    bool FindWayOut(Vector3 point, out WayOut way)
    {
        way = default;
        return false;
    }

    /// <summary>Box around a child, its centre at the origin; of containers without nodes only.</summary>
    /// <param name="child">The child, as it was got.</param>
    /// <param name="min">Lower corner in the container's frame, m.</param>
    /// <param name="max">Upper corner, m.</param>
    static virtual void ComputeChildBounds(in ContainerChild child, out Vector3 min, out Vector3 max) => throw new UnreachableException();

    /// <summary>Gets a child.</summary>
    /// <param name="index">Number of the child.</param>
    /// <param name="shapes">Shapes that children refer to.</param>
    /// <param name="scratch">
    /// <see cref="ScratchByteCount"/> bytes, aligned to 16, for a child that is made on the way. It stays until the next is asked for.
    /// </param>
    /// <param name="child">The child.</param>
    void GetChild(int index, Shapes shapes, void* scratch, out ContainerChild child);
}
