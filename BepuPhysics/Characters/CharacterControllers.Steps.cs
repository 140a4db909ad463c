using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;

namespace BepuPhysics.Characters;

// Up steps: where something steep is in the way, the shape is swept up, over it and down again. What it would come to stand on there, if anything, supports
// it already now, and raises it while it goes on forwards. Down steps: where the ground is gone, what is below it by no more than a step lets it down.
public sealed partial class CharacterControllers
{
    // How much farther than its own half width a character may go over the edge of a step, to look for ground.
    const float Beyond = 1.05f;
    // So often half as far, where treads are narrow: the next step is in the way, and the edge of this one as good as its top.
    const int WayCount = 3;
    // What is worth rising to, as a part of the greatest height: less is for the contacts.
    const float LeastPart = 1e-3f;

    void FindStep(in CharacterController character, BodyReference body, in CharacterStep step, in SupportCandidates found, float dt, ref Surface surface)
    {
        var reach = new StepReach
        {
            Height = character.MaximumStepHeight,
            CosMaximumSlope = character.CosMaximumSlope,
            IsUpwards = found.Obstacle.Exists || character.Rises,
            IsDownwards = !found.Support.Exists,
        };
        var search = new StepSearch { Characters = this, Character = character, Pose = body.Pose, Step = step, Reach = reach };
        TryUse(body.Collidable.Shape, ref search);
        reach = search.Reach;
        // On the step already.
        if (!reach.Exists || found.Support.Exists && reach.Rise < LeastPart * character.MaximumStepHeight)
            return;
        surface.Contact = new() { Exists = true, Other = reach.Support, Normal = step.Up, Offset = reach.Place - body.Pose.Position };
        surface.Rises = true;
        surface.RisingVelocity = RisingVelocity(character, body, reach.Rise, dt);
    }

    // No faster than it walks, nor, upwards, than the force that holds it can stop on top: v^2 / 2 = a s.
    static float RisingVelocity(in CharacterController character, BodyReference body, float rise, float dt)
    {
        var speed = character.TargetSpeed;
        if (rise < 0)
            return Math.Max(rise / dt, -speed);
        var stopping = MathF.Sqrt(2 * rise * character.MaximumVerticalForce * body.LocalInertia.InverseMass);
        return Math.Min(rise / dt, Math.Min(speed, stopping));
    }

    /// <summary>Looks for a step with the shape of a character.</summary>
    struct StepSearch : IConvexUse
    {
        public CharacterControllers Characters;
        public CharacterController Character;
        public RigidPose Pose;
        public CharacterStep Step;
        public StepReach Reach;

        public void Use<TShape>(in TShape shape) where TShape : unmanaged, IConvexShape => Reach.Find(Characters, shape, Character, Pose, Step);
    }

    /// <summary>Ground that a character can come to by a step up or down.</summary>
    struct StepReach
    {
        /// <summary>Greatest height, m.</summary>
        public float Height;
        /// <summary>Cosine of the steepest slope of the ground.</summary>
        public float CosMaximumSlope;
        /// <summary>Whether to look for a step up.</summary>
        public bool IsUpwards;
        /// <summary>Whether to look for a step down.</summary>
        public bool IsDownwards;
        /// <summary>Whether there is one.</summary>
        public bool Exists;
        /// <summary>How far the character must rise, m.</summary>
        public float Rise;
        /// <summary>Where it will touch the ground, in the world, m.</summary>
        public Vector3 Place;
        /// <summary>What the ground belongs to.</summary>
        public CollidableReference Support;

        public void Find<TShape>(CharacterControllers characters, in TShape shape, in CharacterController character, in RigidPose pose, in CharacterStep step)
            where TShape : unmanaged, IConvexShape
        {
            var forwards = step.Direction * (Beyond * Reach(shape, pose, step.Direction));
            if (IsUpwards)
                FindUpwards(characters, shape, character, pose, step.Up, forwards);
            if (!IsDownwards || Exists)
                return;
            FindBelow(characters, shape, character, pose, step.Up, 0, float.MaxValue);
            // On the edge, which is too steep.
            if (!Exists)
                FindBeyond(characters, shape, character, pose, step.Up, forwards, 0, float.MaxValue, ignoresOverlaps: true);
        }

