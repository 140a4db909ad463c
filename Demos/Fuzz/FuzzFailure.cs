using System;

namespace Demos.Fuzz;

/// <summary>The library broke a promise; the message says which.</summary>
sealed class FuzzFailure : Exception
{
    public FuzzFailure(string message, Exception? inner = null) : base(message, inner)
    {
    }
}

/// <summary>What callbacks throw.</summary>
sealed class FuzzCallbackException : Exception
{
    public FuzzCallbackException() : base("thrown by a callback")
    {
    }
}
