using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuPhysics.Trees;
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
    // products, and the direction has three roundings; all together less than 2^-20. A place on the line is (origin + l step) scale / d - point / d with ten
    // roundings, each of at most 2^-24 of what is moved along the axis: of the grid's ends, which is at most twice as long as what is in it, and of the
    // point. All together less than 2^-19.
    const float Widening = 1f / (1 << 18);
    // Two roundings on each side of the comparison of two times.
    const float Slack = 1 + 4 * 1.1920929e-7f;
    const int StackSize = MeshTree.MaximumHeight * MeshNode.Width;

    MeshNode* nodes;
    float* vertices;
    MeshTriangles triangles;
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
        triangles = header->Triangles;
        twoSided = new Vector<int>(mesh.TwoSided ? -1 : 0);
        isMirrored = mesh.IsMirrored;
        scale = mesh.Scale.AsVector128();
        var turn = pose.Orientation;
        line = new(new RayWide { Origin = Widen(origin), Direction = Widen(direction) }, Widen(pose.Position));
        line.ToLocal(Matrix3x3Wide.FromQuaternion(new() { X = new(turn.X), Y = new(turn.Y), Z = new(turn.Z), W = new(turn.W) }));
        Vector3Wide.BuildOrthonormalBasis(line.Direction, out across, out upward);
        start = line.Start[0];
        var closest = First(line.Closest);
        var extent = BoxMath.Max(Vector128.Abs(header->Min.AsVector128() * scale), Vector128.Abs(header->Max.AsVector128() * scale));
        var reach = extent + Vector128.Abs(closest);
        var turned = Vector128.Shuffle(reach, Vector128.Create(1, 2, 0, 3));
        reach = BoxMath.Max(BoxMath.Max(reach, turned), Vector128.Shuffle(reach, Vector128.Create(2, 0, 1, 3)));
        margin = reach.ToScalar() * Widening;
        slabs.Set(scale, closest, First(line.Direction), margin);
        return float.IsFinite(start + (closest.GetElement(0) + closest.GetElement(1) + closest.GetElement(2)));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide Widen(in Vector3 v) => new(new(v.X), new(v.Y), new(v.Z));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> First(in Vector3Wide v) => Vector128.Create(v.X[0], v.Y[0], v.Z[0], 0);

    readonly void Cast<THits>(ref float maximumT, ref THits hits) where THits : struct, IMeshHits, allows ref struct
    {
        // Children that the line meets, see Push.
        var stack = stackalloc ulong[StackSize];
        var stackCount = 0;
        var end = Distance(maximumT);
        // The top of the tree.
        var child = 0;
        while (true)
        {
            if (child >= 0)
            {
                var node = nodes + child;
                var mask = slabs.FindHits(node, start, end, out var begins);
                if (mask != 0)
                {
                    // Most often there is one, and nothing to order.
                    child = (mask & mask - 1) == 0
                        ? node->Pack(BitOperations.TrailingZeroCount(mask))
                        : Push(node, mask, begins - Vector256.Create(start), stack, ref stackCount);
                    continue;
                }
            }
            else
            {
                MeshNode.UnpackLeaf(child, out var place, out var count);
                if (TestLeaf(place, count, ref maximumT, ref hits))
                    end = Distance(maximumT);
            }
            var last = (ulong)BitConverter.SingleToUInt32Bits(end - start) << 32 | uint.MaxValue;
            do
            {
                if (--stackCount < 0)
                    return;
            }
            while (stack[stackCount] > last);
            child = (int)stack[stackCount];
        }
    }

    // The place of a t on the line, or a little beyond.
    readonly float Distance(float t)
    {
        // By the factors that the line itself was made with; the sum may be rounded by as much as boxes are widened.
        var distance = line.Place(new(t))[0];
        return distance + MathF.Abs(distance) * (Slack - 1) + margin;
    }

    // Returns the nearest of several children, and puts the others above what is there, near ones last. Each is one integer: the bits of the distance from
    // the start, which order as it does since it is not negative, and then the child. Which of two is nearer is a coin toss to the branch predictor,
    // but the least of two integers takes no branch.
    static int Push(MeshNode* node, int mask, in Vector256<float> distances, ulong* stack, ref int stackCount)
    {
        var bits = stackalloc uint[MeshNode.Width];
        distances.AsUInt32().Store(bits);
        var bottom = stackCount;
        var count = bottom;
        var nearest = Key(node, BitOperations.TrailingZeroCount(mask), bits);
        for (mask &= mask - 1; mask != 0; mask &= mask - 1)
        {
            var key = Key(node, BitOperations.TrailingZeroCount(mask), bits);
            var far = Math.Max(key, nearest);
            nearest = Math.Min(key, nearest);
            var place = count++;
            for (; place > bottom && stack[place - 1] < far; --place)
                stack[place] = stack[place - 1];
            stack[place] = far;
        }
        stackCount = count;
        return (int)nearest;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static ulong Key(MeshNode* node, int child, uint* bits) => (ulong)bits[child] << 32 | (uint)node->Pack(child);

    // Whether there was a hit.
    readonly bool TestLeaf<THits>(int place, int count, ref float maximumT, ref THits hits) where THits : struct, IMeshHits, allows ref struct
    {
        var allowed = 0;
        for (int i = 0; i < count; ++i)
            allowed |= hits.Allows(triangles.GetNumber(place + i)) ? 1 << i : 0;
        if (allowed == 0)
            return false;
        // Where there are fewer than four, the first takes the place of those that are not there.
        MeshTriangle first = triangles.Get(place), second = triangles.Get(place + (count > 1 ? 1 : 0));
        MeshTriangle third = triangles.Get(place + (count > 2 ? 2 : 0)), fourth = triangles.Get(place + (count > 3 ? 3 : 0));
        var b = Corners(first.B, second.B, third.B, fourth.B);
        var c = Corners(first.C, second.C, third.C, fourth.C);
        var wide = new TriangleWide
        {
            A = Corners(first.A, second.A, third.A, fourth.A),
            B = isMirrored ? c : b,
            C = isMirrored ? b : c,
            TwoSidedMask = twoSided,
        };
        wide.Meet(line, across, upward, out var front, out var back, out var distance);
        var meets = front | back;
        if (Vector.EqualsAll(meets, Vector<int>.Zero))
            return false;
        line.Resolve(distance, Wide.Select(meets, distance, new Vector<float>(float.NaN)), out var hitMask, out _, out var t);
        var hitLanes = (int)hitMask.AsVector128().ExtractMostSignificantBits() & allowed;
        if (hitLanes == 0)
            return false;
        var normals = wide.GetNormal();
        normals = Vector3Wide.Select(back, -normals, normals);
        for (; hitLanes != 0; hitLanes &= hitLanes - 1)
        {
            var lane = BitOperations.TrailingZeroCount(hitLanes);
            if (t[lane] <= maximumT)
                hits.Add(triangles.GetNumber(place + lane), t[lane], new(normals.X[lane], normals.Y[lane], normals.Z[lane]), ref maximumT);
        }
        return true;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    readonly Vector3Wide Corners(int a, int b, int c, int d) => Transpose.FourPoints(
        Vector128.Load(vertices + 3 * a) * scale, Vector128.Load(vertices + 3 * b) * scale,
        Vector128.Load(vertices + 3 * c) * scale, Vector128.Load(vertices + 3 * d) * scale);
}
