using System;
using System.Numerics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>The edges of a mesh: who is whose neighbour, and how far the surface bends between the two.</summary>
/// <remarks>
/// An angle is a byte q: (q / 254)^2 times 180 degrees, rounded down, so that steps are a tenth of a degree at one degree. Rounded down
/// means that what is touched is never taken for what is behind the neighbour.
/// <para>Half edges are sorted by their lower vertex, by counting, and then by the other one: integers, so the result is the same on
/// every machine.</para>
/// </remarks>
static unsafe class MeshEdges
{
    /// <summary>Bit of a triangle's first vertex, while a mesh is built: the triangle is no surface and not to be in the tree.</summary>
    public const int LeftOut = 1 << 31;
    /// <summary>Byte of an edge without a neighbour.</summary>
    public const byte Free = 255;
    const int Steps = 254;
    // Less than this is flat: what rounding of corners leaves of a plane.
    const double FlatAngle = 1e-4;
    // Sides of a plate may turn to either side by rounding; there is no inside to turn to.
    const double PlateCosine = -.999999;

    // Squared chord 2 - 2 cos of the least angle of each byte; and cosines and sines.
    static readonly double[] Chords = new double[Steps + 1];
    static readonly Vector2[] Turns = MakeTurns();

    static Vector2[] MakeTurns()
    {
        var turns = new Vector2[byte.MaxValue + 1];
        // As flat ones; nobody is there.
        turns[Free] = new(1, 0);
        for (int q = 0; q <= Steps; ++q)
        {
            var angle = Math.PI * q * q / (Steps * Steps);
            var sine = Sine(angle / 2);
            Chords[q] = q == 0 ? 0 : 4 * sine * sine;
            turns[q] = new((float)(1 - 2 * sine * sine), (float)(2 * sine * Sine((Math.PI - angle) / 2)));
        }
        return turns;
    }

    // Series, for up to a right angle: the terms that are left out are below a rounding.
    static double Sine(double angle)
    {
        double term = angle, sum = angle;
        for (int i = 1; i < 14; ++i)
        {
            term *= -angle * angle / (2 * i * (2 * i + 1));
            sum += term;
        }
        return sum;
    }

    /// <summary>Cosine and sine of the angle of a byte; of a free one those of no angle.</summary>
    public static Vector2 Turn(byte edge) => Turns[edge];

    /// <summary>Byte of the greatest angle that is not above that between two unit normals.</summary>
    static byte Quantise(double squaredChord)
    {
        if (squaredChord < FlatAngle * FlatAngle)
            return 0;
        // The angle is at most the chord times pi / 2, and at least the chord: a first guess, and then by comparison.
        var q = (int)(Steps * Math.Sqrt(Math.Sqrt(squaredChord) * (1 / Math.PI)));
        q = Math.Clamp(q, 0, Steps);
        while (q < Steps && Chords[q + 1] <= squaredChord)
            ++q;
        while (q > 0 && Chords[q] > squaredChord)
            --q;
        return (byte)q;
    }

    /// <summary>Finds the neighbours of all triangles and writes the bytes of their edges; leaves out those triangles that are there twice.</summary>
    /// <param name="indices">Three vertices for each triangle; marked where a triangle is left out.</param>
    /// <param name="triangleCount">Number of triangles.</param>
    /// <param name="vertices">Vertices.</param>
    /// <param name="vertexCount">Number of vertices.</param>
    /// <param name="normals">Unit normal of the front of each triangle that is not left out.</param>
    /// <param name="edges">Receives three bytes for each triangle.</param>
    /// <param name="report">Receives the counts.</param>
    /// <param name="pool">Source of temporary memory.</param>
    public static void Find(
        int* indices, int triangleCount, Vector3* vertices, int vertexCount, Vector3* normals, byte* edges, ref MeshReport report, BufferPool pool)
    {
        pool.TakeAtLeast<ulong>(Math.Max(1, 3 * triangleCount), out var halfEdges);
        pool.TakeAtLeast<int>(vertexCount + 1, out var starts);
        SortByLowerVertex(indices, triangleCount, vertexCount, halfEdges.Memory, starts.Memory);
        var mesh = new Surface { Indices = indices, Vertices = vertices, Normals = normals, Edges = edges };
        mesh.FindNeighbours(halfEdges.Memory, starts.Memory, vertexCount);
        if (mesh.Report.DuplicateTriangleCount > 0)
        {
            var duplicateCount = mesh.Report.DuplicateTriangleCount;
            mesh.Report = default;
            mesh.FindNeighbours(halfEdges.Memory, starts.Memory, vertexCount);
            mesh.Report.DuplicateTriangleCount = duplicateCount;
        }
        mesh.Report.DegenerateTriangleCount = report.DegenerateTriangleCount;
        report = mesh.Report;
        pool.Return(ref halfEdges);
        pool.Return(ref starts);
    }

