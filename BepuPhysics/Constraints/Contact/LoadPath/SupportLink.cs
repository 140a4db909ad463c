using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Which body a contact constraint carries, and where its numbers are: all that the graph has to know of it.</summary>
unsafe struct SupportLink
{
    /// <summary>First number of its description: its column in its type batch.</summary>
    public float* Prestep;
    /// <summary>First of its accumulated impulses.</summary>
    public float* Impulses;
    /// <summary>Index of the upper body in the active set.</summary>
    public int Upper;
    /// <summary>Index of the lower body in the active set; negative for what nothing pushes: <see cref="Still"/> or a <see cref="Floor"/>.</summary>
    public int Lower;
    /// <summary>Half the width of the band about zero in which the contacts know no overlap, m.</summary>
    public float Band;
    /// <summary>Greatest distance of a contact from the centre of the upper body, m.</summary>
    public float Radius;
    /// <summary>Number of contacts.</summary>
    public byte Count;
    /// <summary>One bit per contact, set where the surfaces are apart: it carries nothing and is left as it is.</summary>
    public byte Open;
    /// <summary>One bit per contact, set where it would touch again if the patch, which has been held, were let go.</summary>
    public byte Near;
    /// <summary>Whether the constraint has two bodies.</summary>
    public bool HasTwoBodies;
    /// <summary>Whether the upper body is A of the constraint.</summary>
    public bool IsUpperA;
    /// <summary>Whether friction is at its limit and the surfaces move along each other.</summary>
    public bool Slides;
    /// <summary>Whether the contacts are too steep to hand a load down: their bodies hold each other.</summary>
    public bool Leans;
    // Four of those that follow.
    byte motion;

    const byte MovesBit = 1, SwaysBit = 2, WholeBit = 4, HeldBit = 8;

    /// <summary>Whether its bodies rest to each other, but not to what does not move.</summary>
    public bool Moves { readonly get => (motion & MovesBit) != 0; set => Set(MovesBit, value); }

    /// <summary>Whether its bodies move too fast to rest, and may but sway.</summary>
    public bool Sways { readonly get => (motion & SwaysBit) != 0; set => Set(SwaysBit, value); }

    /// <summary>Whether all of its contacts, three or four, touch: it may be of a column that sways.</summary>
    public bool IsWhole { readonly get => (motion & WholeBit) != 0; set => Set(WholeBit, value); }

    /// <summary>Whether its contacts were held in the last step.</summary>
    public bool WasHeld { readonly get => (motion & HeldBit) != 0; set => Set(HeldBit, value); }

    void Set(byte bit, bool value) => motion = (byte)(value ? motion | bit : motion & ~bit);

    /// <summary>In the place of a lower body: what does not move.</summary>
    internal const int Still = -1;

    /// <summary>In the place of a lower body: a kinematic body that moves, or did a step ago. Its own inverse.</summary>
    internal static int Floor(int kinematic) => Still - 1 - kinematic;

    /// <summary>Number of contacts that the upper body rests on.</summary>
    internal readonly int CarryingCount => Count - BitOperations.PopCount((uint)(Open & ~Near));

    /// <summary>Whether the place of the lower body is written, and not that of friction; see <see cref="ContactMaterialWide.SharesFriction"/>.</summary>
    internal readonly bool KnowsLower => HasTwoBodies && !float.IsNegative(Prestep[ContactPrestepLayout.Friction(Count) * Vector<float>.Count]);

    /// <summary>Centre of the lower body relative to that of the upper one, by the arms of the contacts, m, where it is known.</summary>
    internal readonly Vector3 ToLower
    {
        get
        {
            var width = Vector<float>.Count;
            var column = Prestep + ContactPrestepLayout.OffsetB(Count) * width;
            var offset = new Vector3(column[0], column[width], column[2 * width]);
            return IsUpperA ? offset : -offset;
        }
    }

    /// <summary>Turns all that the constraint remembers as vectors.</summary>
    internal readonly void Turn(Quaternion turn)
    {
        TurnArms(turn);
        Turn(Prestep, ContactPrestepLayout.Normal(Count), turn);
        Turn(Impulses, ContactPrestepLayout.FrictionImpulse(Count), turn);
    }

    /// <summary>Turns the arms of the constraint, and from one of its bodies to the other.</summary>
    internal readonly void TurnArms(Quaternion turn)
    {
        for (int i = 0; i < Count; ++i)
            Turn(Prestep, i * ContactPrestepLayout.FloatsPerContact, turn);
        Turn(Prestep, ContactPrestepLayout.OffsetB(Count), turn);
    }

    static void Turn(float* column, int row, Quaternion turn)
    {
        var width = Vector<float>.Count;
        column += row * width;
        var turned = Exact.Rotate(new Vector3(column[0], column[width], column[2 * width]), turn);
        (column[0], column[width], column[2 * width]) = (turned.X, turned.Y, turned.Z);
    }

    /// <summary>Angular frequency of the constraint's spring, which says how far it is held: see <see cref="ContactMaterialWide.IsHeld"/>.</summary>
    internal readonly ref float Spring => ref Prestep[ContactPrestepLayout.Spring(Count) * Vector<float>.Count];

    /// <summary>Greatest speed at which penetration is corrected, m/s.</summary>
    internal readonly float MaximumRecoveryVelocity => Prestep[ContactPrestepLayout.MaximumRecovery(Count) * Vector<float>.Count];
}
