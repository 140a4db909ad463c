using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>Receives the triangles that a ray hits.</summary>
interface IMeshHits
{
    /// <summary>Whether a triangle is to be tested.</summary>
    bool Allows(int triangle);

    /// <summary>The ray hits a triangle.</summary>
    /// <param name="triangle">Number of the triangle.</param>
    /// <param name="t">Place of the hit, no greater than the greatest of interest.</param>
    /// <param name="normal">Unit normal of the side that was met, in the frame of the mesh.</param>
    /// <param name="maximumT">Greatest t of interest, which may be lowered.</param>
    void Add(int triangle, float t, Vector3 normal, ref float maximumT);
}

/// <summary>A ray on its way through a mesh, in the mesh's frame.</summary>
/// <remarks>
/// Triangles are tested as a <see cref="Triangle"/> of its own would be, relative to the point of the line that is nearest to the origin, so that no ray
/// passes between two that share an edge. That test moves corners by roundings of their distance from that point: every box is widened by more, so
/// that none hides a triangle which the test hits.
/// </remarks>
unsafe struct MeshRay
{
    // Of the distance of the farthest corner: each coordinate of a corner is rounded when it is scaled, when the point is subtracted and in two
    // products, and the direction has three roundings; all together less than 2^-20.
    const float Widening = 1f / (1 << 20);
    // Two roundings on each side of the comparison of two times.
    const float Slack = 1 + 4 * 1.1920929e-7f;
    const int StackSize = MeshTree.MaximumHeight * MeshNode.Width;

    readonly Mesh mesh;
    readonly MeshHeader* header;
    CenteredRayWide line;
    readonly Vector3Wide across, upward;
    // Of the boxes: where the line is nearest to the origin, its direction, one over that, by how much boxes are widened against it.
    readonly Vector3 closest, scale;
    Vector3 inverseDirection, widening;
    readonly float start;
    // Which sides of a box come first along the line, a bit for each axis: the least ones, before scaling.
    readonly int leastFirst;

    public MeshRay(in Mesh mesh, in RigidPose pose, in Vector3 origin, in Vector3 direction)
    {
        this.mesh = mesh;
        header = mesh.Header;
        scale = mesh.Scale;
        inverseDirection = default;
        widening = default;
        var rays = new RayWide
        {
            Origin = Lanes.Broadcast<Vector3, Vector3Wide>(origin),
            Direction = Lanes.Broadcast<Vector3, Vector3Wide>(direction),
        };
        line = new(rays, Lanes.Broadcast<Vector3, Vector3Wide>(pose.Position));
        line.ToLocal(Matrix3x3Wide.FromQuaternion(Lanes.Broadcast<Quaternion, QuaternionWide>(pose.Orientation)));
        Vector3Wide.BuildOrthonormalBasis(line.Direction, out across, out upward);
        closest = new(line.Closest.X[0], line.Closest.Y[0], line.Closest.Z[0]);
        start = line.Start[0];
        var extent = Exact.Max(Vector3.Abs(header->Min * scale), Vector3.Abs(header->Max * scale));
        var margin = ((extent + Vector3.Abs(closest)).Largest()) * Widening;
        for (int axis = 0; axis < 3; ++axis)
        {
            var component = axis == 0 ? line.Direction.X[0] : axis == 1 ? line.Direction.Y[0] : line.Direction.Z[0];
            var inverse = 1 / component;
            // Of an axis along which the line does not move: times beyond any use, and nothing that becomes no number.
            inverse = component == 0 || inverse > float.MaxValue ? float.MaxValue : inverse < -float.MaxValue ? -float.MaxValue : inverse;
            inverseDirection[axis] = inverse;
            widening[axis] = inverse < 0 ? -margin : margin;
            leastFirst |= inverse < 0 == scale[axis] < 0 ? 1 << axis : 0;
        }
    }

    /// <summary>Whether the ray has a direction, and with it can hit anything.</summary>
    public readonly bool Exists => float.IsFinite(start + closest.X + closest.Y + closest.Z);

    struct Entry
    {
        /// <summary>Where the line meets the box, as a distance.</summary>
        public float Begin;
        /// <summary>Number of triangles of a leaf; zero for a node.</summary>
        public int Count;
        /// <summary>Number of the node, or place of the leaf's first triangle.</summary>
        public int Index;
    }

