using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;

namespace BepuPhysics.Characters;

/// <summary>What is needed of a character while its contacts are found.</summary>
struct CharacterStep
{
    /// <summary>Upwards, in the world.</summary>
    public Vector3 Up;
    /// <summary>Where it wants to go, in the world, across <see cref="Up"/>; unit length, or zero.</summary>
    public Vector3 Direction;
    /// <summary>Whether it wants to go up steps.</summary>
    public bool WantsSteps;
}

// Before collisions are detected: who wants what. While they are: what each worker has seen.
public sealed partial class CharacterControllers
{
    /// <summary>To be called by the narrow phase callbacks for the contacts of each pair, after they have chosen a material.</summary>
    /// <param name="pair">The pair.</param>
    /// <param name="manifold">Its contacts.</param>
    /// <param name="workerIndex">Index of the worker, as the callbacks were given it.</param>
    /// <param name="materialProperties">The material: it loses its friction where one of the two is a character, which moves by its own force.</param>
    /// <returns>Whether one of the two is a character.</returns>
    public bool TryReportContacts<TManifold>(
        in CollidablePair pair, ref TManifold manifold, int workerIndex, ref PairMaterialProperties materialProperties)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        var indexA = CharacterOf(pair.A);
        var indexB = CharacterOf(pair.B);
        if (indexA < 0 && indexB < 0)
            return false;
        if (indexA >= 0)
            Report(indexA, ref manifold, workerIndex, pair.B, default, 1);
        if (indexB >= 0)
        {
            var bodies = Simulation.Bodies;
            var offsetB = bodies[pair.B.BodyHandle].Pose.Position - bodies[pair.A.BodyHandle].Pose.Position;
            Report(indexB, ref manifold, workerIndex, pair.A, offsetB, -1);
        }
        materialProperties.FrictionCoefficient = 0;
        return true;
    }

    int CharacterOf(CollidableReference collidable) =>
        collidable.Mobility == CollidableMobility.Dynamic ? IndexOf(collidable.BodyHandle) : -1;

    void Report<TManifold>(int index, ref TManifold manifold, int workerIndex, CollidableReference other, Vector3 center, float sign)
        where TManifold : unmanaged, IContactManifold<TManifold>
    {
        // A body that became a character after this step had begun.
        if (index >= stepCount)
            return;
        ref readonly var step = ref steps[index];
        ref readonly var character = ref characters[index];
        var isSupport = character.Supported && character.Support.Packed == other.Packed;
        var leastDepth = isSupport ? character.MinimumSupportContinuationDepth : character.MinimumSupportDepth;
        SupportCandidates found = default;
        for (int i = 0; i < manifold.Count; ++i)
        {
            SupportCandidate contact;
            manifold.GetContact(i, out contact.Offset, out contact.Normal, out contact.Depth, out _);
            contact.Offset -= center;
            contact.Normal *= sign;
            contact.Other = other;
            contact.Exists = true;
            if (Exact.Dot(contact.Normal, step.Up) >= character.CosMaximumSlope)
            {
                if (contact.Depth >= leastDepth)
                    found.Support.Improve(contact, contact.Depth - found.Support.Depth);
            }
            else if (step.WantsSteps && Exact.Dot(contact.Normal, step.Direction) < LeastOpposition)
            {
                found.Obstacle.Improve(contact, Exact.Dot(found.Obstacle.Normal - contact.Normal, step.Direction));
            }
        }
        candidates[workerIndex * stepCount + index].Improve(found, step.Direction);
    }

    // What is in the way by less than this cosine is walked along rather than up.
    const float LeastOpposition = -0.3f;

    int stepCount;

    void PrepareForContacts(float dt, IThreadDispatcher? threadDispatcher)
    {
        workerCount = threadDispatcher?.ThreadCount ?? 1;
        stepCount = characters.Count;
        if (steps.Length < stepCount)
            pool.ResizeToAtLeast(ref steps, stepCount, 0);
        if (candidates.Length < stepCount * workerCount)
            pool.ResizeToAtLeast(ref candidates, stepCount * workerCount, 0);
        if (stepCount > 0)
            candidates.Clear(0, stepCount * workerCount);
        for (int i = 0; i < stepCount; ++i)
        {
            ref var character = ref characters[i];
            var body = BodyOf(character);
            CharacterChecks.Refuse(character);
            WakeForNewGoals(ref character, body);
            ref var step = ref steps[i];
            step.Up = Exact.Rotate(character.LocalUp, body.Pose.Orientation);
            step.Direction = default;
            if (character.TargetVelocity != Vector2.Zero)
            {
                var (right, forwards) = Ground(step.Up, character.ViewDirection);
                step.Direction = Exact.Normalize(right * character.TargetVelocity.X + forwards * character.TargetVelocity.Y);
            }
            step.WantsSteps = character.MaximumStepHeight > 0 && character.Supported && character.TargetVelocity != Vector2.Zero;
        }
    }

    static void WakeForNewGoals(ref CharacterController character, BodyReference body)
    {
        var isNew = character.TargetVelocity != character.LastVelocity || character.TryJump && character.Supported ||
            character.TargetVelocity != Vector2.Zero && character.ViewDirection != character.LastView;
        character.LastVelocity = character.TargetVelocity;
        character.LastView = character.ViewDirection;
        if (isNew && !body.Awake)
            body.Awake = true;
    }

    BodyReference BodyOf(in CharacterController character)
    {
        var bodies = Simulation.Bodies;
        return bodies.BodyExists(character.BodyHandle) ? bodies[character.BodyHandle] : throw Removed(character);
    }

    static InvalidOperationException Removed(in CharacterController character) => new(
        $"{character.BodyHandle} was removed and is still a character: call RemoveCharacterByBodyHandle before the body is removed.");

    void ReturnStepMemory()
    {
        pool.ReturnIfTaken(ref steps);
        pool.ReturnIfTaken(ref candidates);
    }

    // The axes of walking on a surface: right and forwards.
    static (Vector3 Right, Vector3 Forwards) Ground(Vector3 normal, Vector3 view)
    {
        var right = Exact.Cross(view, normal);
        // Straight up or down the surface there is no forwards: any one will do that depends on the surface alone.
        if (!(Exact.LengthSquared(right) > 1e-10f * Exact.LengthSquared(view)))
            right = Exact.Cross(normal.Z * normal.Z < 0.5f ? new(0, 0, -1) : new(0, 1, 0), normal);
        right = Exact.Normalize(right);
        return (right, Exact.Cross(normal, right));
    }
}
