using System;
using System.Numerics;
using BenchmarkDotNet.Attributes;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;

namespace Benchmarks.Micro;

/// <summary>What it costs to make patches of the contacts of a pair's children, when all of them are tested: nanoseconds per pair.</summary>
public unsafe class ChildBenchmarks : IDisposable
{
    const float Cell = .1f, Depth = 5e-3f, Margin = 1e-2f;

    // Where patches are put, before the children.
    const int Room = PatchSet.Capacity;

    static readonly CollisionTaskRegistry Registry = DefaultTypes.CreateDefaultCollisionTaskRegistry();
    readonly BufferPool pool = new();
    SeamMemory memory;
    ChildResult[] found = [], results = [];
    PlacedChildren[] placed = [];

    /// <summary>What the children are.</summary>
    public enum Kind
    {
        /// <summary>Triangles of a flat mesh, which know their neighbours.</summary>
        Triangles,
        /// <summary>Boxes side by side.</summary>
        Boxes,
    }

    /// <summary>Children that touch a plate.</summary>
    [Params(10, 100, 1000)]
    public int Children { get; set; } = 10;

    /// <summary>Hundredths of them whose normal is not that of the others.</summary>
    [Params(0, 10, 100)]
    public int SuspectPercent { get; set; }

    /// <summary>What the children are.</summary>
    [Params(Kind.Triangles, Kind.Boxes)]
    public Kind Of { get; set; }

    /// <summary>Number of patches of the last call.</summary>
    public int PatchCount { get; private set; }

    /// <summary>Places children below a plate, and makes up what their tests found.</summary>
    [GlobalSetup]
    public void Setup()
    {
        memory = new SeamMemory();
        found = new ChildResult[Children];
        results = new ChildResult[Room + Children];
        placed = new PlacedChildren[Children];
        var random = new Random(1);
        var side = (int)MathF.Ceiling(MathF.Sqrt(Children));
        var plate = new Box((side + 2) * Cell, 1, (side + 2) * Cell);
        var triangle = new Triangle(new(-.5f * Cell, 0, -.5f * Cell), new(.5f * Cell, 0, -.5f * Cell), new(-.5f * Cell, 0, .5f * Cell));
        var box = new Box(Cell, 1, Cell);
        for (int i = 0; i < Children; ++i)
        {
            var height = (Of == Kind.Boxes ? -1 : -.5f) + Depth;
            var offset = new Vector3((i % side - .5f * side) * Cell, height, (i / side - .5f * side) * Cell);
            var shapes = new ChildShapes
            {
                TypeA = Box.TypeId,
                ShapeA = &plate,
                TypeB = Of == Kind.Boxes ? Box.TypeId : Triangle.TypeId,
                ShapeB = Of == Kind.Boxes ? &box : &triangle,
                OffsetB = offset,
                OrientationA = Quaternion.Identity,
                OrientationB = Quaternion.Identity,
                ConeB = Of == Kind.Boxes ? default : new TriangleCone { Cosines = Vector3.One },
            };
            placed[i].Write(shapes, moverIsB: false, Margin);
            // The first is none, and the deepest. What the others are a little less deep along leans by two degrees, anywhere.
            var isSuspect = i > 0 && random.Next(100) < SuspectPercent;
            var (sine, cosine) = MathF.SinCos(random.NextSingle() * MathF.Tau);
            found[i].Children = new(0, i);
            found[i].Manifold.Normal = isSuspect ? Vector3.Normalize(new(.035f * cosine, 1, .035f * sine)) : Vector3.UnitY;
            found[i].Manifold.Count = 3;
            for (int j = 0; j < 3; ++j)
            {
                var corner = j == 0 ? triangle.A : j == 1 ? triangle.B : triangle.C;
                ConvexContactManifold.GetConvexContactReference(ref found[i].Manifold, j) = new()
                {
                    Offset = corner with { Y = -.5f } + offset with { Y = 0 },
                    Depth = Depth - (isSuspect ? .1f : i > 0 ? .01f : 0) * Depth,
                    FeatureId = j,
                };
            }
        }
    }

    /// <summary>Frees what children are joined with.</summary>
    [GlobalCleanup]
    public void Dispose()
    {
        memory.Dispose(pool);
        pool.Clear();
        GC.SuppressFinalize(this);
    }

    /// <summary>From the manifolds of all children to those of patches.</summary>
    [Benchmark]
    public void Join()
    {
        found.CopyTo(results, Room);
        var children = results.AsSpan(Room);
        memory.Begin();
        fixed (ChildResult* first = children)
        fixed (PlacedChildren* places = placed)
        {
            memory.Add(first, places, Children, owner: 0, leavesToNeighbours: false, pool);
            SeamRounds.Run(ref memory, Registry, pool);
        }
        memory.Rank(memory.TouchingOf(memory.Sets[0]), pool);
        PatchCount = PatchSet.Build(ref memory, children, placed, default, results.AsSpan(0, Room), pool);
    }
}
