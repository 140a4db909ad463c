using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Lets what moves along with a kinematic body look as far ahead for contacts as it would on one at rest.</summary>
// How far ahead contacts are looked for is how far each body of a pair goes in the step. That is not too much for bodies that keep together: each of them
// may be stopped within the step by what neither of the two has to do with, as the lowest of a heap that falls is by the ground, and then the others come
// nearer by all that they move. But only what is there can stop a body. Where all that bodies may meet, themselves or through each other, moves
// like one rigid body, they are brought to rest relative to that at most, and what counts is how far they go relative to it.
//
// So from each kinematic body whose centre moves (turntables and drums are slow beside trains and ships, and most of what they carry would be gone over for
// nothing) this goes over those whose bounds overlap, from one to the next, until there are no more. If none of them may meet
// anything that does not move along (a static, something asleep, another kinematic body), all of them have their margins by their motion relative to it.
// Otherwise they keep those that they have, which is as it is on the ground.
sealed unsafe partial class CommonMotion(Simulation simulation, BufferPool pool)
{
    // Differences below this part of a speed are rounding.
    const float Rounding = 1f / (1 << 18);

    readonly Simulation simulation = simulation;
    readonly BufferPool pool = pool;
    Buffer<PredictedMotion> motions;
    int count;
    // Indices of bodies that move along with one kinematic body, as far as is known.
    QuickList<int> companions;
    QuickList<int> triangles;

    /// <summary>Room for what each body is expected to do, if a kinematic body moves, or did in the last step; otherwise none.</summary>
    /// <param name="isNeeded">Whether there is to be room.</param>
    internal Buffer<PredictedMotion> Begin(bool isNeeded)
    {
        count = isNeeded ? simulation.Bodies.Awake.Count : 0;
        if (count == 0)
        {
            ReturnMemory();
            return default;
        }
        if (motions.Length < count)
            pool.ResizeToAtLeast(ref motions, count, 0);
        motions.Clear(0, count);
        return motions;
    }

    /// <summary>Writes the margins of what moves along, once all bounds are in the trees.</summary>
    internal void Apply()
    {
        if (count == 0)
            return;
        // In an order that does not depend on where bodies lie: of two that move alike the first tells their margins, to rounding.
        var kinematics = new QuickList<ulong>(8, pool);
        var (isInOrder, last) = (true, 0ul);
        for (int i = 0; i < count; ++i)
        {
            if (!motions[i].Moves || !IsKnown(i))
                continue;
            var key = (ulong)motions[i].Body.Slot << 32 | (uint)i;
            isInOrder &= key >= last;
            last = key;
            kinematics.Add(key, pool);
        }
        if (!isInOrder)
            kinematics.AsSpan().Sort();
        if (kinematics.Count > 0)
        {
            MakeRoomForWitnesses();
            FindNeighbours(kinematics.Count);
        }
        for (int i = 0; i < kinematics.Count; ++i)
            Apply((int)(uint)kinematics[i]);
        ForgetNeighbours();
        kinematics.Dispose(pool);
        count = 0;
    }

    internal void ReturnMemory()
    {
        pool.ReturnIfTaken(ref motions);
        companions.DisposeIfTaken(pool);
        triangles.DisposeIfTaken(pool);
        ForgetWitnesses();
        ForgetNeighbours();
        count = 0;
    }

    internal void Abandon()
    {
        motions = default;
        companions = triangles = foundBy = default;
        witnesses = default;
        neighbours = default;
        firstNeighbours = default;
        count = 0;
    }

    ref BodySet Awake => ref simulation.Bodies.Awake;

    // A game may have added and removed bodies since their motion was predicted.
    bool IsKnown(int body) => body < count && body < Awake.Count && motions[body].Dt > 0 && motions[body].Body == Awake.IndexToHandle[body];

