using BepuUtilities.Memory;

namespace BepuPhysics;

/// <summary>Does something to each column of a table; which columns there are, the table says once.</summary>
interface IColumnVisitor
{
    /// <param name="column">The column.</param>
    /// <param name="width">Values that a row has in it; more than one where rows lie in bundles.</param>
    void Visit<T>(ref Buffer<T> column, int width = 1) where T : unmanaged;
}

/// <summary>Gives columns another length. What is new is not cleared: rows are when they come into use.</summary>
/// <param name="length">Rows that a column is to have.</param>
/// <param name="used">Rows that are kept.</param>
/// <param name="pool">Where the memory comes from.</param>
readonly struct ResizeColumns(int length, int used, BufferPool pool) : IColumnVisitor
{
    public void Visit<T>(ref Buffer<T> column, int width = 1) where T : unmanaged
    {
        pool.Take<T>(length, out var resized);
        if (column.Allocated)
        {
            column.CopyTo(0, resized, 0, used);
            pool.Return(ref column);
        }
        column = resized;
    }
}

/// <summary>Moves a row to another place, where it replaces what was there, and clears its own.</summary>
/// <param name="from">The row.</param>
/// <param name="to">The place; its own for a row that is to be cleared.</param>
readonly struct MoveRow(int from, int to) : IColumnVisitor
{
    public void Visit<T>(ref Buffer<T> column, int width = 1) where T : unmanaged
    {
        column[to] = column[from];
        column[from] = default;
    }
}

/// <summary>Clears rows.</summary>
/// <param name="start">The first row.</param>
/// <param name="count">Number of rows.</param>
readonly struct ClearRows(int start, int count) : IColumnVisitor
{
    public void Visit<T>(ref Buffer<T> column, int width = 1) where T : unmanaged => column.Clear(start, count);
}

/// <summary>Copies the first rows out of columns, or into them.</summary>
/// <param name="copy">Which of both, and where.</param>
/// <param name="count">Number of rows. There is room for them.</param>
readonly struct CopyColumns(StateCopy copy, int count) : IColumnVisitor
{
    public void Visit<T>(ref Buffer<T> column, int width = 1) where T : unmanaged => copy.CopyRows(column, count * width);
}

/// <summary>Gives the memory of columns back.</summary>
/// <param name="pool">Where it came from.</param>
readonly struct ReturnColumns(BufferPool pool) : IColumnVisitor
{
    public void Visit<T>(ref Buffer<T> column, int width = 1) where T : unmanaged => pool.Return(ref column);
}
