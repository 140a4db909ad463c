using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

// Which bodies are hit, or crushed: what sways is let go where any of its bodies is.
//
// What is held is rigid, all the way down to the ground. A blow on it meets one soft contact, that with what comes, and all of it goes into that overlap,
// which throws what came out again: of layers that fall onto each other each leaves the one below as fast as recovery allows, the topmost with as much as all
// of them. What is let go gives way in all of its contacts, and is damped in them.
//
// What lies deep in another is held as deep as it is, since nothing that is held knows overlaps but what is moved out at rest. Once the body above it is let go
// it comes out by its soft contacts, and the one below is let go by that, and so on: a stack that has landed takes itself apart from the top down.
sealed unsafe partial class LoadPathStage
{
    // Steps of acceleration by which a blow makes a body faster: as what is quiet, a quarter of what sways at most. It is what the body gains and not how fast
    // the other comes, so that a light thing does nothing to a heavy one.
    const float BlowSteps = QuietSteps;
    // Overlap of a patch beyond which a body is crushed, per distance from the nearer of the centres: a tenth of its size.
    const float CrushedShare = 0.2f;

    readonly partial struct Motions
    {
        // What nothing moves counts for overlaps alone: what comes down as a whole is brought to rest as a whole.
        public bool IsHit(int body)
        {
            var list = constraints[body];
            for (int i = 0, edge = list.First; i < list.Count; ++i, edge = solver.Edges.Next(edge))
            {
                ref var location = ref solver.Locations[solver.Edges.ConstraintSlot(edge)];
                if (location.TypeId >= ConstraintTypeIds.ContactTypeCount)
                    continue;
                var place = new ContactPlace(solver, ref solver.TypeBatchAt(location), location.IndexInTypeBatch);
                var count = ConstraintTypeIds.ContactCount(location.TypeId);
                var normal = LoadSupport.Three(place.Prestep, ContactPrestepLayout.Normal(count));
                if (IsCrushed(place, count, normal) || (!place.IsFixedB && IsBlow(body, place, count, normal)))
                    return true;
            }
            return false;
        }

        // Whether two bodies meet in this step, and one of them is made faster by that.
        bool IsBlow(int body, in ContactPlace place, int count, Vector3 normal)
        {
            var approach = Exact.Dot(before[place.B].Linear - before[place.A].Linear, normal);
            var change = approach * inertias[body].InverseMass;
            var least = BlowSteps * substepCount * (inertias[place.A].InverseMass + inertias[place.B].InverseMass);
            if (!(change > 0) || change * change <= least * least * Exact.LengthSquared(Gain(body)))
                return false;
            var depth = Depth(place, 0);
            for (int i = 1; i < count; ++i)
                depth = MathHelper.Max(depth, Depth(place, i));
            return depth > -approach * dt * substepCount;
        }

        static bool IsCrushed(in ContactPlace place, int count, Vector3 normal)
        {
            float depth = 0;
            for (int i = 0; i < count; ++i)
                depth += Depth(place, i);
            if (!(depth > 0))
                return false;
            var extent = float.MaxValue;
            for (int i = 0; i < count; ++i)
            {
                var arm = LoadSupport.Three(place.Prestep, i * ContactPrestepLayout.FloatsPerContact);
                extent = MathHelper.Min(extent, MathF.Abs(Exact.Dot(arm, normal)));
                if (!place.IsFixedB)
                    extent = MathHelper.Min(extent, MathF.Abs(Exact.Dot(arm - LoadSupport.Three(place.Prestep, ContactPrestepLayout.OffsetB(count)), normal)));
            }
            // In by more than to a centre, nothing says which way is out: soft contacts would throw it.
            return depth > CrushedShare * count * extent && depth < count * extent;
        }

        static float Depth(in ContactPlace place, int contact) =>
            LoadSupport.Number(place.Prestep, contact * ContactPrestepLayout.FloatsPerContact + ContactPrestepLayout.Depth);
    }
}
