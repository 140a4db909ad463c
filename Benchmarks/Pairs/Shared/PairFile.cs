using System.Collections.Generic;
using System.IO;

namespace Benchmarks.Pairs.Shared;

/// <summary>What both programs measure: bit for bit the same shapes in the same places.</summary>
/// <param name="Margin">Speculative margin of all pairs, m.</param>
/// <param name="Shapes">All shapes.</param>
/// <param name="Cases">All cases.</param>
sealed record PairFile(float Margin, List<PairShape> Shapes, List<PairCase> Cases)
{
    /// <summary>Writes everything to a file.</summary>
    public void Write(string path)
    {
        using var writer = new BinaryWriter(File.Create(path));
        writer.Write(Margin);
        writer.Write(Shapes.Count);
        foreach (PairShape shape in Shapes)
            shape.Write(writer);
        writer.Write(Cases.Count);
        foreach (PairCase subject in Cases)
            subject.Write(writer);
    }

    /// <summary>Reads what <see cref="Write"/> has written.</summary>
    public static PairFile Read(string path)
    {
        using var reader = new BinaryReader(File.OpenRead(path));
        var file = new PairFile(reader.ReadSingle(), [], []);
        for (int left = reader.ReadInt32(); left > 0; --left)
            file.Shapes.Add(PairShape.Read(reader));
        for (int left = reader.ReadInt32(); left > 0; --left)
            file.Cases.Add(PairCase.Read(reader));
        return file;
    }
}
