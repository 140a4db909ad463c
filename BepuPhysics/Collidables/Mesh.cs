using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>A surface of triangles, which may be open or closed; what collides with it are the triangles.</summary>
/// <remarks>
/// <para>All of it is one block of a pool's memory, which copies of the struct share and <see cref="Dispose"/> returns: 26 to 32 bytes for
/// each triangle of a smooth surface. <see cref="Scale"/> and <see cref="TwoSided"/> belong to each copy, so that meshes of several scales may share
/// their memory.</para>
/// <para>A triangle's number is that which it was given with, here and wherever a child of a shape is named. Its front is that of a
/// <see cref="Triangle"/>. With one or three components of the scale negative the surface is a mirror image: what was in front stays in front.</para>
/// <para>Vertices are shared where their coordinates are equal, and nothing else is: two surfaces with a gap between them, however small, have
/// borders there. What was found is in <see cref="Report"/>.</para>
/// <para>A body turns around the origin of its shape: a mesh that is to be a body is moved to its centre of mass first, by
/// <see cref="ComputeClosedInertia(float, out Vector3)"/> or <see cref="Recenter"/>.</para>
/// </remarks>
public unsafe partial struct Mesh : IDisposableShape
{
    /// <summary>Type id of meshes.</summary>
    public const int Id = 8;

    Buffer<byte> data;
    Vector3 scale;
    bool twoSided;
    bool solid;

    /// <summary>Creates a mesh and returns the buffer of triangles to the pool.</summary>
    /// <remarks>
    /// In bepuphysics2 a mesh keeps the buffer and returns it when it is disposed. This one keeps nothing of it, so it goes back at once, and code
    /// that leaves it to the mesh need not change. To keep the triangles, or to make several meshes of them, pass a span of them. If they are refused
    /// they stay the caller's. A buffer that is no pool's (a negative id) stays the caller's too.
    /// </remarks>
    /// <param name="triangles">Triangles, 1 to 2^26; taken from the pool, and not to be used any more.</param>
    /// <param name="scale">Factors by which coordinates are multiplied; not zero.</param>
    /// <param name="pool">Source of the mesh's memory and of temporary memory.</param>
    /// <param name="dispatcher">Threads to build the tree with, which is a third of the work; null for the calling one. The mesh is the same.</param>
    /// <exception cref="ArgumentException">A corner is not finite or too far away, no triangle has a surface, or there are none or too many.</exception>
    public Mesh(Buffer<Triangle> triangles, Vector3 scale, BufferPool pool, IThreadDispatcher? dispatcher = null)
        : this((ReadOnlySpan<Triangle>)triangles.AsSpan(), scale, pool, dispatcher)
    {
        if (triangles.Allocated && triangles.Id >= 0)
            pool.Return(ref triangles);
    }

    /// <summary>Creates a mesh.</summary>
    /// <param name="triangles">Triangles, 1 to 2^26; they stay the caller's.</param>
    /// <param name="scale">Factors by which coordinates are multiplied; not zero.</param>
    /// <param name="pool">Source of the mesh's memory and of temporary memory.</param>
    /// <param name="dispatcher">As for a buffer of triangles.</param>
    /// <inheritdoc cref="Mesh(Buffer{Triangle}, Vector3, BufferPool, IThreadDispatcher)" path="/exception"/>
    public Mesh(ReadOnlySpan<Triangle> triangles, Vector3 scale, BufferPool pool, IThreadDispatcher? dispatcher = null)
    {
        ArgumentNullException.ThrowIfNull(pool);
        data = MeshBuilder.Build(triangles, scale, pool, dispatcher);
        this.scale = scale;
    }

