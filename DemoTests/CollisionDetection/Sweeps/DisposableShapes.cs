using System;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace DemoTests.CollisionDetection.Sweeps;

/// <summary>Shapes that go at the end of a test.</summary>
sealed class DisposableShapes(BufferPool pool) : IDisposable
{
    public Shapes Shapes { get; } = new(pool, 1);

    public void Dispose() => Shapes.Dispose();
}
