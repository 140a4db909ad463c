using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// Contacts at rims go to where they will be when they become a constraint: after games, seams and statics side by side have seen them where they are.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // Time from the beginning of the step for which contacts at rims are, s. Substeps see depths as they are when they begin: in the mean that is then.
    float rimTime;
    // Time of the step, s.
    float stepTime;

    void BeginRims(float dt)
    {
        stepTime = dt;
        rimTime = (dt - Simulation.Solver.ForeseeSubstepDt(dt)) * 0.5f;
    }

    // The compound that was asked about last, and whether it has any: a level is asked about again and again.
    struct RimMemory
    {
        public TypedIndex Compound;
        public bool HasRims;
    }

    // Contacts where a pair will touch are those of another time.
    bool MayHaveRims(ref RimMemory memory, in TestedPair tested, TypedIndex shapeA, TypedIndex shapeB) =>
        !tested.IsImpact && (MayHaveRims(ref memory, shapeA) || MayHaveRims(ref memory, shapeB));

    // Of a compound its children say it. Those of many children are not looked at: there are too many.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    bool MayHaveRims(ref RimMemory memory, TypedIndex shape) =>
        shape.Type == Cylinder.Id || (shape.Type == Compound.Id && HasRims(ref memory, shape)) || IsOwnConvex(shape);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    bool IsOwnConvex(TypedIndex shape) => shape.Type > ShapeLimits.LastTypeId && HasCore(shape);

    [MethodImpl(MethodImplOptions.NoInlining)]
    bool HasCore(TypedIndex shape) => ImpactCore.Exists(shape.Type, Simulation.Shapes);

    bool HasRims(ref RimMemory memory, TypedIndex shape)
    {
        if (memory.Compound.Packed == shape.Packed)
            return memory.HasRims;
        memory.Compound = shape;
        memory.HasRims = false;
        ref var compound = ref Simulation.Shapes.GetShape<Compound>(shape.Index);
        for (int i = 0; i < compound.Children.Length; ++i)
            memory.HasRims |= IsRound(compound.Children[i].ShapeIndex);
        return memory.HasRims;
    }

    /// <summary>The contacts of a pair as the solver is to have them.</summary>
    /// <param name="pair">The pair, which may have rims.</param>
    /// <param name="found">Its contacts as they were found.</param>
    /// <param name="moved">Room for others.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    ref readonly ConvexContactManifold AtRims(in CollidablePair pair, in ConvexContactManifold found, ref ConvexContactManifold moved)
    {
        // Of what was tested and does not touch, as most children of two compounds, there is nothing to move.
        if (found.Count == 0 || found.Count > RimContacts.GreatestCount || !(rimTime > 0))
            return ref found;
        var turn = (VelocityOf(pair.A).Angular - VelocityOf(pair.B).Angular) * rimTime;
        if (turn == default)
            return ref found;
        moved = found;
        Simulation.GetPoseAndShape(pair.A, out var poseA, out var shapeA);
        Simulation.GetPoseAndShape(pair.B, out var poseB, out var shapeB);
        MoveRims(found, shapeA, poseA.Orientation, default, found.Normal, turn, ref moved);
        MoveRims(found, shapeB, poseB.Orientation, found.OffsetB, -found.Normal, -turn, ref moved);
        return ref moved;
    }

    void MoveRims(in ConvexContactManifold found, TypedIndex shape, in Quaternion orientation, in Vector3 center, in Vector3 normal, in Vector3 turn,
        ref ConvexContactManifold moved)
    {
        // Capsules are looked at as children alone; see Docs/decisions/rims-ahead.md.
        if (shape.Type == Capsule.Id)
            return;
        if (shape.Type != Compound.Id)
        {
            MoveRims(found, shape, new RigidPose(default, orientation), center, normal, turn, ref moved);
            return;
        }
        ref var compound = ref Simulation.Shapes.GetShape<Compound>(shape.Index);
        for (int i = 0; i < compound.Children.Length; ++i)
        {
            ref var child = ref compound.Children[i];
            if (!IsRound(child.ShapeIndex))
                continue;
            var pose = new RigidPose(Exact.Rotate(child.LocalPosition, orientation), Exact.Concatenate(child.LocalOrientation, orientation));
            MoveRims(found, child.ShapeIndex, pose, center, normal, turn, ref moved);
        }
    }

    bool IsRound(TypedIndex child) => child.Type is Cylinder.Id or Sphere.Id or Capsule.Id || IsOwnConvex(child);

    // What is a sphere by itself turns in its place.
    void MoveRims(in ConvexContactManifold found, TypedIndex shape, in RigidPose pose, in Vector3 center, in Vector3 normal, in Vector3 turn,
        ref ConvexContactManifold moved)
    {
        var shapes = Simulation.Shapes;
        if (shape.Type == Cylinder.Id)
            RimContacts.MoveAhead(found, shapes.GetShape<Cylinder>(shape.Index), pose, center, normal, turn, ref moved);
        else if (shape.Type == Sphere.Id)
            RimContacts.MoveAhead(found, shapes.GetShape<Sphere>(shape.Index).Radius, pose.Position, center, normal, turn, ref moved);
        else if (shape.Type == Capsule.Id)
            RimContacts.MoveAhead(found, shapes.GetShape<Capsule>(shape.Index), pose, center, normal, turn, ref moved);
        else if (IsOwnConvex(shape))
            MoveOwn(found, shape, pose, center, normal, turn, ref moved);
    }

    void MoveOwn(in ConvexContactManifold found, TypedIndex shape, in RigidPose pose, in Vector3 center, in Vector3 normal, in Vector3 turn,
        ref ConvexContactManifold moved)
    {
        var core = ImpactCore.Of(shape.Type, Simulation.Shapes.GetBatch(shape.Type).GetPointer(shape.Index), Simulation.Shapes);
        RimContacts.MoveAhead(found, core, pose, center, normal, turn, ref moved);
    }
}
