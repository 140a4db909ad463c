using System;
using System.Diagnostics.CodeAnalysis;
using System.Numerics;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Conditions of <see cref="Simulation.Validate"/>, checked in release builds too. Nothing is formatted unless one fails.</summary>
static class Invariant
{
    internal static void Require([DoesNotReturnIf(false)] bool condition, string what, int where)
    {
        if (!condition)
            throw new PhysicsInvariantException($"Wrong {what} ({where}).");
    }

    internal static void Require([DoesNotReturnIf(false)] bool condition, string what, int where, int part)
    {
        if (!condition)
            throw new PhysicsInvariantException($"Wrong {what} ({where}, {part}).");
    }

    static void RequireId([DoesNotReturnIf(false)] bool condition, string fault, string what, int id)
    {
        if (!condition)
            throw new PhysicsInvariantException($"Wrong {fault} of {what} ({id}).");
    }

    internal static void Finite(Vector3 value, string what, int where)
    {
        if (!float.IsFinite(value.X) || !float.IsFinite(value.Y) || !float.IsFinite(value.Z))
            throw new PhysicsInvariantException($"The {what} ({where}) is not finite: {value}.");
    }

    internal static void Finite(Quaternion value, string what, int where)
    {
        if (!float.IsFinite(value.X) || !float.IsFinite(value.Y) || !float.IsFinite(value.Z) || !float.IsFinite(value.W))
            throw new PhysicsInvariantException($"The {what} ({where}) is not finite: {value}.");
    }

    /// <summary>Every id below the pool's next one is either free, once, or in use; none beyond is in use.</summary>
    internal static void Ids(in IdPool ids, int idSpan, string what, Func<int, bool> isInUse)
    {
        var issued = ids.HighestPossiblyClaimedId + 1;
        // Managed memory, so that a failure leaves no pool with a debt.
        var free = new bool[issued];
        for (int i = 0; i < ids.AvailableIdCount; ++i)
        {
            var id = ids.AvailableIds[i];
            RequireId((uint)id < (uint)issued, "free id", what, id);
            RequireId(!free[id], "twice free id", what, id);
            free[id] = true;
        }
        for (int id = 0; id < issued; ++id)
            RequireId(isInUse(id) != free[id], "state of the id", what, id);
        for (int id = issued; id < idSpan; ++id)
            RequireId(!isInUse(id), "use of an id that was not given out", what, id);
    }
}
