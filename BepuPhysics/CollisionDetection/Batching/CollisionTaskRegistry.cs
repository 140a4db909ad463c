using System;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.CompilerServices;

namespace BepuPhysics.CollisionDetection;

/// <summary>Knows which task tests which pair of shape types.</summary>
/// <remarks>Any number of threads may read at once; register tasks before the registry is used.</remarks>
public sealed partial class CollisionTaskRegistry
{
    CollisionTask[] tasks = [];
    // By first and second type id: the index of the task, twice, plus one where the task has the types in the other order; -1 for none.
    short[] references = [];
    int typeSpan;

    /// <summary>What keeps tasks from being registered while a step or a query goes on; of the registry of a simulation.</summary>
    internal WorldLock? World { get; set; }

    /// <summary>Number of tasks.</summary>
    public int TaskCount => tasks.Length;

    /// <summary>A task by its index.</summary>
    public CollisionTask this[int taskIndex]
    {
        get
        {
            if ((uint)taskIndex >= (uint)tasks.Length)
                throw new ArgumentOutOfRangeException(nameof(taskIndex), taskIndex, $"There are {tasks.Length} tasks.");
            return tasks[taskIndex];
        }
    }

    /// <summary>Adds a task, in place of the one that there may be for the same shape types.</summary>
    /// <returns>Index of the task.</returns>
    /// <exception cref="InvalidOperationException">A stage or a query of the simulation is in progress; nothing was changed.</exception>
    public int Register(CollisionTask task)
    {
        ArgumentNullException.ThrowIfNull(task);
        World?.Hold("CollisionTaskRegistry.Register");
        try
        {
            return RegisterUnlocked(task);
        }
        finally
        {
            World?.Release();
        }
    }

    /// <summary>As <see cref="Register"/>, in a change that has begun.</summary>
    internal int RegisterUnlocked(CollisionTask task)
    {
        Grow(Math.Max(task.ShapeTypeIndexA, task.ShapeTypeIndexB) + 1);
        var taskIndex = Find(task.ShapeTypeIndexA, task.ShapeTypeIndexB) >> 1;
        if (taskIndex < 0)
        {
            taskIndex = tasks.Length;
            Array.Resize(ref tasks, taskIndex + 1);
        }
        tasks[taskIndex] = task;
        // The second line first: for two shapes of one type it is the same element, which is in order.
        references[task.ShapeTypeIndexB * typeSpan + task.ShapeTypeIndexA] = (short)(taskIndex * 2 + 1);
        references[task.ShapeTypeIndexA * typeSpan + task.ShapeTypeIndexB] = (short)(taskIndex * 2);
        return taskIndex;
    }

    /// <summary>Finds the task of a pair of shape types, in any order.</summary>
    /// <param name="shapeTypeA">Type id of one shape.</param>
    /// <param name="shapeTypeB">Type id of the other shape.</param>
    /// <param name="task">The task.</param>
    /// <returns>Whether there is one.</returns>
    public bool TryGetTask(int shapeTypeA, int shapeTypeB, [NotNullWhen(true)] out CollisionTask? task)
    {
        var reference = Find(shapeTypeA, shapeTypeB);
        task = reference < 0 ? null : tasks[reference >> 1];
        return task is not null;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal bool TryGetTask(int shapeTypeA, int shapeTypeB, [NotNullWhen(true)] out CollisionTask? task, out int taskIndex, out bool flipped)
    {
        var reference = Find(shapeTypeA, shapeTypeB);
        taskIndex = reference >> 1;
        flipped = (reference & 1) != 0;
        task = reference < 0 ? null : tasks[taskIndex];
        return task is not null;
    }

    /// <summary>Finds the task of a pair of shape types that is known to have one, and whether the types are in its order.</summary>
    /// <exception cref="InvalidOperationException">There is no such task.</exception>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal CollisionTask GetTask(int shapeTypeA, int shapeTypeB, out int taskIndex, out bool flipped)
    {
        var reference = Find(shapeTypeA, shapeTypeB);
        if (reference < 0)
            ThrowUnregistered(shapeTypeA, shapeTypeB);
        taskIndex = reference >> 1;
        flipped = (reference & 1) != 0;
        return tasks[taskIndex];
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    int Find(int shapeTypeA, int shapeTypeB) =>
        (uint)shapeTypeA < (uint)typeSpan && (uint)shapeTypeB < (uint)typeSpan ? references[shapeTypeA * typeSpan + shapeTypeB] : -1;

    void Grow(int span)
    {
        if (span <= typeSpan)
            return;
        var grown = new short[span * span];
        Array.Fill(grown, (short)-1);
        for (int i = 0; i < typeSpan; ++i)
            Array.Copy(references, i * typeSpan, grown, i * span, typeSpan);
        references = grown;
        typeSpan = span;
    }

    [DoesNotReturn]
    void ThrowUnregistered(int shapeTypeA, int shapeTypeB) => throw new InvalidOperationException(
        $"No collision task is registered for {Describe(shapeTypeA)} and {Describe(shapeTypeB)}.{Advise(Math.Max(shapeTypeA, shapeTypeB))}");

    string Describe(int shapeType)
    {
        foreach (var task in tasks)
        {
            if (task.ShapeTypeIndexA == shapeType && task.ShapeTypeIndexB == shapeType)
                return $"{task.Description.Split(' ')[0]} (shape type {shapeType})";
        }
        return $"shape type {shapeType}";
    }
}
