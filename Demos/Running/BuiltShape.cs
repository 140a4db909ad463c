using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;

namespace Demos.Running;

/// <summary>A shape that the engine has.</summary>
/// <param name="Index">Where the engine has it.</param>
/// <param name="Center">Centre of mass in the frame of the scene's shape; the engine's shape has it as its origin.</param>
/// <param name="Volume">Cubic metres.</param>
/// <param name="Inertia">Inertia about the centre for a mass in kilograms.</param>
sealed record BuiltShape(TypedIndex Index, Vector3 Center, double Volume, Func<float, BodyInertia> Inertia);
