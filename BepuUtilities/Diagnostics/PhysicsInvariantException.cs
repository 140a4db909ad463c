using System;

namespace BepuUtilities.Diagnostics;

/// <summary>Thrown by <see cref="Check"/>: a bug in the library or in the values handed to it, never an expected condition.</summary>
public sealed class PhysicsInvariantException : Exception
{
    /// <summary>Creates the exception.</summary>
    public PhysicsInvariantException(string message) : base(message) { }

    /// <summary>Creates the exception.</summary>
    public PhysicsInvariantException() { }

    /// <summary>Creates the exception.</summary>
    public PhysicsInvariantException(string message, Exception innerException) : base(message, innerException) { }
}
