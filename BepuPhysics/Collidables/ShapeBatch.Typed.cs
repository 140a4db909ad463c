using System;
using System.Runtime.CompilerServices;
using BepuUtilities.Diagnostics;
using BepuUtilities.Memory;

namespace BepuPhysics.Collidables;

/// <summary>The shapes of one type, by index.</summary>
/// <typeparam name="TShape">Type of the shapes.</typeparam>
public abstract unsafe class ShapeBatch<TShape> : ShapeBatch where TShape : unmanaged, IShape
{
    private protected Buffer<TShape> shapes;

    /// <summary>Creates an empty batch.</summary>
    /// <param name="pool">Source of the batch's memory.</param>
    /// <param name="initialCapacity">Number of shapes to make room for.</param>
    private protected ShapeBatch(BufferPool pool, int initialCapacity)
        : base(pool, TShape.TypeId, Unsafe.SizeOf<TShape>(), Math.Max(1, initialCapacity)) => ResizeShapes(initialCapacity);

    internal sealed override Type ShapeType => typeof(TShape);

    /// <inheritdoc/>
    public sealed override int Capacity => Math.Min(shapes.Length, SlotCapacity);

    /// <summary>A shape by its index; the reference is valid until a shape is added or the batch is resized.</summary>
    /// <remarks>
    /// A shape may be changed in place between steps. Nothing checks what is written then, and bodies and statics that do not move keep
    /// their old bounds until they are asked to update them.
    /// </remarks>
    /// <exception cref="ArgumentOutOfRangeException">There is no such shape.</exception>
    public ref TShape this[int shapeIndex]
    {
        get
        {
            CheckExists(shapeIndex);
            return ref shapes[shapeIndex];
        }
    }

    /// <summary>Adds a shape.</summary>
    /// <returns>Index of the shape.</returns>
    /// <exception cref="ArgumentException">The shape is not valid.</exception>
    public int Add(in TShape shape)
    {
        using var change = BeginChange("ShapeBatch.Add");
        return AddUnlocked(shape);
    }

    internal int AddUnlocked(in TShape shape)
    {
        // A copy, because the argument may be a slot of this batch that is about to move.
        var copy = shape;
        copy.Validate();
        CheckParts(copy);
        var index = TakeSlot();
        shapes[index] = copy;
        OnAdded(index);
        return index;
    }

    /// <summary>Refuses a shape whose children are none.</summary>
    private protected virtual void CheckParts(in TShape shape) { }

    private protected sealed override void ReturnShapes() => pool.Return(ref shapes);

    /// <summary>A shape that is known to exist, for inner loops.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal ref TShape Get(int shapeIndex)
    {
        Check.That(Holds(shapeIndex));
        return ref shapes.Memory[shapeIndex];
    }

    internal sealed override void* GetPointer(int shapeIndex) => shapes.Memory + shapeIndex;

    private protected sealed override void ResizeShapes(int shapeCapacity)
    {
        pool.ResizeToAtLeast(ref shapes, shapeCapacity, UsedSlotCount);
        ResizeSlots(shapeCapacity);
    }
}