    // A half edge: its higher vertex, then its number, which is that of its first corner.
    static void SortByLowerVertex(int* indices, int triangleCount, int vertexCount, ulong* halfEdges, int* starts)
    {
        new Span<int>(starts, vertexCount + 1).Clear();
        for (int triangle = 0; triangle < triangleCount; ++triangle)
        {
            var corners = indices + 3 * triangle;
            if (corners[0] < 0)
                continue;
            int a = corners[0], b = corners[1], c = corners[2];
            ++starts[a < b ? a : b];
            ++starts[b < c ? b : c];
            ++starts[c < a ? c : a];
        }
        var end = 0;
        for (int vertex = 0; vertex <= vertexCount; ++vertex)
        {
            end += starts[vertex];
            starts[vertex] = end;
        }
        // From the last to the first, so that each vertex's come in order and starts end up as starts.
        for (int triangle = triangleCount - 1; triangle >= 0; --triangle)
        {
            var corners = indices + 3 * triangle;
            if (corners[0] < 0)
                continue;
            var start = 0;
            for (int corner = 2; corner >= 0; --corner)
            {
                var next = corner == 2 ? corners[0] : start;
                start = corners[corner];
                var low = start < next ? start : next;
                halfEdges[--starts[low]] = (ulong)(start < next ? next : start) << 32 | (uint)(3 * triangle + corner);
            }
        }
    }

    struct Surface
    {
        public int* Indices;
        public Vector3* Vertices;
        public Vector3* Normals;
        public byte* Edges;
        public MeshReport Report;

        public void FindNeighbours(ulong* halfEdges, int* starts, int vertexCount)
        {
            for (int vertex = 0; vertex < vertexCount; ++vertex)
            {
                var around = new Span<ulong>(halfEdges + starts[vertex], starts[vertex + 1] - starts[vertex]);
                Sort(around);
                for (int first = 0; first < around.Length;)
                {
                    var end = first + 1;
                    while (end < around.Length && around[end] >> 32 == around[first] >> 32)
                        ++end;
                    Join(around[first..end]);
                    first = end;
                }
            }
        }

        // Most vertices have six. No two keys are equal, so any sort gives the same.
        static void Sort(Span<ulong> keys)
        {
            if (keys.Length > 24)
            {
                keys.Sort();
                return;
            }
            for (int i = 1; i < keys.Length; ++i)
            {
                var key = keys[i];
                var place = i;
                for (; place > 0 && keys[place - 1] > key; --place)
                    keys[place] = keys[place - 1];
                keys[place] = key;
            }
        }

        // Of the half edges between two vertices.
        void Join(Span<ulong> group)
        {
            if (group.Length == 2 && TryJoin((int)group[0], (int)group[1]))
                return;
            // Duplicates that were left out meanwhile go to the end.
            var count = 0;
            for (int i = 0; i < group.Length; ++i)
            {
                var halfEdge = (int)group[i];
                if (Indices[halfEdge - halfEdge % 3] < 0)
                    continue;
                Edges[halfEdge] = Free;
                (group[count], group[i]) = (group[i], group[count]);
                ++count;
            }
            if (count == 1)
                ++Report.BorderEdgeCount;
            if (count < 2 || (count == 2 && TryJoin((int)group[0], (int)group[1])))
                return;
            ++(count == 2 ? ref Report.FlippedEdgeCount : ref Report.CrowdedEdgeCount);
            LeaveOutDuplicates(group[..count]);
        }

        bool TryJoin(int halfEdgeA, int halfEdgeB)
        {
            int triangleA = halfEdgeA / 3, triangleB = halfEdgeB / 3;
            int startA = Indices[halfEdgeA] & ~LeftOut, startB = Indices[halfEdgeB] & ~LeftOut;
            if (startA == startB || Indices[3 * triangleA] < 0 || Indices[3 * triangleB] < 0)
                return false;
            ++Report.SharedEdgeCount;
            Vector3 a = Normals[triangleA], b = Normals[triangleB], start = Vertices[startA], third = Vertices[Third(halfEdgeB)];
            double x = (double)a.X - b.X, y = (double)a.Y - b.Y, z = (double)a.Z - b.Z;
            var squaredChord = x * x + y * y + z * z;
            // The neighbour is behind the plane of A where the surface bends away.
            var height = a.X * ((double)third.X - start.X) + a.Y * ((double)third.Y - start.Y) + a.Z * ((double)third.Z - start.Z);
            var bendsAway = height <= 0 || 1 - squaredChord / 2 < PlateCosine;
            var edge = bendsAway ? Quantise(squaredChord) : (byte)0;
            Edges[halfEdgeA] = edge;
            Edges[halfEdgeB] = edge;
            return true;
        }

        // The corner of a half edge's triangle that is not on it.
        readonly int Third(int halfEdge)
        {
            var first = halfEdge - halfEdge % 3;
            return Indices[first + (halfEdge - first + 2) % 3] & ~LeftOut;
        }

        // Those with the same third corner in the same direction, but for the first.
        void LeaveOutDuplicates(Span<ulong> group)
        {
            var high = group[0] >> 32;
            for (int i = 0; i < group.Length; ++i)
            {
                var halfEdge = (int)group[i];
                var isForward = (ulong)Indices[halfEdge] == high;
                group[i] = (ulong)Third(halfEdge) << 33 | (isForward ? 1ul << 32 : 0) | (uint)halfEdge;
            }
            group.Sort();
            for (int i = 1; i < group.Length; ++i)
            {
                if (group[i] >> 32 != group[i - 1] >> 32)
                    continue;
                var halfEdge = (int)group[i];
                Indices[halfEdge - halfEdge % 3] |= LeftOut;
                ++Report.DuplicateTriangleCount;
            }
            for (int i = 0; i < group.Length; ++i)
                group[i] = high << 32 | (uint)group[i];
            group.Sort();
        }
    }
}
