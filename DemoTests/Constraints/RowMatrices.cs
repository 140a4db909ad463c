using System;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace DemoTests.Constraints;

/// <summary>Lanes of the matrices over rows, entry by entry.</summary>
static class RowMatrices
{
    public static double[,] Dense(object matrix, int lane) => matrix switch
    {
        Rows1 m => new double[,] { { m.X[lane] } },
        RowMatrix2 m => Assemble(2, Entry(m.M, lane), null, null, 2),
        RowMatrix3 m => Assemble(3, Entry(m.M, lane), null, null, 3),
        RowMatrix4 m => Assemble(4, Entry(m.Linear, lane), (i, _) => Component(m.Coupling, i, lane), (_, _) => m.Angular[lane], 3),
        RowMatrix5 m => Assemble(5, Entry(m.Linear, lane), (i, j) => Component(j == 0 ? m.Coupling.X : m.Coupling.Y, i, lane), Entry(m.Angular, lane), 3),
        RowMatrix6 m => Assemble(6, Entry(m.Linear, lane),
            (i, j) => Component(i == 0 ? m.Coupling.X : i == 1 ? m.Coupling.Y : m.Coupling.Z, j, lane), Entry(m.Angular, lane), 3),
        _ => throw new ArgumentException($"No dense form of {matrix.GetType()}."),
    };

    static double[,] Assemble(int count, Func<int, int, double> a, Func<int, int, double>? b, Func<int, int, double>? d, int split)
    {
        var dense = new double[count, count];
        for (int i = 0; i < count; ++i)
        {
            for (int j = 0; j <= i; ++j)
                dense[i, j] = dense[j, i] = i < split ? a(i, j) : j < split ? b!(j, i - split) : d!(i - split, j - split);
        }
        return dense;
    }

    static double Component(Vector3Wide v, int index, int lane) => (index == 0 ? v.X : index == 1 ? v.Y : v.Z)[lane];

    static Func<int, int, double> Entry(Symmetric3x3Wide m, int lane) => (i, j) => (i, j) switch
    {
        (0, 0) => m.XX[lane],
        (1, 0) => m.YX[lane],
        (1, 1) => m.YY[lane],
        (2, 0) => m.ZX[lane],
        (2, 1) => m.ZY[lane],
        _ => m.ZZ[lane],
    };

    static Func<int, int, double> Entry(Symmetric2x2Wide m, int lane) => (i, j) => (i, j) switch
    {
        (0, 0) => m.XX[lane],
        (1, 0) => m.YX[lane],
        _ => m.YY[lane],
    };
}
