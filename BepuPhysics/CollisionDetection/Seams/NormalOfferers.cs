using System;
using System.Numerics;

namespace BepuPhysics.CollisionDetection;

/// <summary>The children of a set that have the normal of a leader, and offer it to others as well.</summary>
/// <remarks>
/// Most normals are those of one child, but all that come after it ask who offers them. So the children are looked through when the first asks, as far as
/// there are bits; what comes after these is looked at each time.
/// </remarks>
struct NormalOfferers
{
    ulong bits;
    bool areKnown;

    /// <summary>Number of children for which there are bits.</summary>
    public const int BitCount = 64;

    /// <summary>Place of the first; no less than the number of children where there is none.</summary>
    public int First(in RankedChild leader, in SeamView view)
    {
        if (!areKnown)
            Find(leader, view);
        return Next(-1, leader, view);
    }

    /// <summary>Place of the next one; no less than the number of children where there is none.</summary>
    public readonly int Next(int index, in RankedChild leader, in SeamView view)
    {
        if (++index < BitCount)
        {
            var left = bits >> index;
            if (left != 0)
                return index + BitOperations.TrailingZeroCount(left);
            index = BitCount;
        }
        while (index < view.Ranked.Length && !Offers(view.Ranked[index], leader, view))
            ++index;
        return index;
    }

    /// <summary>Notes that a child has got another normal.</summary>
    public void Forget() => areKnown = false;

    void Find(in RankedChild leader, in SeamView view)
    {
        areKnown = true;
        bits = 0;
        var count = Math.Min(view.Ranked.Length, BitCount);
        for (int i = 0; i < count; ++i)
            bits |= Offers(view.Ranked[i], leader, view) ? 1ul << i : 0;
    }

    static bool Offers(in RankedChild other, in RankedChild leader, in SeamView view) => other.Group == leader.Group &&
        ChildAgreement.HasOneNormal(view.Result(other).Manifold.Normal, view.Result(leader).Manifold.Normal);
}
