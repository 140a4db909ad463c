using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>A contact patch by which one body rests on another or on what does not move, seen from the upper of the two.</summary>
unsafe struct LoadSupport
{
    /// <summary>Index of the lower body in the active set; negative for what nothing pushes.</summary>
    public int Lower;
    /// <summary>Accumulated impulses of the constraint: its column in its type batch.</summary>
    public float* Impulses;
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

    /// <summary>Reads what does not change within a step.</summary>
    internal LoadSupport(in SupportLink link)
    {
        Unsafe.SkipInit(out this);
        Lower = link.Lower;
        Impulses = link.Impulses;
        Count = link.Count;
        Open = link.Open;
        Sign = link.IsUpperA ? 1 : -1;
        var friction = Number(link.Prestep, ContactPrestepLayout.Friction(Count));
        Friction = MathF.Abs(friction);
        Normal = Three(link.Prestep, ContactPrestepLayout.Normal(Count)) * Sign;
        var offsetB = Three(link.Prestep, ContactPrestepLayout.OffsetB(Count));
        ToLower = offsetB * Sign;
        // Friction acts where the sweeps let it act: at the mean of the contacts that touch, or of all if none does; or where several statics have it act.
        Vector3 touching = default, all = default;
        int touches = 0;
        for (int i = 0; i < Count; ++i)
        {
            var first = i * ContactPrestepLayout.FloatsPerContact;
            var arm = Three(link.Prestep, first);
            Arms[i] = link.IsUpperA ? arm : arm - offsetB;
            all += Arms[i];
            if (Number(link.Prestep, first + ContactPrestepLayout.Depth) < -link.Band)
                continue;
            touching += Arms[i];
            ++touches;
        }
        if (link.HasTwoBodies ? float.IsNegative(friction) : offsetB != default)
            Center = offsetB;
        else
            Center = touches > 0 ? touching * (1f / touches) : all * (1f / Count);
    }

    /// <summary>Reads what the solver has accumulated.</summary>
    internal void Read()
    {
        for (int i = 0; i < Count; ++i)
            After[i] = Before[i] = Impulse(i);
        var first = ContactPrestepLayout.FrictionImpulse(Count);
        FrictionAfter = FrictionBefore = new Vector3(Impulse(first), Impulse(first + 1), Impulse(first + 2)) * Sign;
        TwistAfter = TwistBefore = Impulse(first + 3);
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
        Impulse(first + 3) = TwistBefore + (TwistAfter - TwistBefore) * part;
    }

    /// <summary>Goes back to a part of the way from the impulses before the transfer to those after it.</summary>
    internal void Shorten(float part)
    {
        for (int i = 0; i < Count; ++i)
            After[i] = Before[i] + (After[i] - Before[i]) * part;
        FrictionAfter = FrictionBefore + (FrictionAfter - FrictionBefore) * part;
        TwistAfter = TwistBefore + (TwistAfter - TwistBefore) * part;
    }

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
        var change = new PatchImpulses { Friction = FrictionAfter - FrictionBefore, Twist = TwistAfter - TwistBefore };
        for (int i = 0; i < Count; ++i)
            change.Normals[i] = After[i] - Before[i];
        Sum(change, out linear, out angular);
    }

    /// <summary>Momentum and angular momentum about its centre that impulses give the upper body.</summary>
    internal readonly void Sum(in PatchImpulses impulses, out Vector3 linear, out Vector3 angular)
    {
        linear = impulses.Friction;
        angular = Exact.Cross(Center, linear) + Normal * impulses.Twist;
        for (int i = 0; i < Count; ++i)
        {
            var normal = Normal * impulses.Normals[i];
            linear += normal;
            angular += Exact.Cross(Arms[i], normal);
        }
    }

    readonly ref float Impulse(int field) => ref Number(Impulses, field);

    /// <summary>A number of a constraint, of which the first is at a place and the others lie a vector apart.</summary>
    internal static ref float Number(float* column, int field) => ref column[field * Vector<float>.Count];

    /// <summary>A vector of a constraint, as <see cref="Number"/>.</summary>
    internal static Vector3 Three(float* column, int field) => new(Number(column, field), Number(column, field + 1), Number(column, field + 2));
}
