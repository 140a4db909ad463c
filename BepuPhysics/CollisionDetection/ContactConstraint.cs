using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>The column of one convex contact constraint in its type batch, for any number of contacts.</summary>
unsafe readonly struct ContactConstraint
{
    readonly float* prestep;
    readonly float* impulses;
    readonly int* referenceB;
    readonly int contactCount;
    readonly bool hasTwoBodies;

    internal ContactConstraint(Solver solver, ConstraintHandle handle, int contactCount)
    {
        ref var location = ref solver.Locations[handle.Slot];
        ref var batch = ref solver.TypeBatchAt(location);
        var processor = solver.Processor(location.TypeId);
        prestep = (float*)Unsafe.AsPointer(ref processor.PrestepFloat(ref batch, location.IndexInTypeBatch, 0));
        impulses = (float*)Unsafe.AsPointer(ref processor.Impulse(ref batch, location.IndexInTypeBatch, 0));
        this.contactCount = contactCount;
        hasTwoBodies = location.TypeId >= ConstraintTypeIds.ContactTwoBody;
        if (hasTwoBodies)
            referenceB = (int*)Unsafe.AsPointer(ref processor.BodyReference(ref batch, location.IndexInTypeBatch, 1));
    }

    /// <summary>Asks the processor to load the column. Changes no result.</summary>
    internal void Prefetch()
    {
        Prefetch(prestep, ContactPrestepLayout.PrestepFloats(contactCount));
        Prefetch(impulses, ContactPrestepLayout.ImpulseFloats(contactCount));
    }

    static void Prefetch(float* column, int count)
    {
        const int line = 64 / sizeof(float);
        for (int i = 0; i < count * Vector<float>.Count; i += line)
            BepuUtilities.Memory.Prefetch.Read(column + i);
    }

    /// <summary>Writes the contacts of a step over those of the last one, of which there were as many, and hands on their impulses.</summary>
    /// <param name="manifold">The contacts.</param>
    /// <param name="material">How the surfaces behave.</param>
    /// <param name="frictionCenter">
    /// Where friction acts of a patch on several things that do not give way, relative to the centre of A; zero for one on one.
    /// </param>
    /// <param name="features">What the contacts are remembered by.</param>
    internal void Update(in ConvexContactManifold manifold, in PairMaterialProperties material, in Vector3 frictionCenter, ref FeatureIds features)
    {
        var wasHeld = WasHeld;
        var landing = Landing;
        var knewB = KnowsB;
        WriteMaterial(material, frictionCenter, wasHeld, landing);
        if (KeptArms.MayKeep(contactCount, manifold, wasHeld, hasTwoBodies))
        {
            ReadArms(features, knewB, out var arms);
            Unsafe.SkipInit(out KeptArms kept);
            if (kept.TryFind(arms, manifold))
            {
                if (kept.HasMoved)
                    Turn(ref arms, kept, manifold);
                Keep(arms, ref kept, manifold, ref features);
                if (!knewB || frictionCenter != default)
                    WriteOffsetB(manifold, frictionCenter);
                else if ((kept.HasMoved || Exact.DistanceSquared(arms.Normal, manifold.Normal) > StillNormal * StillNormal) && IsOnKinematic)
                    Write(ContactPrestepLayout.OffsetB(contactCount), manifold.OffsetB - kept.Drift(arms, manifold));
                return;
            }
        }
        ReadPatch(features, out var old);
        old.KnowsB = knewB;
        WriteGeometry(manifold, frictionCenter);
        WriteImpulses(old, manifold, frictionCenter, ref features);
    }

    /// <summary>Writes the contacts of a step to a constraint that is new.</summary>
    /// <param name="old">What an earlier constraint of the same manifold held; it may have had another number of contacts, or none.</param>
    /// <param name="manifold">The contacts.</param>
    /// <param name="material">How the surfaces behave.</param>
    /// <param name="frictionCenter">
    /// Where friction acts of a patch on several things that do not give way, relative to the centre of A; zero for one on one.
    /// </param>
    /// <param name="features">What the contacts are remembered by.</param>
    internal void WriteNew(
        ref ContactPatch old, in ConvexContactManifold manifold, in PairMaterialProperties material, in Vector3 frictionCenter, ref FeatureIds features)
    {
        WriteMaterial(material, frictionCenter, old.WasHeld, old.Count > 0 ? old.Landing : 0);
        WriteGeometry(manifold, frictionCenter);
        if (KeptArms.MayKeep(old.Count, manifold, old.WasHeld, old.KnowsB))
        {
            old.GetArms(out var arms);
            Unsafe.SkipInit(out KeptArms kept);
            if (kept.TryFind(arms, manifold))
            {
                if (kept.HasMoved)
                    kept.Turn(ref arms, manifold);
                var drift = kept.Drift(arms, manifold);
                for (int i = 0; i < contactCount; ++i)
                    WriteArm(i, kept.Places[i] < 0 ? manifold.Read(i).Offset - drift : arms[kept.Places[i]]);
                if (old.KnowsB && frictionCenter == default)
                    Write(ContactPrestepLayout.OffsetB(contactCount), arms.OffsetB);
                float load = 0;
                for (int i = 0; i < old.Count; ++i)
                    load += old.Normals[i];
                old.Friction += TurnedForce(old.Normal, manifold.Normal, load);
            }
        }
        WriteImpulses(old, manifold, frictionCenter, ref features);
    }

    /// <summary>Takes back what a contact that is alone holds against turning, but for one that shares the friction of several: it has no lever.</summary>
    internal void ForgetTwistWithoutLever()
    {
        if (contactCount == 1 && (KnowsB || Read(prestep, ContactPrestepLayout.OffsetB(contactCount)) == default))
            impulses[(ContactPrestepLayout.FrictionImpulse(contactCount) + 3) * Vector<float>.Count] = 0;
    }

    /// <summary>Whether the load path held the patch in the last step.</summary>
    internal bool WasHeld => float.IsNegative(prestep[ContactPrestepLayout.Spring(contactCount) * Vector<float>.Count]);

    // How far the patch is in landing; see ContactMaterialWide.Landing.
    float Landing => prestep[ContactPrestepLayout.Spring(contactCount) * Vector<float>.Count] == 0
        ? MathF.Abs(prestep[ContactPrestepLayout.Damping(contactCount) * Vector<float>.Count]) : 0;

    // Whether the place of B is written, and not that of friction; see ContactMaterialWide.SharesFriction.
    bool KnowsB => hasTwoBodies && !float.IsNegative(prestep[ContactPrestepLayout.Friction(contactCount) * Vector<float>.Count]);

    // How far a normal turns in a step that has been turned by a deck, and not by what lies at rest: .012 rad/s at 60 steps a second.
    const float StillNormal = 2e-4f;

    // What no load moves leans for none: of the place of its centre all that counts is how fast its surface moves where the contacts are. On a deck that rolls
    // that is another one when the arms have turned.
    bool IsOnKinematic => hasTwoBodies && (*referenceB & EncodedBody.KinematicFlag) != 0;

    void Turn(ref OldArms arms, in KeptArms kept, in ConvexContactManifold manifold)
    {
        if (!kept.Turn(ref arms, manifold))
            return;
        for (int i = 0; i < contactCount; ++i)
            WriteArm(i, arms[i]);
        if (arms.KnowsB)
            Write(ContactPrestepLayout.OffsetB(contactCount), arms.OffsetB);
    }

    // Contacts stay in the order in which they are: the order in which they are solved makes a difference that can be seen.
    void Keep(in OldArms arms, ref KeptArms kept, in ConvexContactManifold manifold, ref FeatureIds features)
    {
        if (kept.Count < contactCount)
            WriteMissingArms(arms, ref kept, manifold);
        float load = 0;
        for (int i = 0; i < contactCount; ++i)
        {
            ref readonly var contact = ref manifold.Read(i);
            WriteDepth(kept.Places[i], contact.Depth);
            features[kept.Places[i]] = contact.FeatureId;
            load += impulses[i * Vector<float>.Count];
        }
        Write(ContactPrestepLayout.Normal(contactCount), manifold.Normal);
        var friction = ContactPrestepLayout.FrictionImpulse(contactCount);
        WriteFriction(Read(impulses, friction) + TurnedForce(arms.Normal, manifold.Normal, load), manifold.Normal);
    }

    // A contact that is elsewhere takes the nearest place that is left, with the impulse there.
    void WriteMissingArms(in OldArms arms, ref KeptArms kept, in ConvexContactManifold manifold)
    {
        var drift = kept.Drift(arms, manifold);
        for (int i = 0; i < contactCount; ++i)
        {
            if (kept.Places[i] >= 0)
                continue;
            var arm = manifold.Read(i).Offset - drift;
            var place = arms.FindNearest(kept.Taken, arm);
            kept.Places[i] = place;
            kept.Taken |= 1 << place;
            WriteArm(place, arm);
        }
    }

    // The force of a kept patch points where it did, while its normal turns with the bodies: what that leaves of the normal force is friction. A load that
    // turned with its box would push a column to the side to which it leans, for as long as friction takes to notice.
    static Vector3 TurnedForce(Vector3 oldNormal, Vector3 normal, float load) => (oldNormal - normal) * load;

    // Of surfaces that are apart the arms of either body end at its own; see ArmOf.
    void WriteGeometry(in ConvexContactManifold manifold, in Vector3 frictionCenter)
    {
        ref var contacts = ref Unsafe.AsRef(in manifold.Contact0);
        for (int i = 0; i < contactCount; ++i)
        {
            ref var contact = ref Unsafe.Add(ref contacts, i);
            WriteArm(i, manifold.ArmOf(contact));
            WriteDepth(i, contact.Depth);
        }
        WriteOffsetB(manifold, frictionCenter);
        Write(ContactPrestepLayout.Normal(contactCount), manifold.Normal);
    }

    void WriteOffsetB(in ConvexContactManifold manifold, in Vector3 frictionCenter) => Write(
        ContactPrestepLayout.OffsetB(contactCount),
        hasTwoBodies && frictionCenter == default ? manifold.OffsetB + manifold.Normal * manifold.Gap : frictionCenter);

    void WriteMaterial(in PairMaterialProperties material, in Vector3 frictionCenter, bool wasHeld, float landing)
    {
        // The sign says something else: a game may give a negative zero.
        var coefficient = MathF.Abs(material.FrictionCoefficient);
        Write(ContactPrestepLayout.Friction(contactCount), hasTwoBodies && frictionCenter != default ? -coefficient : coefficient);
        Write(ContactPrestepLayout.Spring(contactCount), material.SpringSettings.AngularFrequency);
        Write(ContactPrestepLayout.Damping(contactCount), material.SpringSettings.AngularFrequency == 0
            ? ContactMaterialWide.DampingOfRigid(wasHeld, landing) : material.SpringSettings.TwiceDampingRatio);
        Write(ContactPrestepLayout.MaximumRecovery(contactCount), material.MaximumRecoveryVelocity);
    }

    // Of three contacts the last lane is what follows them.
    void ReadArms(in FeatureIds features, bool knewB, out OldArms arms)
    {
        arms.X = ReadLanes(0);
        arms.Y = ReadLanes(1);
        arms.Z = ReadLanes(2);
        arms.Features = Vector128.LoadUnsafe(in features[0]);
        arms.OffsetB = Read(prestep, ContactPrestepLayout.OffsetB(contactCount));
        arms.Normal = Read(prestep, ContactPrestepLayout.Normal(contactCount));
        arms.Count = contactCount;
        arms.KnowsB = knewB;
    }

    Vector128<float> ReadLanes(int field)
    {
        const int next = ContactPrestepLayout.FloatsPerContact;
        var first = prestep + field * Vector<float>.Count;
        return Vector128.Create(
            first[0], first[next * Vector<float>.Count], first[2 * next * Vector<float>.Count], first[3 * next * Vector<float>.Count]);
    }

    /// <summary>Reads what the constraint holds of the last step.</summary>
    internal void ReadPatch(in FeatureIds features, out ContactPatch result)
    {
        Unsafe.SkipInit(out result);
        result.Count = contactCount;
        result.KnowsB = KnowsB;
        result.WasHeld = WasHeld;
        result.Landing = Landing;
        result.Features = features;
        for (int i = 0; i < contactCount; ++i)
        {
            result.Normals[i] = impulses[i * Vector<float>.Count];
            result.Arms[i] = Read(prestep, i * ContactPrestepLayout.FloatsPerContact);
        }
        result.OffsetB = Read(prestep, ContactPrestepLayout.OffsetB(contactCount));
        result.Normal = Read(prestep, ContactPrestepLayout.Normal(contactCount));
        var friction = ContactPrestepLayout.FrictionImpulse(contactCount);
        result.Friction = Read(impulses, friction);
        result.Twist = impulses[(friction + 3) * Vector<float>.Count];
    }

    /// <summary>Hands the impulses of the last step's contacts to this step's.</summary>
    // A contact gets the impulse of the contact with its feature. Features are not unique in time: where edges coincide, as between boxes
    // of one size, a corner is now one box's, now the other's, without anything having moved. So contacts whose feature is new take over
    // from the nearest contact whose feature is gone, and what is left then is shared by all: the load of the patch is the same as a step
    // ago, whatever its contacts are called.
    void WriteImpulses(in ContactPatch old, in ConvexContactManifold manifold, in Vector3 frictionCenter, ref FeatureIds features)
    {
        ref var contact = ref Unsafe.AsRef(in manifold.Contact0);
        FourFloats normals = default;
        int given = 0;
        int received = 0;
        for (int i = 0; i < contactCount; ++i)
        {
            features[i] = Unsafe.Add(ref contact, i).FeatureId;
            for (int j = 0; j < old.Count; ++j)
            {
                if (old.Features[j] != features[i] || (given & 1 << j) != 0)
                    continue;
                normals[i] = old.Normals[j];
                given |= 1 << j;
                received |= 1 << i;
                break;
            }
        }
        if (received != (1 << contactCount) - 1)
        {
            old.GetArms(out var arms);
            for (int i = 0; i < contactCount; ++i)
            {
                if ((received & 1 << i) != 0)
                    continue;
                var nearest = arms.FindNearest(given, Unsafe.Add(ref contact, i).Offset);
                if (nearest < 0)
                    continue;
                normals[i] = old.Normals[nearest];
                given |= 1 << nearest;
            }
        }
        float left = 0;
        for (int j = 0; j < old.Count; ++j)
        {
            if ((given & 1 << j) == 0)
                left += old.Normals[j];
        }
        var share = left / contactCount;
        for (int i = 0; i < contactCount; ++i)
            impulses[i * Vector<float>.Count] = normals[i] + share;
        WriteFriction(old.Friction, manifold.Normal);
        // A contact that is alone has no lever, and what it holds means nothing; but for one that gets a share of friction with a lever.
        var begins = contactCount == 1 && frictionCenter != default && !old.HasTwist;
        impulses[(ContactPrestepLayout.FrictionImpulse(contactCount) + 3) * Vector<float>.Count] = begins ? 0 : old.Twist;
    }

    // Friction stays in the plane of the contacts; the normal may have turned.
    void WriteFriction(Vector3 impulse, Vector3 normal)
    {
        var tangential = impulse - normal * Exact.Dot(impulse, normal);
        var friction = ContactPrestepLayout.FrictionImpulse(contactCount);
        impulses[friction * Vector<float>.Count] = tangential.X;
        impulses[(friction + 1) * Vector<float>.Count] = tangential.Y;
        impulses[(friction + 2) * Vector<float>.Count] = tangential.Z;
    }

    static Vector3 Read(float* column, int field) => new(
        column[field * Vector<float>.Count], column[(field + 1) * Vector<float>.Count], column[(field + 2) * Vector<float>.Count]);

    void WriteArm(int contact, Vector3 arm) => Write(contact * ContactPrestepLayout.FloatsPerContact, arm);

    void WriteDepth(int contact, float depth) => Write(contact * ContactPrestepLayout.FloatsPerContact + ContactPrestepLayout.Depth, depth);

    void Write(int field, float value) => prestep[field * Vector<float>.Count] = value;

    void Write(int field, Vector3 value)
    {
        Write(field, value.X);
        Write(field + 1, value.Y);
        Write(field + 2, value.Z);
    }
}
