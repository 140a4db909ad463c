using System;

namespace Demos.Fuzz;

/// <summary>One kind of call to the library.</summary>
/// <param name="Name">As it is printed.</param>
/// <param name="Weight">How often it is drawn, relative to the others.</param>
/// <param name="Run">Draws the arguments, and calls. What comes before the one call that may be refused must change nothing.</param>
sealed record FuzzOperation(string Name, int Weight, Action<FuzzWorld> Run);
