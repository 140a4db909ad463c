using System;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Convex shapes of one type of a game's own that are known by their farthest points: these can be swept, and have distances.</summary>
/// <remarks>In place of a <see cref="ConvexShapeBatch{TShape, TShapeWide}"/>, whose shapes of a game's own have contacts and rays alone.</remarks>
/// <typeparam name="TShape">Type of the shapes.</typeparam>
/// <typeparam name="TShapeWide">Wide form of the shapes.</typeparam>
/// <typeparam name="TSupport">Farthest points of the shapes.</typeparam>
public sealed unsafe class SupportShapeBatch<TShape, TShapeWide, TSupport> : ConvexShapeBatch<TShape, TShapeWide>, IConvexCoreBatch
    where TShape : unmanaged, IConvexShape where TShapeWide : unmanaged, IShapeWide<TShape> where TSupport : unmanaged, ISupport<TShapeWide>
{
    /// <summary>Creates an empty batch.</summary>
    /// <param name="pool">Source of the batch's memory.</param>
    /// <param name="initialCapacity">Number of shapes to make room for.</param>
    /// <exception cref="InvalidOperationException">The type has the id of a type of the library's.</exception>
    public SupportShapeBatch(BufferPool pool, int initialCapacity) : base(pool, initialCapacity) => OwnShapeChecks.TypeId(typeof(TShape), TShape.TypeId);

    ImpactCore IConvexCoreBatch.CoreOf(void* shape) =>
        ConvexSupport<TShapeWide, TSupport>.CoreOf(Lanes.Broadcast<TShape, TShapeWide>(*(TShape*)shape), 0, shape, &Farthest);

    static DoubleVector3 Farthest(void* shape, DoubleVector3 direction) =>
        ConvexSupport<TShapeWide, TSupport>.Farthest(Lanes.Broadcast<TShape, TShapeWide>(*(TShape*)shape), 0, direction);
}
