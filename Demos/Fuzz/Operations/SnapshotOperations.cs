using System;
using System.Collections.Generic;
using BepuPhysics;

namespace Demos.Fuzz.Operations;

/// <summary>Snapshots, and what goes on from them.</summary>
static class SnapshotOperations
{
    const int MaximumSteps = 6;

    public static FuzzOperation[] All { get; } =
    [
        new("Simulation.Save", 4, w => w.Saved.Save(w)),
        new("Simulation.Restore", 4, w => w.Saved.Restore(w)),
        new("Simulation.Restore of bytes", 2, RestoreBytes),
        new("Simulation.Restore of damaged bytes", 2, RestoreDamaged),
        new("Steps that are taken twice", 4, StepTwice),
    ];

    static void RestoreBytes(FuzzWorld w)
    {
        using var snapshot = new SimulationSnapshot(w.Pool);
        w.Simulation.Save(snapshot);
        var (state, hash) = (FuzzFingerprint.OfSnapshot(w.Simulation), w.Simulation.StateHash());
        using var loaded = new SimulationSnapshot(w.Pool);
        loaded.ReadFrom(Bytes(snapshot));
        w.Simulation.Restore(loaded);
        Require(state, FuzzFingerprint.OfSnapshot(w.Simulation), "the state after loading");
        Require(hash, w.Simulation.StateHash(), "the hash after loading");
    }

    static byte[] Bytes(SimulationSnapshot snapshot)
    {
        var bytes = new byte[snapshot.SerializedByteCount];
        snapshot.WriteTo(bytes);
        return bytes;
    }

    static void RestoreDamaged(FuzzWorld w)
    {
        using var snapshot = new SimulationSnapshot(w.Pool);
        w.Simulation.Save(snapshot);
        var bytes = Bytes(snapshot);
        if (w.Random.Percent(30))
            bytes = bytes[..w.Random.Below(bytes.Length)];
        else
            bytes[w.Random.Below(bytes.Length)] ^= (byte)(1 << w.Random.Below(8));
        try
        {
            snapshot.ReadFrom(bytes);
        }
        catch (ArgumentException)
        {
            return;
        }
        throw new FuzzFailure("damaged bytes were taken");
    }

    // From one state the same steps end in the same state, with one thread and with several.
    static void StepTwice(FuzzWorld w)
    {
        using var snapshot = new SimulationSnapshot(w.Pool);
        w.Simulation.Save(snapshot);
        var count = 1 + w.Random.Below(MaximumSteps);
        w.Tell($"{count} steps");
        var dispatcher = w.AnyDispatcher();
        List<ulong> first = Step(w, count, () => w.Simulation.Timestep(1 / 60f, dispatcher));
        w.Simulation.Restore(snapshot);
        List<ulong> second = Step(w, count, () => w.Simulation.Timestep(1 / 60f));
        for (int i = 0; i < count; ++i)
            Require(first[i], second[i], $"step {i} of {count}");
    }

    static List<ulong> Step(FuzzWorld w, int count, Action step)
    {
        var hashes = new List<ulong>();
        for (int i = 0; i < count; ++i)
        {
            w.Look(step, looksAtInertias: true);
            w.StoppedCount += w.Simulation.Quarantine.Count;
            hashes.Add(w.Simulation.StateHash());
        }
        return hashes;
    }

    static void Require(ulong expected, ulong actual, string what)
    {
        if (expected != actual)
            throw new FuzzFailure($"{what} has other bits after a restore");
    }
}
