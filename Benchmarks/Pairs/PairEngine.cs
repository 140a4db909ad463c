using System;
using System.Numerics;
using Benchmarks.Pairs.Shared;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;

namespace Benchmarks.Pairs;

/// <summary>What differs between engines when pairs are measured: here the step has a shorter way.</summary>
static unsafe class PairEngine
{
    /// <summary>Metres and radians that pairs move by from test to test: more than contacts are carried along for.</summary>
    const float Step = 2e-3f;

    /// <summary>
    /// A test of all pairs as the narrow phase makes it in every step: without the checks of arguments that come from outside, and with
    /// what the last test found, where the pair's test starts from that.
    /// </summary>
    public static Func<int>? CreateStepTest(PairWorld world, PairPlacement[] placements)
    {
        TypedIndex first = world.Shape(placements[0].A), second = world.Shape(placements[0].B);
        CollisionTask task = world.Registry.GetTask(first.Type, second.Type, out int taskIndex, out bool flipped);
        // The first history belongs to no pair.
        world.Pool.Take(placements.Length + 1, out Buffer<PairHistory> histories);
        histories.Clear(0, histories.Length);
        PairPlacement[] moved = Move(placements);
        bool isAway = false;
        return () =>
        {
            isAway = !isAway;
            ReadOnlySpan<PairPlacement> pairs = isAway ? moved : placements;
            var batcher = new CollisionBatcher<PairTally>(world.Pool, world.Shapes, world.Registry, PairWorld.Dt, new PairTally(), histories.Memory);
            for (int i = 0; i < pairs.Length; ++i)
            {
                ref readonly PairPlacement pair = ref pairs[i];
                batcher.Add(task, taskIndex, flipped, world.Shape(pair.A).Index, world.Shape(pair.B).Index, pair.OffsetB,
                    pair.OrientationA, pair.OrientationB, world.Margin, i, task.KeepsHistories ? histories[i + 1].GetReference(i + 1) : PairInput.NoHistory);
            }
            batcher.Flush();
            return batcher.Callbacks.Contacts;
        };
    }

    static PairPlacement[] Move(PairPlacement[] placements)
    {
        var random = new Random(1);
        return Array.ConvertAll(placements, pair => pair with
        {
            OffsetB = pair.OffsetB + Step * PairGeometry.NextDirection(random),
            OrientationA = Turn(pair.OrientationA, random),
            OrientationB = Turn(pair.OrientationB, random),
        });
    }

    static Quaternion Turn(Quaternion orientation, Random random) => Quaternion.Normalize(
        Quaternion.Concatenate(orientation, Quaternion.CreateFromAxisAngle(PairGeometry.NextDirection(random), Step)));
}
