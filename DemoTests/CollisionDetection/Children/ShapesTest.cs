using System;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.Support;

namespace DemoTests.CollisionDetection.Children;

/// <summary>Shapes, what tests them with each other, and chance; at the end a test has removed all that owns memory.</summary>
public abstract class ShapesTest : IDisposable
{
    private protected readonly BufferPool pool = new();
    private protected readonly Shapes shapes;
    private protected readonly CollisionTaskRegistry registry = DefaultTypes.CreateDefaultCollisionTaskRegistry();
    private protected readonly Random random;

    private protected ShapesTest(int seed)
    {
        shapes = new Shapes(pool, 1);
        random = new Random(LevelSeeds.Of(seed));
    }

    /// <summary>Removes what a test leaves.</summary>
    private protected virtual void RemoveShapes() { }

    public void Dispose()
    {
        RemoveShapes();
        shapes.Dispose();
        pool.AssertEmpty();
        pool.Clear();
        GC.SuppressFinalize(this);
    }
}
