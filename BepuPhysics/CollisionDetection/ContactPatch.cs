using System.Numerics;
using System.Runtime.Intrinsics;
using BepuPhysics.Constraints.Contact;

namespace BepuPhysics.CollisionDetection;

/// <summary>What a contact constraint holds of its last step.</summary>
struct ContactPatch
{
    /// <summary>Number of contacts; 0 where there was no constraint.</summary>
    public int Count;
    /// <summary>Whether B is a body too, and no static; but not where friction is written in its place.</summary>
    public bool KnowsB;
    /// <summary>Whether the load path held it.</summary>
    public bool WasHeld;
    /// <summary>How far it is in landing; see <see cref="ContactMaterialWide.Landing"/>.</summary>
    public float Landing;
    /// <summary>Features of the contacts.</summary>
    public FeatureIds Features;
    /// <summary>Normal impulses, N s.</summary>
    public FourFloats Normals;
    /// <summary>Positions of the contacts relative to the centre of A, world axes, as they were when the arms were found.</summary>
    public FourVectors Arms;
    /// <summary>Position of B relative to A at that time; where that is not known, where friction acted, or zero, as in the constraint.</summary>
    public Vector3 OffsetB;
    /// <summary>Normal of the last step.</summary>
    public Vector3 Normal;
    /// <summary>Friction impulse in world axes, N s.</summary>
    public Vector3 Friction;
    /// <summary>Impulse against turning about the normal, N m s.</summary>
    public float Twist;

    /// <summary>Whether <see cref="Twist"/> means anything.</summary>
    public readonly bool HasTwist => Count > 1 || (!KnowsB && OffsetB != default);

    /// <summary>The arms; of lanes beyond the count nothing is known.</summary>
    public readonly void GetArms(out OldArms arms)
    {
        arms.X = Vector128.Create(Arms[0].X, Arms[1].X, Arms[2].X, Arms[3].X);
        arms.Y = Vector128.Create(Arms[0].Y, Arms[1].Y, Arms[2].Y, Arms[3].Y);
        arms.Z = Vector128.Create(Arms[0].Z, Arms[1].Z, Arms[2].Z, Arms[3].Z);
        arms.Features = Vector128.Create(Features[0], Features[1], Features[2], Features[3]);
        arms.OffsetB = OffsetB;
        arms.Normal = Normal;
        arms.Count = Count;
        arms.KnowsB = KnowsB;
    }
}