        void FindUpwards<TShape>(
            CharacterControllers characters, in TShape shape, in CharacterController character, in RigidPose pose, Vector3 up, Vector3 forwards)
            where TShape : unmanaged, IConvexShape
        {
            var highest = Exact.Dot(pose.Position, up) - Reach(shape, pose, -up) + (1 + LeastPart) * Height;
            var lifted = pose;
            var height = Height * characters.Sweep(shape, pose, up * Height, character, ignoresOverlaps: true).T;
            lifted.Position += up * height;
            FindBeyond(characters, shape, character, lifted, up, forwards, height, highest, ignoresOverlaps: false);
        }

        // Where a way forwards ends, or a part of it.
        void FindBeyond<TShape>(CharacterControllers characters, in TShape shape, in CharacterController character, in RigidPose pose,
            Vector3 up, Vector3 forwards, float height, float highest, bool ignoresOverlaps)
            where TShape : unmanaged, IConvexShape
        {
            var way = forwards * characters.Sweep(shape, pose, forwards, character, ignoresOverlaps).T;
            for (int i = 0; i < WayCount && !Exists; ++i)
            {
                var over = pose;
                over.Position += way * (1f / (1 << i));
                FindBelow(characters, shape, character, over, up, height, highest);
            }
        }

        // From a height above where it is to a step below that.
        void FindBelow<TShape>(CharacterControllers characters, in TShape shape, in CharacterController character, in RigidPose pose,
            Vector3 up, float height, float highest)
            where TShape : unmanaged, IConvexShape
        {
            var depth = height + Height;
            var hit = characters.Sweep(shape, pose, up * -depth, character, ignoresOverlaps: false);
            Exists = hit.Exists && hit.T > 0 && Exact.Dot(hit.Normal, up) >= CosMaximumSlope && Exact.Dot(hit.Place, up) <= highest;
            Rise = height - depth * hit.T;
            Place = hit.Place;
            Support = hit.Other;
        }
    }

    NearestHit Sweep<TShape>(
        in TShape shape, in RigidPose pose, Vector3 way, in CharacterController character, bool ignoresOverlaps, bool meetsBodies = false)
        where TShape : unmanaged, IConvexShape
    {
        var self = Simulation.Bodies[character.BodyHandle].CollidableReference;
        var hit = new NearestHit { T = 1, IgnoresOverlaps = ignoresOverlaps, MeetsBodies = meetsBodies, Self = self, Events = Simulation.Events };
        Simulation.Sweep(shape, pose, new BodyVelocity(way), 1, Simulation.Layers[character.BodyHandle], pool, ref hit);
        return hit;
    }

    /// <summary>The first thing that a character would meet: not sensors, nor, where it looks for steps, bodies that can be pushed.</summary>
    struct NearestHit : ISweepHitHandler
    {
        public float T;
        public Vector3 Place;
        public Vector3 Normal;
        public CollidableReference Other;
        public bool Exists;
        public bool IgnoresOverlaps;
        public bool MeetsBodies;
        public CollidableReference Self;
        public CollisionEvents Events;

        public readonly bool AllowTest(CollidableReference collidable) =>
            (MeetsBodies ? collidable != Self : collidable.Mobility != CollidableMobility.Dynamic) && !Events.IsSensor(collidable);

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public void OnHit(ref float maximumT, float t, Vector3 hitLocation, Vector3 hitNormal, CollidableReference collidable)
        {
            // Of hits at the same time, always the same one.
            if (Exists && (t > T || t == T && collidable.Packed > Other.Packed))
                return;
            (T, Place, Normal, Other, Exists) = (t, hitLocation, hitNormal, collidable, true);
            maximumT = t;
        }

        public void OnHitAtZeroT(ref float maximumT, CollidableReference collidable)
        {
            if (IgnoresOverlaps)
                return;
            (T, Exists) = (0, true);
            maximumT = 0;
        }
    }
}
