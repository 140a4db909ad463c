using System.Numerics;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>Gives columns another number of bundles. What is new is not cleared: a bundle is when it comes into use.</summary>
/// <param name="bundles">Bundles that a column is to have.</param>
/// <param name="used">Bundles that are kept.</param>
/// <param name="pool">Where the memory comes from.</param>
readonly struct ResizeBundles(int bundles, int used, BufferPool pool) : IColumnVisitor
{
    public void Visit<T>(ref Buffer<T> column, int width = 1) where T : unmanaged
    {
        var bundle = width * Vector<float>.Count;
        pool.Take<T>(bundles * bundle, out var resized);
        if (column.Allocated)
        {
            column.CopyTo(0, resized, 0, used * bundle);
            pool.Return(ref column);
        }
        column = resized;
    }
}

/// <summary>Copies the values of a constraint to the place of another one.</summary>
/// <param name="from">The constraint's place.</param>
/// <param name="to">The other one's.</param>
readonly struct MoveInBundles(int from, int to) : IColumnVisitor
{
    public void Visit<T>(ref Buffer<T> column, int width = 1) where T : unmanaged
    {
        var source = TypeProcessor.ColumnStart(width, from);
        var target = TypeProcessor.ColumnStart(width, to);
        for (int i = 0; i < width * Vector<float>.Count; i += Vector<float>.Count)
            column[target + i] = column[source + i];
    }
}

/// <summary>Exchanges two constraints.</summary>
readonly struct ExchangeInBundles(int a, int b) : IColumnVisitor
{
    public void Visit<T>(ref Buffer<T> column, int width = 1) where T : unmanaged
    {
        var ofA = TypeProcessor.ColumnStart(width, a);
        var ofB = TypeProcessor.ColumnStart(width, b);
        for (int i = 0; i < width * Vector<float>.Count; i += Vector<float>.Count)
            (column[ofA + i], column[ofB + i]) = (column[ofB + i], column[ofA + i]);
    }
}
