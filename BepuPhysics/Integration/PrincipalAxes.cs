using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Finds the frame in which an inertia tensor is diagonal.</summary>
static class PrincipalAxes
{
    // Each sweep of Jacobi rotations squares the off-diagonal size; four leave less than rounding from any start.
    const int Sweeps = 4;

    /// <summary>Principal frame and moments of a bundle of tensors. Diagonal ones, as of most shapes, cost a comparison.</summary>
    /// <param name="tensor">The tensors.</param>
    /// <param name="mask">Lanes that are asked for.</param>
    /// <param name="known">What was found for the bodies before, a row for each; null where there is no room for it.</param>
    /// <param name="indices">Indices of the bodies.</param>
    /// <param name="toBody">Rotation from the principal frame to the frame of the tensor; the identity where that is diagonal.</param>
    /// <param name="principal">Diagonal of the tensor in the principal frame.</param>
    /// <returns>Lanes that were asked for and are not diagonal.</returns>
    internal static unsafe Vector<int> Find(
        in Symmetric3x3Wide tensor, Vector<int> mask, PrincipalFrame* known, Vector<int> indices, out QuaternionWide toBody, out Vector3Wide principal)
    {
        toBody = QuaternionWide.Identity;
        principal = new(tensor.XX, tensor.YY, tensor.ZZ);
        var zero = Vector<float>.Zero;
        var isTilted = mask & ~(Vector.Equals(tensor.YX, zero) & Vector.Equals(tensor.ZX, zero) & Vector.Equals(tensor.ZY, zero));
        if (Vector.EqualsAll(isTilted, Vector<int>.Zero))
            return isTilted;
        var unknown = isTilted;
        if (known != null)
        {
            var row = Transpose.Gather((float*)known, Rows8.Count, indices);
            var isKnown = isTilted & Vector.Equals(row.R4, tensor.YX) & Vector.Equals(row.R5, tensor.ZX) & Vector.Equals(row.R6, tensor.ZY) &
                Vector.Equals(row.R7, PrincipalFrame.DiagonalKey(tensor));
            toBody = QuaternionWide.Select(isKnown, new(row.R0, row.R1, row.R2, row.R3), toBody);
            unknown = Vector.AndNot(isTilted, isKnown);
        }
        if (!Vector.EqualsAll(unknown, Vector<int>.Zero))
            FindUnknown(tensor, unknown, known, indices, ref toBody);
        // The same expression for found and for known frames, or a body would move otherwise for having been here before.
        var axes = Matrix3x3Wide.FromQuaternion(toBody);
        principal = new(
            Vector3Wide.Dot(axes.X, tensor * axes.X), Vector3Wide.Dot(axes.Y, tensor * axes.Y), Vector3Wide.Dot(axes.Z, tensor * axes.Z));
        return isTilted;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static unsafe void FindUnknown(
        in Symmetric3x3Wide tensor, Vector<int> mask, PrincipalFrame* known, Vector<int> indices, ref QuaternionWide toBody)
    {
        var copy = tensor;
        var keys = PrincipalFrame.DiagonalKey(tensor);
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            if (mask[lane] == 0)
                continue;
            Find(Lanes.Read<Symmetric3x3, Symmetric3x3Wide>(ref copy, lane), out var rotation, out _);
            Lanes.Write(rotation, ref toBody, lane);
            if (known != null && indices[lane] >= 0)
                known[indices[lane]] = new(rotation, new(tensor.YX[lane], tensor.ZX[lane], tensor.ZY[lane]), keys[lane]);
        }
    }

    /// <summary>Principal frame and moments of one tensor, by Jacobi rotations.</summary>
    internal static void Find(in Symmetric3x3 tensor, out Quaternion toBody, out Vector3 principal)
    {
        Span<float> a = [tensor.XX, tensor.YX, tensor.ZX, tensor.YX, tensor.YY, tensor.ZY, tensor.ZX, tensor.ZY, tensor.ZZ];
        toBody = Quaternion.Identity;
        for (int sweep = 0; sweep < Sweeps; ++sweep)
        {
            for (int axis = 0; axis < 3; ++axis)
                Rotate(a, axis, ref toBody);
        }
        principal = new(a[0], a[4], a[8]);
    }

    // Turns about one axis so that the off-diagonal entry of the two others becomes zero: tan(2 t) = 2 a_pq / (a_pp - a_qq).
    // The smaller root of t^2 + 2 theta t - 1 = 0 with theta = (a_pp - a_qq) / (2 a_pq) gives tan t without cancellation.
    static void Rotate(Span<float> a, int axis, ref Quaternion toBody)
    {
        int p = (axis + 1) % 3, q = (axis + 2) % 3;
        var off = a[p * 3 + q];
        if (off == 0)
            return;
        var theta = (a[p * 3 + p] - a[q * 3 + q]) / (2 * off);
        var tangent = 1 / (MathF.Abs(theta) + MathF.Sqrt(theta * theta + 1));
        if (theta < 0)
            tangent = -tangent;
        var cos = 1 / MathF.Sqrt(tangent * tangent + 1);
        var sin = tangent * cos;
        for (int k = 0; k < 3; ++k)
        {
            var x = a[k * 3 + p];
            var y = a[k * 3 + q];
            a[k * 3 + p] = cos * x + sin * y;
            a[k * 3 + q] = cos * y - sin * x;
        }
        for (int k = 0; k < 3; ++k)
        {
            var x = a[p * 3 + k];
            var y = a[q * 3 + k];
            a[p * 3 + k] = cos * x + sin * y;
            a[q * 3 + k] = cos * y - sin * x;
        }
        var cosHalf = MathF.Sqrt((1 + cos) * 0.5f);
        var sinHalf = sin / (2 * cosHalf);
        var step = new Quaternion(axis == 0 ? sinHalf : 0, axis == 1 ? sinHalf : 0, axis == 2 ? sinHalf : 0, cosHalf);
        toBody = Exact.Normalize(Exact.Concatenate(step, toBody));
    }
}