    /// <summary>Creates a mesh of triangles with numbered vertices.</summary>
    /// <param name="vertices">Vertices, in any order and as often as they like; they stay the caller's.</param>
    /// <param name="indices">Vertices A, B, C of one triangle after the other.</param>
    /// <param name="scale">Factors by which coordinates are multiplied; not zero.</param>
    /// <param name="pool">Source of the mesh's memory and of temporary memory.</param>
    /// <param name="materials">For each triangle a byte of the game's own, see <see cref="GetMaterial"/>; or nothing.</param>
    /// <param name="dispatcher">As for triangles.</param>
    /// <exception cref="ArgumentException">As for triangles, or an index names no vertex.</exception>
    public Mesh(
        ReadOnlySpan<Vector3> vertices, ReadOnlySpan<int> indices, Vector3 scale, BufferPool pool, ReadOnlySpan<byte> materials = default,
        IThreadDispatcher? dispatcher = null)
    {
        ArgumentNullException.ThrowIfNull(pool);
        data = MeshBuilder.Build(vertices, indices, scale, materials, pool, dispatcher);
        this.scale = scale;
    }

    /// <summary>Does what the constructor does: a mesh is never without its tree.</summary>
    /// <inheritdoc cref="Mesh(Buffer{Triangle}, Vector3, BufferPool, IThreadDispatcher)" path="/remarks"/>
    /// <inheritdoc cref="Mesh(Buffer{Triangle}, Vector3, BufferPool, IThreadDispatcher)" path="/param[@name='triangles' or @name='scale' or @name='pool']"/>
    /// <inheritdoc cref="Mesh(Buffer{Triangle}, Vector3, BufferPool, IThreadDispatcher)" path="/exception"/>
    public static Mesh CreateWithoutTreeBuild(Buffer<Triangle> triangles, Vector3 scale, BufferPool pool) => new(triangles, scale, pool);

    /// <summary>Does what the constructor does: there is one way to build a tree.</summary>
    /// <inheritdoc cref="CreateWithoutTreeBuild" path="/remarks"/>
    /// <inheritdoc cref="CreateWithoutTreeBuild" path="/param"/>
    /// <inheritdoc cref="CreateWithoutTreeBuild" path="/exception"/>
    public static Mesh CreateWithSweepBuild(Buffer<Triangle> triangles, Vector3 scale, BufferPool pool) => new(triangles, scale, pool);

