using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Impulses of a manifold with the features that they belong to.</summary>
struct ContactImpulses
{
    public int Count;
    public FeatureIds Features;
    public FourFloats Normals;
    public Vector3 Friction;
    public float Twist;
}

/// <summary>The column of one convex contact constraint in its type batch, for any number of contacts.</summary>
unsafe readonly ref struct ContactConstraint
{
    readonly float* prestep;
    readonly float* impulses;
    readonly int contactCount;

    internal ContactConstraint(Solver solver, ConstraintHandle handle, int contactCount)
    {
        ref var location = ref solver.HandleToConstraint[handle.Value];
        ref var batch = ref solver.TypeBatchAt(location);
        var processor = solver.Processor(location.TypeId);
        prestep = (float*)Unsafe.AsPointer(ref processor.PrestepFloat(ref batch, location.IndexInTypeBatch, 0));
        impulses = (float*)Unsafe.AsPointer(ref processor.Impulse(ref batch, location.IndexInTypeBatch, 0));
        this.contactCount = contactCount;
    }

    /// <summary>Writes the geometry and the material of a manifold.</summary>
    internal void Write(in ConvexContactManifold manifold, in PairMaterialProperties material)
    {
        ref var contact = ref Unsafe.AsRef(in manifold.Contact0);
        for (int i = 0; i < contactCount; ++i)
        {
            ref var source = ref Unsafe.Add(ref contact, i);
            Write(i * ContactPrestepLayout.FloatsPerContact, source.Offset);
            Write(i * ContactPrestepLayout.FloatsPerContact + ContactPrestepLayout.Depth, source.Depth);
        }
        Write(ContactPrestepLayout.OffsetB(contactCount), manifold.OffsetB);
        Write(ContactPrestepLayout.Normal(contactCount), manifold.Normal);
        Write(ContactPrestepLayout.Friction(contactCount), material.FrictionCoefficient);
        Write(ContactPrestepLayout.Spring(contactCount), material.SpringSettings.AngularFrequency);
        Write(ContactPrestepLayout.Spring(contactCount) + 1, material.SpringSettings.TwiceDampingRatio);
        Write(ContactPrestepLayout.MaximumRecovery(contactCount), material.MaximumRecoveryVelocity);
    }

    internal void ReadImpulses(in FeatureIds features, out ContactImpulses result)
    {
        result.Count = contactCount;
        result.Features = features;
        Unsafe.SkipInit(out result.Normals);
        for (int i = 0; i < contactCount; ++i)
            result.Normals[i] = impulses[i * Vector<float>.Count];
        var friction = ContactPrestepLayout.FrictionImpulse(contactCount);
        result.Friction = new(impulses[friction * Vector<float>.Count], impulses[(friction + 1) * Vector<float>.Count], impulses[(friction + 2) * Vector<float>.Count]);
        result.Twist = impulses[(friction + 3) * Vector<float>.Count];
    }

    /// <summary>Hands the impulses of the last step's contacts to this step's.</summary>
    // A contact gets the impulse of the contact with its feature. What belonged to features that are gone is shared by the features
    // that are new: the load of the patch is the same as a step ago, whatever its contacts are called.
    internal void WriteImpulses(in ContactImpulses old, in ConvexContactManifold manifold, ref FeatureIds features)
    {
        ref var contact = ref Unsafe.AsRef(in manifold.Contact0);
        FourFloats normals = default;
        float left = 0;
        for (int j = 0; j < old.Count; ++j)
            left += old.Normals[j];
        int unmatched = 0;
        int matchedMask = 0;
        for (int i = 0; i < contactCount; ++i)
        {
            var feature = Unsafe.Add(ref contact, i).FeatureId;
            features[i] = feature;
            bool found = false;
            for (int j = 0; j < old.Count; ++j)
            {
                if (old.Features[j] != feature || (matchedMask & 1 << j) != 0)
                    continue;
                normals[i] = old.Normals[j];
                left -= old.Normals[j];
                matchedMask |= 1 << j;
                found = true;
                break;
            }
            if (!found)
            {
                normals[i] = -1;
                ++unmatched;
            }
        }
        var share = unmatched > 0 && left > 0 ? left / unmatched : 0;
        for (int i = 0; i < contactCount; ++i)
            impulses[i * Vector<float>.Count] = normals[i] < 0 ? share : normals[i];
        // Friction stays in the plane of the contacts; the normal may have turned.
        var tangential = old.Friction - manifold.Normal * Exact.Dot(old.Friction, manifold.Normal);
        var friction = ContactPrestepLayout.FrictionImpulse(contactCount);
        impulses[friction * Vector<float>.Count] = tangential.X;
        impulses[(friction + 1) * Vector<float>.Count] = tangential.Y;
        impulses[(friction + 2) * Vector<float>.Count] = tangential.Z;
        impulses[(friction + 3) * Vector<float>.Count] = old.Twist;
    }

    void Write(int field, float value) => prestep[field * Vector<float>.Count] = value;

    void Write(int field, Vector3 value)
    {
        Write(field, value.X);
        Write(field + 1, value.Y);
        Write(field + 2, value.Z);
    }
}
