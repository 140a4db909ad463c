using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

// Friction of a patch that lies on several statics. Each of them has a constraint, with friction of its own; that of all acts in the middle of the contacts
// of all, where the friction of one patch on one static would act. Forces at one point that are each bounded by a coefficient times a load add up to one that
// is bounded by the coefficient times the sum; so do twists, whose levers are distances from that point.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    void JoinFriction(ref StaticPairs statics, in AgreeingBody body, BufferPool pool)
    {
        var wasHeld = false;
        foreach (ref var old in statics.OldOf(body))
            wasHeld |= Column(old).WasHeld;
        for (int i = body.First; i < body.End; ++i)
        {
            ref var pair = ref Waiting(i);
            for (int j = pair.Start; j < pair.End; ++j)
            {
                ref var result = ref ResultOf(i, j);
                if (result.Manifold.Count > 0 && !statics.HasFrictionCenter(pair.Tested.Pair, result.Children))
                    JoinFriction(ref statics, i, j, body.End, wasHeld, pool);
            }
        }
        // What a contact holds that was alone is of before it was.
        foreach (ref var old in statics.OldOf(body))
        {
            if (statics.FrictionCenters.Count > 0)
                Column(old).ForgetTwistWithoutLever();
        }
    }

    static int GroupOfFriction(in StaticPair pair) => pair.Tested.Pair.B.Mobility == CollidableMobility.Static ? 0 : pair.Group;

    ContactConstraint Column(in OldPatch old) => new(Simulation.Solver, old.Constraint, old.ContactCount);

    // All manifolds that have the normal of one, and come after it.
    void JoinFriction(ref StaticPairs statics, int place, int index, int end, bool wasHeld, BufferPool pool)
    {
        var normal = ResultOf(place, index).Manifold.Normal;
        var group = GroupOfFriction(Waiting(place));
        Vector3 all = default, touching = default;
        var squares = 0f;
        var (count, touchCount) = (0, 0);
        var before = statics.FrictionCenters.Count;
        for (int i = place; i < end; ++i)
        {
            ref var pair = ref Waiting(i);
            for (int j = i == place ? index : pair.Start; j < pair.End && GroupOfFriction(pair) == group; ++j)
            {
                ref var result = ref ResultOf(i, j);
                ref var manifold = ref result.Manifold;
                if (manifold.Count == 0 || Exact.Dot(manifold.Normal, normal) < PatchSet.SameNormal ||
                    statics.HasFrictionCenter(pair.Tested.Pair, result.Children))
                    continue;
                for (int k = 0; k < manifold.Count; ++k)
                {
                    var contact = ConvexContactManifold.GetConvexContactReference(ref manifold, k);
                    var arm = manifold.ArmOf(contact);
                    all += arm;
                    squares += Exact.LengthSquared(arm);
                    ++count;
                    var band = wasHeld ? ContactMaterialWide.BandPerExtent * MathF.Abs(Exact.Dot(contact.Offset, normal)) : 0;
                    if (contact.Depth < -band)
                        continue;
                    touching += arm;
                    ++touchCount;
                }
                statics.FrictionCenters.Add(new() { Pair = pair.Tested.Pair, Children = result.Children, Center = manifold.OffsetB }, pool);
            }
        }
        // A patch on one static has its own.
        if (statics.FrictionCenters.Count == before + 1)
        {
            statics.FrictionCenters.Count = before;
            return;
        }
        var center = touchCount > 0 ? touching * (1f / touchCount) : all * (1f / count);
        if (group > 0 && Waiting(place).IsTurning)
        {
            if (IsFootAmongContacts(all * (1f / count), squares * (1f / count), normal))
                return;
            center = default;
        }
        for (int i = before; i < statics.FrictionCenters.Count; ++i)
            statics.FrictionCenters[i].Center = center;
    }

    // What turns has an arm, which takes the only place that a constraint has for a point. But there is one that all parts of a patch know: the foot of the
    // centre of the body. Of what slides on a plane the load is ahead of the foot in the direction in which it slides, so that its friction acts along a line
    // through the foot. What leans on something or hangs has its load elsewhere: its foot has to be as near to the middle of the contacts as these are
    // themselves (root of mean squares), or friction is left to each part.
    static bool IsFootAmongContacts(Vector3 middle, float meanSquare, Vector3 normal)
    {
        var height = Exact.Dot(middle, normal);
        var toMiddle = Exact.LengthSquared(middle);
        return toMiddle - height * height <= meanSquare - toMiddle;
    }
}
