using System;

namespace BepuPhysics.Collidables;

/// <summary>All sums of whole multiples of up to six vectors of six dimensions, for the one that is near to a point.</summary>
ref struct Lattice
{
    const int Size = 6;
    // Of the condition that ends the reduction; nearer to 1 the basis is better and takes longer.
    const double Progress = 0.99;
    // Far more swaps than a basis of six vectors ever took; an end for one whose numbers left the precision of doubles.
    const int MaximumSteps = 10_000;

    /// <summary>Number of doubles that a lattice works in.</summary>
    public const int MemoryLength = 4 * Size * Size + Size;

    // Rows of the basis; how often each vector that was added is in them; rows made orthogonal; coefficients of the rows in these.
    readonly Span<double> basis, multiples, orthogonal, coefficients, lengths;
    int count;

    /// <summary>A lattice without vectors.</summary>
    /// <param name="memory">Of <see cref="MemoryLength"/>, to work in.</param>
    public Lattice(Span<double> memory)
    {
        memory.Clear();
        basis = memory[..(Size * Size)];
        multiples = memory[(Size * Size)..(2 * Size * Size)];
        orthogonal = memory[(2 * Size * Size)..(3 * Size * Size)];
        coefficients = memory[(3 * Size * Size)..(4 * Size * Size)];
        lengths = memory[(4 * Size * Size)..];
    }

    static Span<double> Row(Span<double> matrix, int row) => matrix.Slice(row * Size, Size);

    /// <summary>Adds a vector that is independent of those before, by a number below six that no other has.</summary>
    public void Add(ReadOnlySpan<double> vector, int number)
    {
        vector.CopyTo(Row(basis, count));
        Row(multiples, count)[number] = 1;
        ++count;
    }

    /// <summary>Makes the vectors short and nearly at right angles; the lattice stays the same.</summary>
    public void Reduce()
    {
        Orthogonalize();
        var row = 1;
        for (int step = 0; row < count && step < MaximumSteps; ++step)
        {
            for (int other = row - 1; other >= 0; --other)
                Subtract(row, other);
            var ahead = Row(coefficients, row)[row - 1];
            if (lengths[row] >= (Progress - ahead * ahead) * lengths[row - 1])
            {
                ++row;
                continue;
            }
            Swap(Row(basis, row), Row(basis, row - 1));
            Swap(Row(multiples, row), Row(multiples, row - 1));
            Orthogonalize();
            row = Math.Max(row - 1, 1);
        }
    }

    /// <summary>Finds a point of a reduced lattice that is near to a point: how often each vector that was added is in it, by its number.</summary>
    public readonly void FindNearest(ReadOnlySpan<double> point, Span<double> numbers)
    {
        Span<double> rest = stackalloc double[Size];
        point.CopyTo(rest);
        numbers.Clear();
        for (int row = count - 1; row >= 0; --row)
        {
            var times = Math.Round(Dot(rest, Row(orthogonal, row)) / lengths[row]);
            AddTimes(rest, -times, Row(basis, row));
            AddTimes(numbers, times, Row(multiples, row));
        }
    }

    readonly void Subtract(int row, int other)
    {
        var times = Math.Round(Row(coefficients, row)[other]);
        if (times == 0)
            return;
        AddTimes(Row(basis, row), -times, Row(basis, other));
        AddTimes(Row(multiples, row), -times, Row(multiples, other));
        for (int i = 0; i < other; ++i)
            Row(coefficients, row)[i] -= times * Row(coefficients, other)[i];
        Row(coefficients, row)[other] -= times;
    }

    readonly void Orthogonalize()
    {
        for (int row = 0; row < count; ++row)
        {
            var result = Row(orthogonal, row);
            Row(basis, row).CopyTo(result);
            for (int other = 0; other < row; ++other)
            {
                var coefficient = Dot(Row(basis, row), Row(orthogonal, other)) / lengths[other];
                Row(coefficients, row)[other] = coefficient;
                AddTimes(result, -coefficient, Row(orthogonal, other));
            }
            lengths[row] = Dot(result, result);
        }
    }

    static double Dot(ReadOnlySpan<double> a, ReadOnlySpan<double> b)
    {
        var sum = 0.0;
        for (int i = 0; i < Size; ++i)
            sum += a[i] * b[i];
        return sum;
    }

    static void AddTimes(Span<double> target, double times, ReadOnlySpan<double> source)
    {
        for (int i = 0; i < Size; ++i)
            target[i] += times * source[i];
    }

    static void Swap(Span<double> a, Span<double> b)
    {
        for (int i = 0; i < Size; ++i)
            (a[i], b[i]) = (b[i], a[i]);
    }
}
