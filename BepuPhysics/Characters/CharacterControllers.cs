using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.Characters;

/// <summary>Characters that walk, stand on what moves, jump, and go up steps. A guide is in Docs/Guides/Characters.md.</summary>
/// <remarks>
/// In each step it looks at the contacts of its bodies, chooses what each stands on, and drives it along that by a constraint with capped forces.
/// For that the narrow phase callbacks must call <see cref="TryReportContacts"/>, as those of <see cref="CharacterNarrowPhaseCallbacks{TCallbacks}"/> do.
/// One thread at a time, as the simulation. Results depend neither on threads nor on the order in which contacts are reported.
/// </remarks>
public sealed partial class CharacterControllers : IDisposable, IBufferPoolUser
{
    readonly BufferPool pool;
    Simulation? simulation;
    QuickList<CharacterController> characters;
    // By the slot of a body: its character, one up; zero for none.
    Buffer<int> indexOfSlot;
    // What the workers need to know of a character in this step, and what each has found.
    Buffer<CharacterStep> steps;
    Buffer<SupportCandidates> candidates;
    int workerCount;
    bool isDisposed;

    /// <summary>Creates an empty set of characters; <see cref="Initialize"/> says whose they are.</summary>
    /// <param name="pool">Source of memory.</param>
    /// <param name="initialCharacterCapacity">Number of characters to make room for.</param>
    /// <param name="initialBodyHandleCapacity">Number of bodies to make room for.</param>
    public CharacterControllers(BufferPool pool, int initialCharacterCapacity = 16, int initialBodyHandleCapacity = 64)
    {
        ArgumentNullException.ThrowIfNull(pool);
        ArgumentOutOfRangeException.ThrowIfNegative(initialCharacterCapacity);
        ArgumentOutOfRangeException.ThrowIfNegative(initialBodyHandleCapacity);
        this.pool = pool;
        EnsureCapacity(Math.Max(1, initialCharacterCapacity), Math.Max(1, initialBodyHandleCapacity));
        pool.AddUser(this);
    }

    /// <summary>Simulation of the characters.</summary>
    /// <exception cref="InvalidOperationException">There is none yet.</exception>
    public Simulation Simulation => simulation ?? throw new InvalidOperationException("Call Initialize first: there is no simulation yet.");

    /// <summary>Number of characters.</summary>
    public int CharacterCount => characters.Count;

    /// <summary>Says whose characters these are. The narrow phase callbacks' Initialize is a good place, and the ready-made ones call it.</summary>
    /// <exception cref="InvalidOperationException">There is a simulation already.</exception>
    public void Initialize(Simulation simulation)
    {
        ObjectDisposedException.ThrowIf(isDisposed, this);
        ArgumentNullException.ThrowIfNull(simulation);
        if (this.simulation is not null)
            throw new InvalidOperationException("The characters belong to a simulation already.");
        this.simulation = simulation;
        simulation.Solver.Register<StaticCharacterMotion>();
        simulation.Solver.Register<DynamicCharacterMotion>();
        simulation.Timestepper.BeforeCollisionDetection += PrepareForContacts;
        simulation.Timestepper.CollisionsDetected += MoveCharacters;
    }

    /// <summary>A character by its place among all, which changes as characters are removed.</summary>
    /// <remarks>The reference is valid until a character is added or removed.</remarks>
    public ref CharacterController GetCharacterByIndex(int index)
    {
        if ((uint)index >= (uint)characters.Count)
            throw new ArgumentOutOfRangeException(nameof(index), index, $"There are {characters.Count} characters.");
        return ref characters[index];
    }

    /// <summary>Place of the character of a body among all.</summary>
    /// <exception cref="ArgumentException">The body is no character.</exception>
    public int GetCharacterIndexForBodyHandle(int bodyHandle)
    {
        var index = IndexOf(new BodyHandle(bodyHandle));
        return index >= 0 ? index : throw new ArgumentException($"{new BodyHandle(bodyHandle)} is no character.", nameof(bodyHandle));
    }

    /// <summary>The character of a body.</summary>
    /// <remarks>The reference is valid until a character is added or removed.</remarks>
    /// <exception cref="ArgumentException">The body is no character.</exception>
    public ref CharacterController GetCharacterByBodyHandle(BodyHandle bodyHandle) => ref characters[GetCharacterIndexForBodyHandle(bodyHandle.Value)];

    /// <summary>Whether a body is a character.</summary>
    public bool IsCharacter(BodyHandle bodyHandle) => IndexOf(bodyHandle) >= 0;

