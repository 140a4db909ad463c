using System.IO;
using System.Numerics;

namespace Benchmarks.Pairs.Shared;

/// <summary>Two shapes and where they are.</summary>
/// <param name="A">Index of the first shape among those of the file.</param>
/// <param name="B">Index of the second shape.</param>
/// <param name="OffsetB">Position of B less that of A.</param>
/// <param name="OrientationA">Rotation from A's frame to the world.</param>
/// <param name="OrientationB">Rotation from B's frame to the world.</param>
readonly record struct PairPlacement(int A, int B, Vector3 OffsetB, Quaternion OrientationA, Quaternion OrientationB)
{
    /// <summary>Writes the placement to a file.</summary>
    public void Write(BinaryWriter writer)
    {
        writer.Write(A);
        writer.Write(B);
        for (int i = 0; i < 3; ++i)
            writer.Write(OffsetB[i]);
        for (int i = 0; i < 4; ++i)
            writer.Write(OrientationA[i]);
        for (int i = 0; i < 4; ++i)
            writer.Write(OrientationB[i]);
    }

    /// <summary>Reads what <see cref="Write"/> has written.</summary>
    public static PairPlacement Read(BinaryReader reader)
    {
        int a = reader.ReadInt32(), b = reader.ReadInt32();
        var offset = new Vector3(reader.ReadSingle(), reader.ReadSingle(), reader.ReadSingle());
        return new PairPlacement(a, b, offset, ReadRotation(reader), ReadRotation(reader));
    }

    static Quaternion ReadRotation(BinaryReader reader) =>
        new(reader.ReadSingle(), reader.ReadSingle(), reader.ReadSingle(), reader.ReadSingle());
}