    void Apply(int kinematic)
    {
        var near = new Near { Owner = this, Kinematic = kinematic, Self = kinematic, AllMoveAlong = true };
        companions.Count = 0;
        Find(ref near);
        // Each of those may be with others.
        var moveAlong = near.AllMoveAlong && companions.Count > 0;
        for (int end = companions.Count, i = 0; i < end; ++i)
        {
            ref var motion = ref motions[companions[i]];
            if (motion.Surroundings == PredictedSurroundings.Unknown)
                Spread(kinematic, companions[i]);
            moveAlong &= motion.Surroundings == PredictedSurroundings.MoveAlong;
        }
        // Somebody who does not move along is as far away as the body goes.
        if (moveAlong)
            Awake.Collidables[kinematic].SpeculativeMargin = Margin(kinematic, kinematic);
    }

    void Spread(int kinematic, int body)
    {
        var start = companions.Count;
        if (FindAll(kinematic, body))
        {
            for (int i = start; i < companions.Count; ++i)
                Awake.Collidables[companions[i]].SpeculativeMargin = Margin(companions[i], kinematic);
        }
        companions.Count = start;
    }

    // All that a body may meet, and what these may, behind those that there are; whether nothing is among them that does not move along.
    bool FindAll(int kinematic, int body)
    {
        var near = new Near { Owner = this, Kinematic = kinematic, AllMoveAlong = true };
        var start = companions.Count;
        motions[body].Surroundings = PredictedSurroundings.Sought;
        companions.Add(body, pool);
        foundBy.Count = 0;
        NoteFound(start, start);
        if (!firstNeighbours.Allocated)
            FollowWitnesses(ref near, start);
        for (int i = start; i < companions.Count && near.AllMoveAlong; ++i)
        {
            near.Self = companions[i];
            Find(ref near);
            NoteFound(start, i);
        }
        if (!near.AllMoveAlong && !firstNeighbours.Allocated)
            Remember(near, start);
        for (int i = start; i < companions.Count; ++i)
            motions[companions[i]].Surroundings = near.AllMoveAlong ? PredictedSurroundings.MoveAlong : PredictedSurroundings.Others;
        return near.AllMoveAlong;
    }

    void Find(ref Near near)
    {
        if (firstNeighbours.Allocated)
            AskNeighbours(ref near);
        else
            simulation.BroadPhase.FindOverlapping(BoundsOf(near.Self), ref near);
    }

    BoundingBox BoundsOf(int body)
    {
        simulation.BroadPhase.GetActiveBoundsPointers(Awake.Collidables[body].BroadPhaseIndex, out var min, out var max);
        return new(*min, *max);
    }

    bool MayMeet(int body, CollidableReference other)
    {
        var self = new CollidableReference(CollidableMobility.Dynamic, Awake.IndexToHandle[body]);
        var layers = simulation.Layers;
        return !(layers.IsUsed && !CollisionLayers.MayMeet(layers.Of(self), layers.Of(other))) &&
            !(simulation.Events.UsesSensors && simulation.Events.CountSensors(self, other) > 0);
    }

    // Of a landscape that spans the world only the triangles that are near are in the way.
    bool Reaches(CollidableReference reference, in BoundingBox bounds)
    {
        ref var other = ref simulation.Statics.StaticsBuffer[simulation.Statics.Indices[reference.Slot]];
        if (other.Shape.Type != Mesh.Id)
            return true;
        RigidPose.TransformByInverse((bounds.Min + bounds.Max) * 0.5f, other.Pose, out var center);
        var half = (bounds.Max - bounds.Min) * 0.5f;
        var turn = Quaternion.Conjugate(other.Pose.Orientation);
        half = Vector3.Abs(Exact.Rotate(new Vector3(half.X, 0, 0), turn)) + Vector3.Abs(Exact.Rotate(new Vector3(0, half.Y, 0), turn)) +
            Vector3.Abs(Exact.Rotate(new Vector3(0, 0, half.Z), turn));
        triangles.Count = 0;
        ((Mesh*)simulation.Shapes.GetBatch(Mesh.Id).GetPointer(other.Shape.Index))->FindLocalOverlaps(center - half, center + half, ref triangles, pool);
        return triangles.Count > 0;
    }

