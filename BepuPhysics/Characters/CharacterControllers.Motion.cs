using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.Characters;

// When collisions have been detected: what each stands on, and how it moves over that. In the order of characters, on one thread: constraints come and go.
public sealed partial class CharacterControllers
{
    void MoveCharacters(float dt, IThreadDispatcher? threadDispatcher)
    {
        for (int i = 0; i < stepCount; ++i)
        {
            ref var character = ref characters[i];
            var body = BodyOf(character);
            // What sleeps has no contacts in this step, and keeps what it stands on.
            if (!body.Awake)
                continue;
            var found = candidates[i];
            for (int worker = 1; worker < workerCount; ++worker)
                found.Improve(candidates[worker * stepCount + i], steps[i].Direction);
            var surface = new Surface { Contact = found.Support };
            if (steps[i].WantsSteps && (found.Obstacle.Exists || character.Rises || !found.Support.Exists))
                FindStep(character, body, steps[i], found, dt, ref surface);
            Move(ref character, body, steps[i], surface, dt);
        }
    }

    /// <summary>What a character stands on in this step.</summary>
    struct Surface
    {
        /// <summary>The contact, found or foreseen.</summary>
        public SupportCandidate Contact;
        /// <summary>Whether the character rises to it, and how fast, m/s.</summary>
        public bool Rises;
        public float RisingVelocity;
    }

    void Move(ref CharacterController character, BodyReference body, in CharacterStep step, in Surface surface, float dt)
    {
        var jumps = character.TryJump && surface.Contact.Exists;
        character.TryJump = false;
        character.Rises = surface.Rises && !jumps;
        if (jumps)
            Jump(character, body, step.Up, surface.Contact);
        if (jumps || !surface.Contact.Exists)
        {
            Release(ref character);
            SteerInAir(character, body, step, dt);
            return;
        }
        var support = surface.Contact.Other;
        var isKept = IsMovedOver(character, support);
        if (!isKept)
            Release(ref character);
        var solver = Simulation.Solver;
        var motion = MotionOver(surface, character, body);
        if (!IsBody(support))
        {
            if (isKept)
                solver.ApplyDescriptionWithoutWaking(character.MotionConstraintHandle, motion);
            else
                character.MotionConstraintHandle = solver.Add(character.BodyHandle, motion);
        }
        else
        {
            var motionOfBoth = new DynamicCharacterMotion(motion, OffsetFromSupport(body, surface.Contact));
            if (isKept)
                solver.ApplyDescriptionWithoutWaking(character.MotionConstraintHandle, motionOfBoth);
            else
                character.MotionConstraintHandle = solver.Add(character.BodyHandle, support.BodyHandle, motionOfBoth);
        }
        character.Supported = true;
        character.Support = support;
    }

    static bool IsBody(CollidableReference collidable) => collidable.Mobility != CollidableMobility.Static;

    // Whether the constraint of the last step will do: all statics are one to it, and of bodies it knows its own.
    bool IsMovedOver(in CharacterController character, CollidableReference support) =>
        character.Supported && IsBody(character.Support) == IsBody(support) &&
        (!IsBody(support) || character.Support.BodyHandle == support.BodyHandle) &&
        Simulation.Solver.ConstraintExists(character.MotionConstraintHandle);

    static StaticCharacterMotion MotionOver(in Surface surface, in CharacterController character, BodyReference body) => new()
    {
        SurfaceBasis = Basis(surface.Contact.Normal, character.ViewDirection),
        MaximumHorizontalForce = character.MaximumHorizontalForce,
        MaximumVerticalForce = character.MaximumVerticalForce,
        TargetVelocity = character.TargetVelocity,
        Depth = surface.Contact.Depth,
        RisingVelocity = surface.RisingVelocity,
        MaximumRisingForce = RisingForce(surface, body),
        OffsetFromCharacterToSupportPoint = surface.Contact.Offset,
    };

    // Whatever it takes, to any speed that a step asks for.
    static float RisingForce(in Surface surface, BodyReference body) => surface.Rises ? 1e4f / body.LocalInertia.InverseMass : 0;

    Vector3 OffsetFromSupport(BodyReference body, in SupportCandidate contact) =>
        body.Pose.Position + contact.Offset - Simulation.Bodies[contact.Other.BodyHandle].Pose.Position;

    // X to the right, Y along the normal, Z backwards.
    static Quaternion Basis(Vector3 normal, Vector3 view)
    {
        var (right, forwards) = Ground(normal, view);
        Matrix3x3 basis;
        basis.X = right;
        basis.Y = normal;
        basis.Z = -forwards;
        return QuaternionEx.CreateFromRotationMatrix(basis);
    }

    // Only towards where it wants to go, so that a fast jump is not braked by walking on.
    static void SteerInAir(in CharacterController character, BodyReference body, in CharacterStep step, float dt)
    {
        var missing = character.TargetSpeed - Exact.Dot(body.Velocity.Linear, step.Direction);
        if (missing > 0)
            body.Velocity.Linear += step.Direction * Math.Min(missing, character.MaximumAirForce * body.LocalInertia.InverseMass * dt);
    }

    /// <summary>Leaves the ground at the speed of a jump, relative to it; what it stands on gets the opposite impulse.</summary>
    void Jump(in CharacterController character, BodyReference body, Vector3 up, in SupportCandidate contact)
    {
        var ground = Vector3.Zero;
        var offset = Vector3.Zero;
        if (IsBody(contact.Other))
        {
            offset = OffsetFromSupport(body, contact);
            Simulation.Bodies[contact.Other.BodyHandle].GetVelocityForOffset(offset, out ground);
        }
        var gain = Math.Max(0, character.JumpVelocity - Exact.Dot(body.Velocity.Linear - ground, up));
        body.Velocity.Linear += up * gain;
        if (contact.Other.Mobility == CollidableMobility.Dynamic)
            Simulation.Bodies[contact.Other.BodyHandle].ApplyImpulse(up * (-gain / body.LocalInertia.InverseMass), offset);
    }
}
