using System;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>The shapes that bodies and statics use, each at least once; one that several in a row use is listed once for them.</summary>
struct UsedShapes(Shapes shapes, BufferPool pool) : IForEach<TypedIndex>
{
    QuickList<ShapeIdentity> list = new(64, pool);

    public void LoopBody(TypedIndex shape)
    {
        if (shape.Exists && (list.Count == 0 || list[list.Count - 1].Shape != shape))
            list.Add(shapes.Identify(shape), pool);
    }

    internal void CopyState(StateCopy copy) => copy.List(ref list);

    /// <summary>Refuses shapes that are not there, or that are others than those that had their names when they were listed.</summary>
    internal readonly void CheckExist()
    {
        foreach (ref var used in list.AsSpan())
        {
            if (!shapes.Holds(used.Shape) || shapes.Identify(used.Shape) != used)
            {
                throw new InvalidOperationException(
                    $"{used.Shape}, which a body or static of the snapshot has, is not there any more, or is another shape: shapes are no part of a " +
                    "snapshot, and are to be kept as long as it is, or added in the same order. Nothing was changed.");
            }
        }
    }

    internal void Dispose() => list.Dispose(pool);
}