    /// <summary>First bytes of the memory; null for a mesh without memory.</summary>
    internal readonly MeshHeader* Header
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => (MeshHeader*)data.Memory;
    }

    /// <summary>Number of triangles, those included that are left out.</summary>
    public readonly int ChildCount => Header == null ? 0 : Header->TriangleCount;

    /// <summary>The triangles by their numbers, before scaling; a view to read.</summary>
    public readonly MeshTriangleView Triangles
    {
        get
        {
            var unscaled = this;
            unscaled.scale = Vector3.One;
            return new(unscaled);
        }
    }

    /// <summary>Number of vertices.</summary>
    public readonly int VertexCount => Header == null ? 0 : Header->VertexCount;

    /// <summary>Size of the memory, bytes.</summary>
    public readonly int ByteCount => data.Length;

    /// <summary>What was found when the mesh was built.</summary>
    public readonly MeshReport Report => Header == null ? default : Header->Report;

    /// <summary>Factors by which coordinates are multiplied; may be negative.</summary>
    /// <remarks>
    /// After a change of a mesh that is in use the bounds of its statics and bodies are to be updated. Triangles were held against the least
    /// thickness of a <see cref="Triangle"/> at the scale that the mesh was made with.
    /// </remarks>
    /// <exception cref="ArgumentOutOfRangeException">A component is not from 1e-9 to 1e9 or the negative of that.</exception>
    public Vector3 Scale
    {
        readonly get => scale;
        set
        {
            MeshBuilder.CheckScale(value);
            scale = value;
        }
    }

    /// <summary>Whether rays and contacts meet the backs of triangles as well as the fronts; false unless it is set.</summary>
    public bool TwoSided
    {
        readonly get => twoSided;
        set => twoSided = value;
    }

    /// <inheritdoc/>
    public static int TypeId => Id;

    /// <inheritdoc/>
    public static ShapeBatch CreateShapeBatch(BufferPool pool, int initialCapacity, Shapes shapes) =>
        new MeshShapeBatch(pool, initialCapacity, shapes);

    // The cones of what is mirrored are in another order, and what has two sides has neighbours at both.
    readonly bool KnowsNeighbours => !twoSided && !IsMirrored;

    // Two corners change places, so that the front of a mirror image is the image of the front.
    internal readonly bool IsMirrored => scale.X < 0 ^ scale.Y < 0 ^ scale.Z < 0;

    /// <summary>A triangle by its number, in the frame of the mesh, scaled.</summary>
    /// <param name="triangleIndex">Number of the triangle, less than <see cref="ChildCount"/>.</param>
    /// <param name="target">The triangle.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such triangle.</exception>
    public readonly void GetLocalChild(int triangleIndex, out Triangle target)
    {
        CheckIndex(triangleIndex);
        GetChild(triangleIndex, out target);
    }

    /// <summary>A triangle by its number, scaled and relative to the mean of its corners.</summary>
    /// <param name="triangleIndex">Number of the triangle, less than <see cref="ChildCount"/>.</param>
    /// <param name="target">The triangle, its mean at the origin.</param>
    /// <param name="childPose">Where that is in the frame of the mesh.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such triangle.</exception>
    public readonly void GetPosedLocalChild(int triangleIndex, out Triangle target, out RigidPose childPose)
    {
        CheckIndex(triangleIndex);
        GetCenteredChild(triangleIndex, out target, out var center);
        childPose = new(center);
    }

    /// <summary>Material of a triangle; zero if the mesh was made without materials.</summary>
    /// <param name="triangleIndex">Number of the triangle, less than <see cref="ChildCount"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such triangle.</exception>
    public readonly byte GetMaterial(int triangleIndex)
    {
        CheckIndex(triangleIndex);
        return Header->HasMaterials != 0 ? Header->Materials[triangleIndex] : (byte)0;
    }

    /// <summary>Whether a triangle collides with nothing, since it has no surface or is there twice.</summary>
    /// <param name="triangleIndex">Number of the triangle, less than <see cref="ChildCount"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such triangle.</exception>
    public readonly bool IsLeftOut(int triangleIndex)
    {
        CheckIndex(triangleIndex);
        return Header->IsLeftOut(triangleIndex);
    }

    readonly void CheckIndex(int triangleIndex)
    {
        if ((uint)triangleIndex >= (uint)ChildCount)
            throw new ArgumentOutOfRangeException(nameof(triangleIndex), triangleIndex, $"The mesh has {ChildCount} triangles.");
    }

    /// <summary>A triangle that is known to exist, scaled.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly void GetChild(int triangle, out Triangle target) => GetChildAt(Header->GetPlace(triangle), out target);

    /// <summary>A triangle by its place in the tree, scaled.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly void GetChildAt(int place, out Triangle target)
    {
        Header->GetCornersAt(place, out var a, out var b, out var c);
        var isMirrored = IsMirrored;
        target = new(a * scale, (isMirrored ? c : b) * scale, (isMirrored ? b : c) * scale) { TwoSided = twoSided };
    }

    /// <summary>A triangle that is known to exist, scaled and relative to the mean of its corners.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly void GetCenteredChild(int triangle, out Triangle target, out Vector3 center)
    {
        GetChild(triangle, out target);
        center = (target.A + target.B + target.C) * (1f / 3);
        target.A -= center;
        target.B -= center;
        target.C -= center;
    }

    /// <summary>Where the neighbours begin of a triangle that is known to exist: of its edges AB, BC and CA as <see cref="GetChild"/> has them, at the scale of
    /// the mesh.</summary>
    /// <remarks>
    /// Angles are kept for the mesh before scaling. A scale that is not the same along all axes changes them: the neighbour's normal follows from that
    /// of the triangle and the angle, and both are scaled.
    /// </remarks>
    internal readonly void GetCone(int triangle, out TriangleCone cone)
    {
        var edges = Header->Edges + 3 * (nint)triangle;
        var (first, second, third) = (edges[0], edges[1], edges[2]);
        var (ab, bc, ca) = (MeshEdges.Turn(first), MeshEdges.Turn(second), MeshEdges.Turn(third));
        if (MathF.Abs(scale.X) != MathF.Abs(scale.Y) || MathF.Abs(scale.X) != MathF.Abs(scale.Z))
        {
            ab = ScaleTurn(triangle, 0, first, ab);
            bc = ScaleTurn(triangle, 1, second, bc);
            ca = ScaleTurn(triangle, 2, third, ca);
        }
        // With B and C changing places AB is what was CA.
        if (IsMirrored)
        {
            (ab, ca) = (ca, ab);
            (first, third) = (third, first);
        }
        cone.Cosines = new(ab.X, bc.X, ca.X);
        cone.Sines = new(ab.Y, bc.Y, ca.Y);
        cone.FreeMask = (first == MeshEdges.Free ? 1 : 0) | (second == MeshEdges.Free ? 2 : 0) | (third == MeshEdges.Free ? 4 : 0);
    }

    readonly Vector2 ScaleTurn(int triangle, int edge, byte value, Vector2 turn)
    {
        // Flat stays flat.
        if (value is 0 or MeshEdges.Free)
            return turn;
        Header->GetCorners(triangle, out var a, out var b, out var c);
        var normal = Exact.Normalize(Exact.Cross(c - a, b - a));
        var along = Exact.Normalize(edge == 0 ? b - a : edge == 1 ? c - b : a - c);
        // Out of the triangle: it is to the right of its edges, seen from the front.
        var outward = Exact.Cross(along, -normal);
        var neighbour = normal * turn.X + outward * turn.Y;
        // Normals are multiplied by the inverse of what points are multiplied by; a mirror turns both.
        var scaledNormal = Exact.Normalize(normal / scale);
        var scaledNeighbour = Exact.Normalize(neighbour / scale);
        return new(Exact.Dot(scaledNormal, scaledNeighbour), Exact.Length(Exact.Cross(scaledNormal, scaledNeighbour)));
    }

    /// <summary>Appends the triangles whose boxes meet a box in the frame of the mesh, in the order of the tree, which any CPU finds the same.</summary>
    internal readonly void FindLocalOverlaps(Vector3 min, Vector3 max, ref QuickList<int> found, BufferPool pool)
    {
        var first = found.Count;
        FindPlaces(min, max, ref found, pool);
        for (int i = first; i < found.Count; ++i)
            found[i] = Header->Triangles.GetNumber(found[i]);
    }

    // Places in the tree, not numbers.
    readonly void FindPlaces(Vector3 min, Vector3 max, ref QuickList<int> found, BufferPool pool)
    {
        ToVertices(ref min, ref max);
        MeshQuery.FindPlaces(Header, min, max, ref found, pool);
    }

    // A box before scaling.
    readonly void ToVertices(ref Vector3 min, ref Vector3 max)
    {
        if (scale != Vector3.One)
            DivideByScale(ref min, ref max);
    }

    // Outward: what a corner is after scaling may have been rounded, and the quotient is.
    readonly void DivideByScale(ref Vector3 min, ref Vector3 max)
    {
        Vector3 a = min / scale, b = max / scale;
        min = Exact.Min(a, b);
        max = Exact.Max(a, b);
        const float TwoRoundings = 2.4e-7f;
        min -= Vector3.Abs(min) * TwoRoundings + new Vector3(float.Epsilon);
        max += Vector3.Abs(max) * TwoRoundings + new Vector3(float.Epsilon);
    }

    /// <inheritdoc/>
    public void Dispose(BufferPool pool)
    {
        ArgumentNullException.ThrowIfNull(pool);
        pool.ReturnIfTaken(ref data);
        this = default;
    }

    /// <inheritdoc/>
    public readonly void Validate()
    {
        if (Header == null)
            throw new ArgumentException("A mesh without memory is no shape: it was never created, or it was disposed.", nameof(Header));
        MeshBuilder.CheckScale(scale);
        GetScaledBounds(out var min, out var max);
        const float Limit = ShapeLimits.MaximumSize;
        if (!(min.X >= -Limit && min.Y >= -Limit && min.Z >= -Limit && max.X <= Limit && max.Y <= Limit && max.Z <= Limit))
            throw new ArgumentOutOfRangeException(nameof(Scale), scale,
                $"Scaled, the mesh reaches from {min} to {max}; coordinates must be from {-Limit} to {Limit} m.");
    }
}
