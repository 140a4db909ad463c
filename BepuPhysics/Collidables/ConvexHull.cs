using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>The convex hull of a set of points, its centre of mass at the origin.</summary>
/// <remarks>
/// All of it is one block of a pool's memory, which copies of the struct share and <see cref="Dispose"/> returns.
/// Shapes that no body or static uses any more are disposed by their owner or by <see cref="Shapes.RemoveAndDispose"/>.
/// To be added as a shape, the distance from the centre of mass to the nearest face must be from 1e-6 to 1e7 m, as must half the extent.
/// The axes of the frame are those of the points and no principal axes: the inverse inertia has products. As floats these keep what is
/// left of the least inverse moment to a percent, up to several thousand times as long as thick; a longer hull must have its length along
/// an axis, or <see cref="ComputeInertia"/> refuses it.
/// </remarks>
public unsafe partial struct ConvexHull : IConvexShape, IDisposableShape
{
    /// <summary>Type id of convex hulls.</summary>
    public const int Id = 5;

    /// <summary>Greatest number of vertices of a hull.</summary>
    public const int MaximumVertexCount = 65535;

    // A buffer in words of four bytes, so that the wide form is these words widened.
    internal int MemoryLow, MemoryHigh, ByteCount, BlockId;

    /// <summary>Creates the convex hull of a set of points.</summary>
    /// <param name="points">Points in any order and number, inside the hull or not, as often as they like.</param>
    /// <param name="pool">Source of the hull's memory and of temporary memory.</param>
    /// <param name="center">Centre of mass of the hull in the coordinates of the points; the hull's own coordinates begin there.</param>
    /// <exception cref="ArgumentException">
    /// A point is not finite, or the points span no volume; the message says which. <see cref="ConvexHullHelper"/> says what is no volume.
    /// </exception>
    public ConvexHull(Span<Vector3> points, BufferPool pool, out Vector3 center)
    {
        if (!ConvexHullHelper.TryCreateShape(points, pool, out center, out this, out var failure))
            throw new ArgumentException(ConvexHullHelper.Describe(failure, points.Length), nameof(points));
    }

