using System;

namespace Demos.Fuzz;

/// <summary>Kinds of misuse that a run may contain.</summary>
[Flags]
enum FuzzScope
{
    None = 0,
    /// <summary>Handles and references of what was removed, and handles that never were.</summary>
    StaleReferences = 1,
    /// <summary>Calls from callbacks, and from other threads while callbacks run.</summary>
    CallsFromCallbacks = 2,
    /// <summary>Callbacks that return what cannot be.</summary>
    BadCallbacks = 4,
    /// <summary>Callbacks that throw.</summary>
    ThrowingCallbacks = 8,
    /// <summary>Removal of shapes that are in use.</summary>
    UsedShapes = 16,
    /// <summary>Numbers that are no numbers, written through references.</summary>
    DirectWrites = 32,
    /// <summary>Capacities and counts that cannot be.</summary>
    BadCounts = 64,
    /// <summary>Calls after the simulation was disposed.</summary>
    AfterDispose = 128,
    All = 255,
}
