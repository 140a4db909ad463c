using System;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;

namespace Benchmarks.Pairs.Shared;

/// <summary>The shapes of a file in the engine, and its tests.</summary>
sealed class PairWorld
{
    readonly TypedIndex[] indices;

    public PairWorld(PairFile file)
    {
        Margin = file.Margin;
        Pool = new BufferPool();
        Shapes = new Shapes(Pool, 128);
        Registry = DefaultTypes.CreateDefaultCollisionTaskRegistry();
        indices = file.Shapes.ConvertAll(shape => shape.AddTo(Shapes, Pool)).ToArray();
    }

    public BufferPool Pool { get; }

    public Shapes Shapes { get; }

    public CollisionTaskRegistry Registry { get; }

    /// <summary>Speculative margin, m.</summary>
    public float Margin { get; }

    /// <summary>Seconds of a step; without influence on convex shapes.</summary>
    public const float Dt = 1f / 60;

    /// <summary>The engine's name of a shape of the file.</summary>
    public TypedIndex Shape(int index) => indices[index];

    /// <summary>Tests all pairs, some at a time: a batcher is made for each of these parts, filled and flushed.</summary>
    /// <param name="placements">The pairs.</param>
    /// <param name="fill">How many are tested at a time.</param>
    /// <returns>Contacts of all pairs.</returns>
    public int Test(ReadOnlySpan<PairPlacement> placements, int fill)
    {
        int contacts = 0;
        for (int start = 0; start < placements.Length; start += fill)
        {
            var batcher = new CollisionBatcher<PairTally>(Pool, Shapes, Registry, Dt, new PairTally());
            int end = Math.Min(start + fill, placements.Length);
            for (int i = start; i < end; ++i)
            {
                ref readonly PairPlacement pair = ref placements[i];
                batcher.Add(indices[pair.A], indices[pair.B], pair.OffsetB, pair.OrientationA, pair.OrientationB, Margin, new PairContinuation(i));
            }
            batcher.Flush();
            contacts += batcher.Callbacks.Contacts;
        }
        return contacts;
    }
}
