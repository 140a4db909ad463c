using System.IO;

namespace Benchmarks.Pairs.Shared;

/// <summary>Pairs of two kinds of shapes that are placed alike, measured together.</summary>
/// <param name="Pair">The two kinds, with a hyphen between.</param>
/// <param name="Regime">How they are placed.</param>
/// <param name="Placements">The pairs.</param>
sealed record PairCase(string Pair, string Regime, PairPlacement[] Placements)
{
    /// <summary>Writes the case to a file.</summary>
    public void Write(BinaryWriter writer)
    {
        writer.Write(Pair);
        writer.Write(Regime);
        writer.Write(Placements.Length);
        foreach (PairPlacement placement in Placements)
            placement.Write(writer);
    }

    /// <summary>Reads what <see cref="Write"/> has written.</summary>
    public static PairCase Read(BinaryReader reader)
    {
        string pair = reader.ReadString(), regime = reader.ReadString();
        var placements = new PairPlacement[reader.ReadInt32()];
        for (int i = 0; i < placements.Length; ++i)
            placements[i] = PairPlacement.Read(reader);
        return new PairCase(pair, regime, placements);
    }
}
