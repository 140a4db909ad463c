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
    // products, and the direction has three roundings; all together less than 2^-20. A box's own side is rounded when the grid's step and origin are
    // scaled, and in two products and a sum: less than 2^-21 of the ends of the grid, which is at most twice as long as what is in it.
    const float Widening = 1f / (1 << 19);
    // Two roundings on each side of the comparison of two times.
    const float Slack = 1 + 4 * 1.1920929e-7f;
    // Of a direction: along an axis with less the line stays in its place, to far less than a rounding, over any distance of use. Nothing that is divided by it
    // overflows.
    const float LeastComponent = 1f / (1L << 60);
    const int StackSize = MeshTree.MaximumHeight * MeshNode.Width;

    MeshNode* nodes;
    float* vertices;
    int* indices, order;
    CenteredRayWide line;
    Vector3Wide across, upward;
    Vector<int> twoSided;
    bool isMirrored;
    float start, margin;
    Vector128<float> scale;
    MeshSlabs slabs;

    /// <summary>Finds all triangles that a ray hits, near boxes first.</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="pose">Its pose.</param>
    /// <param name="origin">Start of the ray.</param>
    /// <param name="direction">Direction of the ray.</param>
    /// <param name="maximumT">Greatest t of interest.</param>
    /// <param name="hits">Receives the hits.</param>
    public static void Cast<THits>(
        in Mesh mesh, in RigidPose pose, in Vector3 origin, in Vector3 direction, ref float maximumT, ref THits hits)
        where THits : struct, IMeshHits, allows ref struct
    {
        // Not a constructor: what that makes would be cleared before and copied after, which takes as long as two nodes.
        Unsafe.SkipInit(out MeshRay ray);
        if (ray.TryBegin(mesh, pose, origin, direction))
            ray.Cast(ref maximumT, ref hits);
    }

    // Whether the ray has a direction, and with it can hit anything.
    bool TryBegin(in Mesh mesh, in RigidPose pose, in Vector3 origin, in Vector3 direction)
    {
        var header = mesh.Header;
        nodes = header->Nodes;
        vertices = (float*)header->Vertices;
        indices = header->Indices;
        order = header->Order;
        twoSided = new Vector<int>(mesh.TwoSided ? -1 : 0);
        isMirrored = mesh.IsMirrored;
        scale = mesh.Scale.AsVector128();
        var rays = new RayWide
        {
            Origin = Lanes.Broadcast<Vector3, Vector3Wide>(origin),
            Direction = Lanes.Broadcast<Vector3, Vector3Wide>(direction),
        };
        line = new(rays, Lanes.Broadcast<Vector3, Vector3Wide>(pose.Position));
        line.ToLocal(Matrix3x3Wide.FromQuaternion(Lanes.Broadcast<Quaternion, QuaternionWide>(pose.Orientation)));
        Vector3Wide.BuildOrthonormalBasis(line.Direction, out across, out upward);
        start = line.Start[0];
        var closest = new Vector3(line.Closest.X[0], line.Closest.Y[0], line.Closest.Z[0]);
        var extent = Exact.Max(Vector3.Abs(header->Min * mesh.Scale), Vector3.Abs(header->Max * mesh.Scale));
        margin = (extent + Vector3.Abs(closest)).Largest() * Widening;
        slabs = new(mesh.Scale, closest, new(Invert(line.Direction.X[0]), Invert(line.Direction.Y[0]), Invert(line.Direction.Z[0])), margin);
        return float.IsFinite(start + closest.X + closest.Y + closest.Z);
    }

    static float Invert(float component) => 1 / (MathF.Abs(component) >= LeastComponent ? component : component < 0 ? -LeastComponent : LeastComponent);

    struct Entry
    {
        /// <summary>Where the line meets the box, as a distance.</summary>
        public float Begin;
        /// <summary>Number of triangles of a leaf; zero for a node.</summary>
        public int Count;
        /// <summary>Number of the node, or place of the leaf's first triangle.</summary>
        public int Index;
    }

    readonly void Cast<THits>(ref float maximumT, ref THits hits) where THits : struct, IMeshHits, allows ref struct
    {
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
                Open(nodes + entry.Index, Distance(maximumT), stack, ref stackCount);
        }
    }

    // The place of a t on the line, or a little beyond.
    readonly float Distance(float t)
    {
        // By the factors that the line itself was made with; the sum may be rounded by as much as boxes are widened.
        var distance = line.Place(new(t))[0];
        return distance + MathF.Abs(distance) * (Slack - 1) + margin;
    }

    // Pushes the children that the line meets, the nearest last.
    readonly void Open(MeshNode* node, float end, Entry* stack, ref int stackCount)
    {
        var mask = slabs.FindHits(node, start, end, Slack - 1, out var begins);
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

    readonly void TestLeaf<THits>(int place, int count, ref float maximumT, ref THits hits) where THits : struct, IMeshHits, allows ref struct
    {
        var numbers = order + place;
        var allowed = 0;
        for (int i = 0; i < count; ++i)
            allowed |= hits.Allows(numbers[i]) ? 1 << i : 0;
        if (allowed == 0)
            return;
        // Where there are fewer than four, the first takes the place of those that are not there.
        int* first = indices + 3 * numbers[0], second = indices + 3 * numbers[count > 1 ? 1 : 0];
        int* third = indices + 3 * numbers[count > 2 ? 2 : 0], fourth = indices + 3 * numbers[count > 3 ? 3 : 0];
        var triangles = new TriangleWide
        {
            A = Corners(first[0], second[0], third[0], fourth[0]),
            B = isMirrored ? Corners(first[2], second[2], third[2], fourth[2]) : Corners(first[1], second[1], third[1], fourth[1]),
            C = isMirrored ? Corners(first[1], second[1], third[1], fourth[1]) : Corners(first[2], second[2], third[2], fourth[2]),
            TwoSidedMask = twoSided,
        };
        triangles.Meet(line, across, upward, out var front, out var back, out var distance);
        var meets = front | back;
        if (Vector.EqualsAll(meets, Vector<int>.Zero))
            return;
        line.Resolve(distance, Wide.Select(meets, distance, new Vector<float>(float.NaN)), out var hitMask, out _, out var t);
        if (Vector.EqualsAll(hitMask, Vector<int>.Zero))
            return;
        var normals = triangles.GetNormal();
        normals = Vector3Wide.Select(back, -normals, normals);
        for (int i = 0; i < count; ++i)
        {
            if ((allowed >> i & 1) != 0 && hitMask[i] != 0 && t[i] <= maximumT)
                hits.Add(numbers[i], t[i], new(normals.X[i], normals.Y[i], normals.Z[i]), ref maximumT);
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly Vector3Wide Corners(int a, int b, int c, int d) => Transpose.FourPoints(
        Vector128.Load(vertices + 3 * a) * scale, Vector128.Load(vertices + 3 * b) * scale,
        Vector128.Load(vertices + 3 * c) * scale, Vector128.Load(vertices + 3 * d) * scale);
}
