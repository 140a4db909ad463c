using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Impulses of a manifold with the features and places that they belong to.</summary>
struct ContactImpulses
{
    public int Count;
    public FeatureIds Features;
    public FourFloats Normals;
    public FourVectors Offsets;
    public Vector3 Friction;
    public float Twist;
}

/// <summary>The column of one convex contact constraint in its type batch, for any number of contacts.</summary>
unsafe readonly struct ContactConstraint
{
    readonly float* prestep;
    readonly float* impulses;
    readonly int contactCount;

    internal ContactConstraint(Solver solver, ConstraintHandle handle, int contactCount)
    {
        ref var location = ref solver.Locations[handle.Slot];
        ref var batch = ref solver.TypeBatchAt(location);
        var processor = solver.Processor(location.TypeId);
        prestep = (float*)Unsafe.AsPointer(ref processor.PrestepFloat(ref batch, location.IndexInTypeBatch, 0));
        impulses = (float*)Unsafe.AsPointer(ref processor.Impulse(ref batch, location.IndexInTypeBatch, 0));
        this.contactCount = contactCount;
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

    /// <summary>Reads the impulses and the places of the last step's contacts. To be called before new contacts are written.</summary>
    internal void ReadImpulses(in FeatureIds features, out ContactImpulses result)
    {
        Unsafe.SkipInit(out result);
        result.Count = contactCount;
        result.Features = features;
        for (int i = 0; i < contactCount; ++i)
        {
            result.Normals[i] = impulses[i * Vector<float>.Count];
            result.Offsets[i] = Read(prestep, i * ContactPrestepLayout.FloatsPerContact);
        }
        var friction = ContactPrestepLayout.FrictionImpulse(contactCount);
        result.Friction = Read(impulses, friction);
        result.Twist = impulses[(friction + 3) * Vector<float>.Count];
    }

    /// <summary>Hands the impulses of the last step's contacts to this step's.</summary>
    // A contact gets the impulse of the contact with its feature. Features are not unique in time: where edges coincide, as between boxes
    // of one size, a corner is now one box's, now the other's, without anything having moved. So contacts whose feature is new take over
    // from the nearest contact whose feature is gone, and what is left then is shared by all: the load of the patch is the same as a step
    // ago, whatever its contacts are called.
    internal void WriteImpulses(in ContactImpulses old, in ConvexContactManifold manifold, ref FeatureIds features)
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
        for (int i = 0; i < contactCount; ++i)
        {
            if ((received & 1 << i) != 0)
                continue;
            var nearest = FindNearest(old, given, Unsafe.Add(ref contact, i).Offset);
            if (nearest < 0)
                continue;
            normals[i] = old.Normals[nearest];
            given |= 1 << nearest;
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
        WriteFriction(old, manifold.Normal);
    }

    static int FindNearest(in ContactImpulses old, int given, Vector3 offset)
    {
        int nearest = -1;
        float least = float.MaxValue;
        for (int j = 0; j < old.Count; ++j)
        {
            var distance = Exact.DistanceSquared(old.Offsets[j], offset);
            if ((given & 1 << j) != 0 || !(distance < least))
                continue;
            least = distance;
            nearest = j;
        }
        return nearest;
    }

    // Friction stays in the plane of the contacts; the normal may have turned.
    void WriteFriction(in ContactImpulses old, Vector3 normal)
    {
        var tangential = old.Friction - normal * Exact.Dot(old.Friction, normal);
        var friction = ContactPrestepLayout.FrictionImpulse(contactCount);
        impulses[friction * Vector<float>.Count] = tangential.X;
        impulses[(friction + 1) * Vector<float>.Count] = tangential.Y;
        impulses[(friction + 2) * Vector<float>.Count] = tangential.Z;
        impulses[(friction + 3) * Vector<float>.Count] = old.Twist;
    }

    static Vector3 Read(float* column, int field) => new(
        column[field * Vector<float>.Count], column[(field + 1) * Vector<float>.Count], column[(field + 2) * Vector<float>.Count]);

    void Write(int field, float value) => prestep[field * Vector<float>.Count] = value;

    void Write(int field, Vector3 value)
    {
        Write(field, value.X);
        Write(field + 1, value.Y);
        Write(field + 2, value.Z);
    }
}