    /// <summary>Finds all triangles that the ray hits, near boxes first.</summary>
    /// <param name="maximumT">Greatest t of interest.</param>
    /// <param name="hits">Receives the hits.</param>
    public void Cast<THits>(ref float maximumT, ref THits hits) where THits : struct, IMeshHits, allows ref struct
    {
        if (!Exists)
            return;
        var stack = stackalloc Entry[StackSize];
        stack[0] = new() { Begin = float.NegativeInfinity };
        for (var stackCount = 1; stackCount > 0;)
        {
            ref var entry = ref stack[--stackCount];
            if (entry.Begin > Distance(maximumT))
                continue;
            if (entry.Count > 0)
                TestLeaf(entry.Index, entry.Count, ref maximumT, ref hits);
            else
                Open(header->Nodes + entry.Index, Distance(maximumT), stack, ref stackCount);
        }
    }

    // The place of a t on the line, or a little beyond.
    readonly float Distance(float t)
    {
        // By the factors that the line itself was made with; the sum may be rounded by as much as boxes are widened.
        var distance = line.Place(new(t))[0];
        return distance + MathF.Abs(distance) * (Slack - 1) + MathF.Abs(widening.X);
    }

    // Pushes the children that the line meets, the nearest last.
    void Open(MeshNode* node, float end, Entry* stack, ref int stackCount)
    {
        var mask = FindHits(node, end, out var begins);
        var bottom = stackCount;
        for (; mask != 0; mask &= mask - 1)
        {
            var child = BitOperations.TrailingZeroCount(mask);
            var count = node->TriangleCount(child);
            var isNode = (node->NodeMask >> child & 1) != 0;
            if (count == 0 && !isNode)
                continue;
            var entry = new Entry { Begin = begins[child], Count = count, Index = isNode ? node->Node(child) : node->Place(child) };
            var place = stackCount++;
            for (; place > bottom && stack[place - 1].Begin < entry.Begin; --place)
                stack[place] = stack[place - 1];
            stack[place] = entry;
        }
    }

    // Eight boxes at a time on every CPU, so that nothing depends on the width of vectors.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly int FindHits(MeshNode* node, float end, out Vector256<float> begins)
    {
        var begin = Vector256.Create(start);
        var last = Vector256.Create(end);
        for (int axis = 0; axis < 3; ++axis)
        {
            node->GetSides(axis, out var least, out var greatest);
            var isLeastFirst = (leastFirst >> axis & 1) != 0;
            var factor = Vector256.Create(scale[axis]);
            var point = Vector256.Create(closest[axis]);
            var margin = Vector256.Create(widening[axis]);
            var inverse = Vector256.Create(inverseDirection[axis]);
            var near = ((isLeastFirst ? least : greatest) * factor - point - margin) * inverse;
            var far = ((isLeastFirst ? greatest : least) * factor - point + margin) * inverse;
            begin = Vector256.ConditionalSelect(Vector256.GreaterThan(near, begin), near, begin);
            last = Vector256.ConditionalSelect(Vector256.LessThan(far, last), far, last);
        }
        begins = begin;
        var slack = Vector256.Create(Slack - 1);
        return (int)Vector256.LessThanOrEqual(begin - Vector256.Abs(begin) * slack, last + Vector256.Abs(last) * slack).ExtractMostSignificantBits();
    }

    void TestLeaf<THits>(int place, int count, ref float maximumT, ref THits hits) where THits : struct, IMeshHits, allows ref struct
    {
        Unsafe.SkipInit(out TriangleWide triangles);
        Unsafe.SkipInit(out TriangleNumbers numbers);
        var used = 0;
        for (int i = 0; i < count; ++i)
        {
            var number = header->Order[place + i];
            if (!hits.Allows(number))
                continue;
            mesh.GetChild(number, out var triangle);
            Lanes.Write(triangle, ref triangles, used);
            numbers[used++] = number;
        }
        if (used == 0)
            return;
        triangles.Meet(line, across, upward, out var front, out var back, out var distance);
        var meets = front | back;
        line.Resolve(distance, Wide.Select(meets, distance, new Vector<float>(float.NaN)), out var hitMask, out _, out var t);
        if (Vector.EqualsAll(hitMask, Vector<int>.Zero))
            return;
        var normals = triangles.GetNormal();
        normals = Vector3Wide.Select(back, -normals, normals);
        for (int i = 0; i < used; ++i)
        {
            if (hitMask[i] != 0 && t[i] <= maximumT)
                hits.Add(numbers[i], t[i], new(normals.X[i], normals.Y[i], normals.Z[i]), ref maximumT);
        }
    }

    [InlineArray(MeshNode.LeafSize)]
    struct TriangleNumbers
    {
        int first;
    }
}