    // As the bounds predictor has it, relative to the motion of a rigid body.
    float Margin(int body, int kinematic)
    {
        ref var motion = ref motions[body];
        ref var collidable = ref Awake.Collidables[body];
        float reach = 0;
        if (body != kinematic)
        {
            ref var frame = ref motions[kinematic];
            var turning = MathHelper.Min(Exact.Length(motion.Angular - frame.Angular) * motion.Dt * motion.Radius, motion.Expansion);
            reach = Exact.Length(motion.Linear - VelocityAt(body, kinematic)) * motion.Dt + turning;
            reach = MathHelper.Max(reach, motion.Gain * motion.Dt * PredictedMotion.LeastFall);
        }
        return MathHelper.Max(collidable.MinimumSpeculativeMargin, MathHelper.Min(collidable.MaximumSpeculativeMargin, reach));
    }

    Vector3 VelocityAt(int body, int kinematic)
    {
        ref var frame = ref motions[kinematic];
        return Exact.VelocityAt(frame.Linear, frame.Angular, Awake.MotionStates[body].Pose.Position - Awake.MotionStates[kinematic].Pose.Position);
    }

    bool MovesAlong(int other, int kinematic)
    {
        if (other == kinematic)
            return true;
        if (!IsKnown(other))
            return false;
        ref var motion = ref motions[other];
        ref var frame = ref motions[kinematic];
        var velocity = VelocityAt(other, kinematic);
        return Exact.Length(motion.Linear - velocity) <= Rounding * (Exact.Length(velocity) + Exact.Length(frame.Linear)) &&
            Exact.Length(motion.Angular - frame.Angular) <= Rounding * Exact.Length(frame.Angular);
    }

    // What the bounds of one body overlap.
    struct Near : IBreakableForEach<CollidableReference>
    {
        public CommonMotion Owner;
        public int Kinematic;
        public int Self;
        public bool AllMoveAlong;
        // The last that was met; of a body the one that does not move along, if there is any.
        public CollidableReference Met;

        public bool LoopBody(CollidableReference other)
        {
            Met = other;
            var isKinematic = Self == Kinematic;
            // Kinematic bodies are stopped by nothing, and whose way they are in says so himself.
            if (isKinematic && other.Mobility != CollidableMobility.Dynamic)
                return true;
            if (!Owner.MayMeet(Self, other))
                return true;
            var index = other.Mobility == CollidableMobility.Static || Owner.simulation.Bodies.IsAsleep(other.Slot)
                ? -1 : Owner.simulation.Bodies.Locations[other.Slot].Index;
            if (index == Self)
                return true;
            if (index < 0)
                AllMoveAlong &= other.Mobility == CollidableMobility.Static && !Owner.Reaches(other, Owner.BoundsOf(Self));
            else if (other.Mobility == CollidableMobility.Kinematic)
                AllMoveAlong &= Owner.MovesAlong(index, Kinematic);
            else
                AllMoveAlong &= Add(index, isKinematic);
            // One is enough for a body. Of those that a kinematic one meets each has to be looked at: what it is with may move along though others do not.
            return AllMoveAlong || isKinematic;
        }

        readonly bool Add(int index, bool isStart)
        {
            if (!Owner.IsKnown(index))
                return false;
            ref var surroundings = ref Owner.motions[index].Surroundings;
            if (isStart || surroundings == PredictedSurroundings.Unknown)
            {
                if (!isStart)
                    surroundings = PredictedSurroundings.Sought;
                Owner.companions.Add(index, Owner.pool);
            }
            return surroundings != PredictedSurroundings.Others;
        }
    }
}
