using System;

namespace Benchmarks.Compare;

/// <summary>A comparison that cannot be made, for a reason that the message says.</summary>
sealed class CompareException(string message) : Exception(message);
