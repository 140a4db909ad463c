using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>A contact patch by which one body rests on another or on what does not move, seen from the upper of the two.</summary>
unsafe struct LoadSupport
{
    /// <summary>Index of the upper body in the active set.</summary>
    public int Upper;
    /// <summary>Index of the lower body in the active set; negative for what does not move.</summary>
    public int Lower;
    /// <summary>Accumulated impulses of the constraint: its column in its type batch.</summary>
    public float* Impulses;
    /// <summary>Angular frequency of the constraint's spring, which says how far it is held: see <see cref="ContactMaterialWide.IsHeld"/>.</summary>
    public float* Spring;
    /// <summary>Number of contacts.</summary>
    public int Count;
    /// <summary>One bit per contact, set where the surfaces are apart: it carries nothing and is left as it is.</summary>
    public int Open;
    /// <summary>1 where the upper body is A of the constraint, else -1.</summary>
    public float Sign;
    /// <summary>Coulomb coefficient of the patch.</summary>
    public float Friction;
    /// <summary>Unit normal, from the lower to the upper body.</summary>
    public Vector3 Normal;
    /// <summary>Where friction acts, relative to the centre of the upper body, m.</summary>
    public Vector3 Center;
    /// <summary>Centre of the lower body relative to that of the upper one, m.</summary>
    public Vector3 ToLower;
    /// <summary>Half the width of the band about zero in which the contacts know no overlap, m.</summary>
    public float Band;
    /// <summary>Contacts relative to the centre of the upper body, m.</summary>
    public FourVectors Arms;

    /// <summary>One bit per contact, set where it is at zero after the transfer: what is open, and what would pull.</summary>
    public int Pulled;
    /// <summary>Normal impulses before and after the transfer, N s.</summary>
    public FourFloats Before, After;
    /// <summary>Friction on the upper body before and after the transfer, N s.</summary>
    public Vector3 FrictionBefore, FrictionAfter;
    /// <summary>Twist of the constraint before and after the transfer, N m s.</summary>
    public float TwistBefore, TwistAfter;

    /// <summary>Reads what the solver has accumulated.</summary>
    internal void Read()
    {
        for (int i = 0; i < Count; ++i)
            After[i] = Before[i] = Impulse(i);
        var first = ContactPrestepLayout.FrictionImpulse(Count);
        FrictionAfter = FrictionBefore = new Vector3(Impulse(first), Impulse(first + 1), Impulse(first + 2)) * Sign;
        TwistAfter = TwistBefore = Impulse(first + 3) * Sign;
    }

    /// <summary>Writes impulses part of the way from those before the transfer to those after it.</summary>
    internal readonly void Write(float part)
    {
        for (int i = 0; i < Count; ++i)
            Impulse(i) = Before[i] + (After[i] - Before[i]) * part;
        var first = ContactPrestepLayout.FrictionImpulse(Count);
        var friction = (FrictionBefore + (FrictionAfter - FrictionBefore) * part) * Sign;
        Impulse(first) = friction.X;
        Impulse(first + 1) = friction.Y;
        Impulse(first + 2) = friction.Z;
        Impulse(first + 3) = (TwistBefore + (TwistAfter - TwistBefore) * part) * Sign;
    }

    /// <summary>Number of contacts that may carry.</summary>
    internal readonly int CarryingCount => Count - BitOperations.PopCount((uint)Open);

    /// <summary>Sum of the normal impulses before the transfer, N s.</summary>
    internal readonly float Load
    {
        get
        {
            float load = 0;
            for (int i = 0; i < Count; ++i)
                load += Before[i];
            return load;
        }
    }

    /// <summary>Change of momentum and of angular momentum about its centre that the transfer gives the upper body.</summary>
    internal readonly void Change(out Vector3 linear, out Vector3 angular)
    {
        linear = FrictionAfter - FrictionBefore;
        angular = Exact.Cross(Center, linear) + Normal * (TwistAfter - TwistBefore);
        for (int i = 0; i < Count; ++i)
        {
            var normal = Normal * (After[i] - Before[i]);
            linear += normal;
            angular += Exact.Cross(Arms[i], normal);
        }
    }

    readonly ref float Impulse(int field) => ref Impulses[field * Vector<float>.Count];
}
