using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;

namespace BepuPhysics.CollisionDetection;

// Pairs of islands that wake in the flush. Their contacts are in the solver in this very step, but the tests of the step are over, and with them the questions
// about surfaces: a row of balls that slept would swallow the blow that woke it.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // Nobody else calls back in the flush, so that any worker's number will do.
    void NoteSurfacesOfWoken()
    {
        var woken = Woken.AsSpan();
        woken.Sort();
        for (int i = 0; i < woken.Length; ++i)
        {
            // One for each constraint: a pair may have several.
            if (i > 0 && woken[i] == woken[i - 1])
                continue;
            var pair = PairOf(woken[i]);
            var index = Pairs.Pairs.IndexOf(pair);
            // They may have parted meanwhile.
            if (index < 0)
                continue;
            foreach (ref var manifold in Pairs.ManifoldsOf(index))
            {
                if (!manifold.HasConstraint)
                    continue;
                var contacts = ManifoldOf(pair, manifold);
                NoteSurface(0, pair, isExact: false, 0, ref contacts);
            }
        }
    }

    // As it is in the solver: of the step in which they fell asleep.
    ConvexContactManifold ManifoldOf(in CollidablePair pair, in CachedManifold cached)
    {
        var count = ConstraintTypeIds.ContactCount(cached.ConstraintTypeId);
        var rows = new ContactRows(Simulation.Solver, Simulation.Bodies, cached.Constraint, count);
        var manifold = new ConvexContactManifold { Count = count, Normal = rows.Normal, OffsetB = PositionOf(pair.B) - PositionOf(pair.A) };
        for (int i = 0; i < count; ++i)
        {
            ref var contact = ref ConvexContactManifold.GetConvexContactReference(ref manifold, i);
            (contact.Offset, contact.Depth, contact.FeatureId) = (rows.Arm(i), rows.Depth(i), cached.Features[i]);
        }
        return manifold;
    }

    Vector3 PositionOf(CollidableReference collidable) => collidable.Mobility == CollidableMobility.Static
        ? Simulation.Statics.GetDirectReference(collidable.StaticHandle).Pose.Position
        : Simulation.Bodies.ActiveSet.MotionStates[Simulation.Bodies.Locations[collidable.Slot].Index].Pose.Position;
}
