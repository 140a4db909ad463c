using System;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>Whether the children of a patch are pieces of one face, or feet that are apart; see <see cref="FaceLever"/>.</summary>
// Pieces of a face fill what their outermost contacts enclose, and press evenly. Feet do not fill it, and each of them bears as much as another.
static class PatchLever
{
    // What fills more than this is one face: contacts of pieces do not lie on their common borders exactly.
    const float Full = 0.9f;
    // Mean distance of the points of a face from its middle, over that of its corners, of what is as long as wide and of a line.
    const float Round = 0.6f, Line = 0.5f;

    /// <summary>Turn about the normal in a step, rad, below which nobody asks for a lever.</summary>
    public const float LeastTurn = 1e-3f;

    /// <summary>Finds the lever of a patch of several children: of one that was found with those of others it is known already.</summary>
    /// <param name="candidates">The contacts from which those of the patch were chosen, in the order of its children.</param>
    /// <param name="patch">The patch.</param>
    /// <param name="lane">Its lane.</param>
    public static unsafe byte Find(Span<FaceCandidate> candidates, in ReducedPatch patch, int lane)
    {
        var kept = patch.Kept;
        if (kept.Length < 2)
            return FaceLever.OfOneFace;
        var isLine = kept.Length == 2;
        Corners whole = default;
        var (filled, feet) = (0f, 0);
        for (int i = 0; TryRead(candidates, lane, ref i, out var slot, out var foot);)
        {
            if (patch.Results[slot].Lever != FaceLever.OfOneFace)
                return patch.Results[slot].Lever;
            filled += foot.Size(isLine);
            ++feet;
        }
        foreach (ref var candidate in candidates)
        {
            if (IsKept(kept, GatherScatter.Get(ref candidate.Name, lane)) && IsThere(ref candidate, lane))
                whole.Add(ref candidate, lane);
        }
        var size = whole.Size(isLine);
        if (filled >= Full * size)
            return FaceLever.OfOneFace;

        // Shares of the load, by size and by number.
        var (bySize, byNumber) = (1 / size, (1 - filled / size) / feet);
        var (x, y) = (0f, 0f);
        for (int i = 0; TryRead(candidates, lane, ref i, out _, out var foot);)
        {
            var share = byNumber + foot.Size(isLine) * bySize;
            x += share * foot.MiddleX;
            y += share * foot.MiddleY;
        }
        var lever = 0f;
        for (int i = 0; TryRead(candidates, lane, ref i, out _, out var foot);)
        {
            var share = byNumber + foot.Size(isLine) * bySize;
            lever += share * MathF.Sqrt(Square(foot.MiddleX - x) + Square(foot.MiddleY - y) + foot.SquaredLever);
        }
        var distance = 0f;
        foreach (ref var candidate in candidates)
        {
            if (!IsKept(kept, GatherScatter.Get(ref candidate.Name, lane)) || !IsThere(ref candidate, lane))
                continue;
            var (awayX, awayY) = (GatherScatter.Get(ref candidate.X, lane) - x, GatherScatter.Get(ref candidate.Y, lane) - y);
            distance += MathF.Sqrt(Square(awayX) + Square(awayY));
        }
        return FaceLever.Code(lever * kept.Length / distance);
    }

    /// <summary>A material that says a lever, too.</summary>
    public static PairMaterialProperties Write(in PairMaterialProperties material, byte lever) =>
        material with { MaximumRecoveryVelocity = FaceLever.Write(material.MaximumRecoveryVelocity, lever) };

    // Reads the candidates of a child, which follow one another.
    static bool TryRead(Span<FaceCandidate> candidates, int lane, ref int i, out int slot, out Corners corners)
    {
        corners = default;
        slot = -1;
        for (; i < candidates.Length && IsThere(ref candidates[i], lane); ++i)
        {
            var next = GatherScatter.Get(ref candidates[i].Name, lane) / ConvexContactManifold.MaximumContactCount;
            if (slot >= 0 && next != slot)
                return true;
            slot = next;
            corners.Add(ref candidates[i], lane);
        }
        return slot >= 0;
    }

    // Of up to four: a search of the runtime's takes longer to begin.
    static bool IsKept(ReadOnlySpan<int> kept, int name)
    {
        foreach (int other in kept)
        {
            if (other == name)
                return true;
        }
        return false;
    }

    static bool IsThere(ref FaceCandidate candidate, int lane) => GatherScatter.Get(ref candidate.Depth, lane) != IContactCandidate.None;

    static float Square(float value) => value * value;

    // Sums over some contacts.
    struct Corners
    {
        int count;
        float x, y, xx, yy, xy;

        public void Add(ref FaceCandidate candidate, int lane)
        {
            var (placeX, placeY) = (GatherScatter.Get(ref candidate.X, lane), GatherScatter.Get(ref candidate.Y, lane));
            ++count;
            x += placeX;
            y += placeY;
            xx += placeX * placeX;
            yy += placeY * placeY;
            xy += placeX * placeY;
        }

        public readonly float MiddleX => x / count;

        public readonly float MiddleY => y / count;

        // Mean of the squared distances from the middle.
        readonly float Spread => MathHelper.Max(0, (xx + yy) / count - Square(MiddleX) - Square(MiddleY));

        // Of the moments about the middle: 1/16 of the squared area of a parallelogram, 4/27 of that of a triangle.
        readonly float Determinant => MathHelper.Max(
            0, (xx / count - Square(MiddleX)) * (yy / count - Square(MiddleY)) - Square(xy / count - MiddleX * MiddleY));

        // The area of a triangle or parallelogram, m2, and 2 / pi of that of a disc with corners at its rim; where a line is asked for, its length, m.
        public readonly float Size(bool isLine) => count switch
        {
            1 => 0,
            _ when isLine => 2 * MathF.Sqrt(Spread),
            2 => 0,
            3 => MathF.Sqrt(27 / 4f * Determinant),
            _ => 4 * MathF.Sqrt(Determinant),
        };

        // Mean distance of the points of the face from its middle, squared. Of a square the root of the determinant is half of the spread, of a line nothing.
        public readonly float SquaredLever
        {
            get
            {
                var spread = Spread;
                if (!(spread > 0))
                    return 0;
                var roundness = MathHelper.Min(1, 2 * MathF.Sqrt(Determinant) / spread);
                return Square(Line + (Round - Line) * roundness) * spread;
            }
        }
    }
}
