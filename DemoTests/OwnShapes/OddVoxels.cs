using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Trees;
using BepuUtilities.Collections;
using BepuUtilities.Memory;
using static DemoTests.Quality.DocSamples;

namespace DemoTests.OwnShapes;

/// <summary>What is odd about voxels, or wrong.</summary>
enum Oddity
{
    None,
    /// <summary>Children are told of from the last to the first.</summary>
    Backward,
    /// <summary>Children are told of in another order each time.</summary>
    Shuffled,
    /// <summary>Children are told of twice, not behind each other.</summary>
    Twice,
    /// <summary>There are less than no children.</summary>
    NegativeCount,
    /// <summary>Bounds that are no numbers.</summary>
    NaNBounds,
    /// <summary>Bounds without an end.</summary>
    InfiniteBounds,
    /// <summary>Bounds whose corners are the wrong way round.</summary>
    TurnedBounds,
    /// <summary>An exception comes out of the bounds.</summary>
    ThrowsInBounds,
    /// <summary>An exception comes out of the search for children.</summary>
    ThrowsInOverlaps,
    /// <summary>An exception comes out of a child.</summary>
    ThrowsInChild,
}

/// <summary>Voxels that can be wrong, from any moment on.</summary>
struct OddVoxels(Voxels voxels) : IHomogeneousCompoundShape<Box, BoxWide>
{
    public Voxels Voxels = voxels;
    public Oddity Oddity;

    /// <summary>How often this thread has searched for children.</summary>
    [ThreadStatic]
    internal static int SearchCount;

    public static int TypeId => 92;

    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
        new HomogeneousCompoundShapeBatch<OddVoxels, Box, BoxWide>(pool, initialCapacity);

    public readonly int ChildCount => Oddity == Oddity.NegativeCount ? -1 : Voxels.ChildCount;

    public readonly void Validate() => Voxels.Validate();

    public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max)
    {
        Voxels.ComputeBounds(orientation, out min, out max);
        switch (Oddity)
        {
            case Oddity.NaNBounds: max.Y = float.NaN; break;
            case Oddity.InfiniteBounds: max.Y = float.PositiveInfinity; break;
            case Oddity.TurnedBounds: (min, max) = (max, min); break;
            case Oddity.ThrowsInBounds: throw new TimeZoneNotFoundException("of the test");
        }
    }

    public readonly void GetPosedLocalChild(int childIndex, out Box childShape, out RigidPose childPose)
    {
        if (Oddity == Oddity.ThrowsInChild)
            throw new TimeZoneNotFoundException("of the test");
        Voxels.GetPosedLocalChild(childIndex, out childShape, out childPose);
    }

    public readonly void FindLocalOverlaps(Vector3 min, Vector3 max, ref QuickList<int> overlaps, BufferPool pool)
    {
        ++SearchCount;
        if (Oddity == Oddity.ThrowsInOverlaps)
            throw new TimeZoneNotFoundException("of the test");
        var first = overlaps.Count;
        Voxels.FindLocalOverlaps(min, max, ref overlaps, pool);
        var count = overlaps.Count - first;
        if (Oddity == Oddity.Backward)
            overlaps.AsSpan()[first..].Reverse();
        if (Oddity == Oddity.Shuffled)
            Random.Shared.Shuffle(overlaps.AsSpan()[first..]);
        for (int i = 0; Oddity == Oddity.Twice && i < count; ++i)
            overlaps.Add(overlaps[first + i], pool);
    }

    public readonly void RayTest<TRayHitHandler>(
        in RigidPose pose, in RayData ray, ref float maximumT, BufferPool pool, ref TRayHitHandler hitHandler)
        where TRayHitHandler : struct, IShapeRayHitHandler =>
        HomogeneousCompound.RayTest<OddVoxels, Box, BoxWide, TRayHitHandler>(this, pose, ray, ref maximumT, pool, ref hitHandler);

    public void Dispose(BufferPool pool) => Voxels.Dispose(pool);
}