    /// <summary>All memory of the hull; without memory for the default value.</summary>
    public Buffer<byte> Data
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        readonly get => new(Header, ByteCount, BlockId);
        internal set
        {
            var address = (ulong)value.Memory;
            MemoryLow = (int)(uint)address;
            MemoryHigh = (int)(uint)(address >> 32);
            ByteCount = value.Length;
            BlockId = value.Id;
        }
    }

    /// <summary>The hull's memory, seen as its header; null for the default value.</summary>
    internal readonly HullHeader* Header
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (HullHeader*)((uint)MemoryLow | (ulong)(uint)MemoryHigh << 32);
    }

    /// <summary>Vertices in bundles, m; the last bundle is filled up with copies of the first vertex.</summary>
    public readonly Buffer<Vector3Wide> Points
    {
        get
        {
            var header = Header;
            return header == null ? default : new(header->Points, header->VertexBundleCount, BlockId);
        }
    }

    /// <summary>Planes of the faces in bundles; the last bundle is filled up with copies of the first plane.</summary>
    public readonly Buffer<HullBoundingPlanes> BoundingPlanes
    {
        get
        {
            var header = Header;
            return header == null ? default : new(header->Planes, header->FaceBundleCount, BlockId);
        }
    }

    /// <summary>Vertices of all faces, one face after the other, each counterclockwise seen from outside.</summary>
    public readonly Buffer<HullVertexIndex> FaceVertexIndices
    {
        get
        {
            var header = Header;
            return header == null ? default : new(header->FaceVertices, header->FaceVertexCount, BlockId);
        }
    }

    /// <summary>Where the vertices of each face begin in <see cref="FaceVertexIndices"/>; as long as there are faces.</summary>
    public readonly Buffer<int> FaceToVertexIndicesStart
    {
        get
        {
            var header = Header;
            return header == null ? default : new(header->FaceStarts, header->FaceCount, BlockId);
        }
    }

    /// <summary>Number of vertices.</summary>
    public readonly int VertexCount => Header == null ? 0 : Header->VertexCount;

    /// <summary>Number of faces.</summary>
    public readonly int FaceCount => Header == null ? 0 : Header->FaceCount;

    /// <inheritdoc/>
    public static int TypeId => Id;

    /// <inheritdoc/>
    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) => new ConvexHullShapeBatch(pool, initialCapacity);

    /// <summary>A vertex by its number.</summary>
    /// <param name="pointIndex">Number of the vertex, less than <see cref="VertexCount"/>.</param>
    /// <param name="point">Position relative to the centre of mass, m.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such vertex.</exception>
    public readonly void GetPoint(int pointIndex, out Vector3 point)
    {
        if ((uint)pointIndex >= (uint)VertexCount)
            throw new ArgumentOutOfRangeException(nameof(pointIndex), pointIndex, $"The hull has {VertexCount} vertices.");
        point = Header->GetPoint(pointIndex);
    }

    /// <summary>A vertex by its place.</summary>
    /// <param name="pointIndex">Place of the vertex.</param>
    /// <param name="point">Position relative to the centre of mass, m.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such vertex.</exception>
    public readonly void GetPoint(HullVertexIndex pointIndex, out Vector3 point) => GetPoint(pointIndex.Number, out point);

    /// <summary>The vertices of a face, counterclockwise seen from outside; a view into the hull's memory.</summary>
    /// <param name="faceIndex">Number of the face, less than <see cref="FaceCount"/>.</param>
    /// <param name="faceVertexIndices">Places of the vertices.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such face.</exception>
    public readonly void GetVertexIndicesForFace(int faceIndex, out Buffer<HullVertexIndex> faceVertexIndices)
    {
        if ((uint)faceIndex >= (uint)FaceCount)
            throw new ArgumentOutOfRangeException(nameof(faceIndex), faceIndex, $"The hull has {FaceCount} faces.");
        var starts = Header->FaceStarts + faceIndex;
        faceVertexIndices = FaceVertexIndices.Slice(starts[0], starts[1] - starts[0]);
    }

    /// <inheritdoc/>
    public void Dispose(BufferPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        if (Header == null)
            return;
        var data = Data;
        pool.Return(ref data);
        this = default;
    }

    /// <inheritdoc/>
    public readonly void Validate()
    {
        if (Header == null)
            throw new ArgumentException("A convex hull without memory is no shape: it was never created, or it was disposed.", nameof(Data));
        ShapeLimits.CheckSize(Header->InnerRadius, "convex hull", nameof(HullHeader.InnerRadius));
        ShapeLimits.CheckSize(Header->LargestHalfExtent, "convex hull", nameof(Points));
    }

    /// <inheritdoc/>
    public readonly BodyInertia ComputeInertia(float mass)
    {
        Validate();
        return MassIntegrals.ComputeInertia(Header, mass);
    }

    /// <inheritdoc/>
    public readonly void ComputeBounds(Quaternion orientation, out Vector3 min, out Vector3 max)
    {
        var bundle = AlonePerBundle();
        OneLane.ComputeFirstBounds<ConvexHull, ConvexHullWide>(ref bundle, orientation, out min, out max);
    }

    /// <inheritdoc/>
    public readonly void ComputeAngularExpansionData(out float maximumRadius, out float maximumAngularExpansion)
    {
        var header = Header;
        maximumRadius = header == null ? 0 : header->OuterRadius;
        maximumAngularExpansion = header == null ? 0 : header->OuterRadius - header->InnerRadius;
    }

    /// <inheritdoc/>
    public readonly bool RayTest(in RigidPose pose, Vector3 origin, Vector3 direction, out float t, out Vector3 normal)
    {
        var bundle = AlonePerBundle();
        return OneLane.RayTestFirst<ConvexHull, ConvexHullWide>(ref bundle, pose, origin, direction, out t, out normal);
    }

    // Unlike the other shapes, in one lane only: each lane is a loop over a hull of its own.
    readonly ConvexHullWide AlonePerBundle()
    {
        var bundle = default(ConvexHullWide);
        Lanes.Write(this, ref bundle, 0);
        return bundle;
    }
}