    /// <summary>Makes a character of a body.</summary>
    /// <remarks>
    /// A body with a convex shape and without inverse inertia, so that it stays upright: <c>new BodyInertia { InverseMass = 1 / mass }</c>. The forces are
    /// chosen by its mass. The reference is valid until a character is added or removed.
    /// </remarks>
    /// <exception cref="ArgumentException">There is no such body, it is kinematic, or a character already; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">A body was removed that is a character still, and this one has its slot; nothing was changed.</exception>
    public ref CharacterController AllocateCharacter(BodyHandle bodyHandle)
    {
        var bodies = Simulation.Bodies;
        if (!bodies.BodyExists(bodyHandle))
            throw new ArgumentException($"There is no {bodyHandle}.", nameof(bodyHandle));
        var inverseMass = bodies[bodyHandle].LocalInertia.InverseMass;
        if (inverseMass == 0)
            throw new ArgumentException($"{bodyHandle} is kinematic: forces do not move it.", nameof(bodyHandle));
        if (IsCharacter(bodyHandle))
            throw new ArgumentException($"{bodyHandle} is a character already.", nameof(bodyHandle));
        // The slot may be that of a body which was removed and is a character still: both would be found at one place.
        if (bodyHandle.Slot < indexOfSlot.Length && indexOfSlot[bodyHandle.Slot] > 0)
            throw Removed(characters[indexOfSlot[bodyHandle.Slot] - 1]);
        EnsureCapacity(characters.Count + 1, bodyHandle.Slot + 1);
        indexOfSlot[bodyHandle.Slot] = characters.Count + 1;
        ref var character = ref characters.AllocateUnsafely();
        character = new()
        {
            BodyHandle = bodyHandle,
            ViewDirection = new(0, 0, -1),
            LocalUp = Vector3.UnitY,
            JumpVelocity = 5,
            MaximumHorizontalForce = 20 / inverseMass,
            MaximumVerticalForce = 100 / inverseMass,
            CosMaximumSlope = 0.7071068f,
            MinimumSupportDepth = -0.002f,
            MinimumSupportContinuationDepth = -0.1f,
        };
        return ref character;
    }

    /// <summary>Makes a mere body of the character at a place; the last one takes that place.</summary>
    /// <exception cref="InvalidOperationException">A step is in progress; nothing was changed.</exception>
    public void RemoveCharacterByIndex(int characterIndex)
    {
        ref var character = ref GetCharacterByIndex(characterIndex);
        Release(ref character);
        indexOfSlot[character.BodyHandle.Slot] = 0;
        characters.FastRemoveAt(characterIndex);
        if (characterIndex < characters.Count)
            indexOfSlot[characters[characterIndex].BodyHandle.Slot] = characterIndex + 1;
    }

    /// <summary>Makes a mere body of a character. Before its body is removed.</summary>
    /// <exception cref="ArgumentException">The body is no character.</exception>
    /// <exception cref="InvalidOperationException">A step is in progress; nothing was changed.</exception>
    public void RemoveCharacterByBodyHandle(BodyHandle bodyHandle) => RemoveCharacterByIndex(GetCharacterIndexForBodyHandle(bodyHandle.Value));

    /// <summary>Makes room, and keeps what there is.</summary>
    /// <param name="characterCapacity">Number of characters to make room for.</param>
    /// <param name="bodyHandleCapacity">Number of bodies to make room for.</param>
    public void EnsureCapacity(int characterCapacity, int bodyHandleCapacity)
    {
        if (!characters.Span.Allocated)
            characters = new(Math.Max(1, characterCapacity), pool);
        else if (characters.Span.Length < characterCapacity)
            characters.EnsureCapacity(characterCapacity, pool);
        var hadCount = indexOfSlot.Allocated ? indexOfSlot.Length : 0;
        if (hadCount >= bodyHandleCapacity)
            return;
        pool.ResizeToAtLeast(ref indexOfSlot, bodyHandleCapacity, hadCount);
        indexOfSlot.Clear(hadCount, indexOfSlot.Length - hadCount);
    }

    /// <summary>Gives all memory back and lets go of the simulation, in which the bodies stay as mere bodies.</summary>
    /// <exception cref="InvalidOperationException">A step is in progress.</exception>
    public void Dispose()
    {
        if (isDisposed)
            return;
        if (simulation is { IsEnding: false })
        {
            foreach (ref var character in characters.Span.AsSpan()[..characters.Count])
                Release(ref character);
        }
        isDisposed = true;
        if (simulation is not null)
        {
            simulation.Timestepper.BeforeCollisionDetection -= PrepareForContacts;
            simulation.Timestepper.CollisionsDetected -= MoveCharacters;
        }
        pool.RemoveUser(this);
        characters.Dispose(pool);
        pool.Return(ref indexOfSlot);
        ReturnStepMemory();
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    int IndexOf(BodyHandle bodyHandle)
    {
        var slot = bodyHandle.Slot;
        if ((uint)slot >= (uint)indexOfSlot.Length)
            return -1;
        var index = indexOfSlot[slot] - 1;
        return index >= 0 && characters[index].BodyHandle == bodyHandle ? index : -1;
    }

    // Takes the constraint of a character away; its body may have taken it along.
    void Release(ref CharacterController character)
    {
        if (character.Supported && Simulation.Solver.ConstraintExists(character.MotionConstraintHandle))
            Simulation.Solver.Remove(character.MotionConstraintHandle);
        character.Supported = false;
    }

    void IBufferPoolUser.CheckNotBusy() { }

    void IBufferPoolUser.ForgetMemory()
    {
        isDisposed = true;
        characters = default;
        (indexOfSlot, steps, candidates) = (default, default, default);
    }
}
