using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using BenchmarkDotNet.Attributes;
using BepuUtilities;

namespace Benchmarks.Micro;

/// <summary>
/// What a layout of memory is worth: dot(dot(cross(a, b), a) * b, dot(cross(c, d), c) * d) over many lanes, the same numbers in four
/// layouts; nanoseconds per lane.
/// </summary>
/// <remarks>
/// But for rounding the expression is zero, as a cross product is perpendicular to its factors. It is there for its work: two cross
/// products, three dot products and two scalings on 48 bytes of input.
/// </remarks>
public unsafe class LayoutBenchmarks : IDisposable
{
    const int LanesPerCall = 1 << 20;
    const int FloatsPerLane = 12;

    // Arrays that lie a power of two apart share the sets of a cache; SOA would be measured at its worst, not at its own. Five lines more.
    const int ArrayPadding = 80;

    float* input;
    float* results;

    /// <summary>Lanes in memory: 2^20 are 52 MB, past most caches; 512 are 26 KB, which stay in the first level and are gone through
    /// 2048 times in a call.</summary>
    [Params(1 << 20, 512)]
    public int Lanes { get; set; } = LanesPerCall;

    int ArrayStride => Lanes + ArrayPadding;

    /// <summary>Structure after structure.</summary>
    [GlobalSetup(Targets = [nameof(ScalarAos), nameof(Vector3Aos)])]
    public void SetUpAos() => Fill((lane, component) => lane * FloatsPerLane + component);

    /// <summary>An array for each of the twelve numbers.</summary>
    [GlobalSetup(Target = nameof(Soa))]
    public void SetUpSoa() => Fill((lane, component) => component * ArrayStride + lane);

    /// <summary>Bundle after bundle; within a bundle, a vector for each of the twelve numbers.</summary>
    [GlobalSetup(Target = nameof(Aosoa))]
    public void SetUpAosoa()
    {
        int width = Vector<float>.Count;
        Fill((lane, component) => (lane / width * FloatsPerLane + component) * width + lane % width);
    }

    void Fill(Func<int, int, int> indexOf)
    {
        input = (float*)NativeMemory.AlignedAlloc((nuint)(ArrayStride * FloatsPerLane) * sizeof(float), 64);
        results = (float*)NativeMemory.AlignedAlloc((nuint)Lanes * sizeof(float), 64);
        new Span<float>(results, Lanes).Fill(float.NaN);
        var random = new Random(1);
        for (int lane = 0; lane < Lanes; ++lane)
        {
            for (int component = 0; component < FloatsPerLane; ++component)
                input[indexOf(lane, component)] = random.NextSingle() * 2 - 1;
        }
    }

    /// <summary>Frees the memory.</summary>
    /// <exception cref="InvalidOperationException">A lane was left out.</exception>
    [GlobalCleanup]
    public void Dispose()
    {
        bool complete = results is null || !new Span<float>(results, Lanes).Contains(float.NaN);
        NativeMemory.AlignedFree(input);
        NativeMemory.AlignedFree(results);
        input = results = null;
        GC.SuppressFinalize(this);
        if (!complete)
            throw new InvalidOperationException("A lane has no result.");
    }

    // The loops hold in locals what the JIT would otherwise read again after each write through a pointer.

    /// <summary>Structures of floats, one lane at a time.</summary>
    [Benchmark(Baseline = true, OperationsPerInvoke = LanesPerCall)]
    public void ScalarAos()
    {
        int count = Lanes;
        float* target = results;
        var lanes = (ScalarLane*)input;
        for (int pass = LanesPerCall / count; pass > 0; --pass)
        {
            for (int i = 0; i < count; ++i)
            {
                ref ScalarLane lane = ref lanes[i];
                ScalarVector left = lane.B * ScalarVector.Dot(ScalarVector.Cross(lane.A, lane.B), lane.A);
                ScalarVector right = lane.D * ScalarVector.Dot(ScalarVector.Cross(lane.C, lane.D), lane.C);
                target[i] = ScalarVector.Dot(left, right);
            }
        }
    }

    /// <summary>Structures of the framework's vectors, which put the three numbers of one vector into one register.</summary>
    [Benchmark(OperationsPerInvoke = LanesPerCall)]
    public void Vector3Aos()
    {
        int count = Lanes;
        float* target = results;
        var lanes = (Vector3Lane*)input;
        for (int pass = LanesPerCall / count; pass > 0; --pass)
        {
            for (int i = 0; i < count; ++i)
            {
                ref Vector3Lane lane = ref lanes[i];
                Vector3 left = lane.B * Vector3.Dot(Vector3.Cross(lane.A, lane.B), lane.A);
                Vector3 right = lane.D * Vector3.Dot(Vector3.Cross(lane.C, lane.D), lane.C);
                target[i] = Vector3.Dot(left, right);
            }
        }
    }

    /// <summary>Thirteen arrays side by side.</summary>
    [Benchmark(OperationsPerInvoke = LanesPerCall)]
    public void Soa()
    {
        (int count, int stride) = (Lanes, ArrayStride);
        float* target = results, source = input;
        for (int pass = LanesPerCall / count; pass > 0; --pass)
        {
            for (int i = 0; i < count; i += Vector<float>.Count)
            {
                float* lane = source + i;
                *(Vector<float>*)(target + i) = Evaluate(Load(lane, stride), Load(lane + 3 * stride, stride),
                    Load(lane + 6 * stride, stride), Load(lane + 9 * stride, stride));
            }
        }
    }

    /// <summary>Arrays of bundles: the layout of the constraints and of the pair tests.</summary>
    [Benchmark(OperationsPerInvoke = LanesPerCall)]
    public void Aosoa()
    {
        int count = Lanes / Vector<float>.Count;
        var target = (Vector<float>*)results;
        var bundles = (WideLane*)input;
        for (int pass = LanesPerCall / Lanes; pass > 0; --pass)
        {
            for (int i = 0; i < count; ++i)
            {
                ref WideLane lane = ref bundles[i];
                target[i] = Evaluate(lane.A, lane.B, lane.C, lane.D);
            }
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector<float> Evaluate(in Vector3Wide a, in Vector3Wide b, in Vector3Wide c, in Vector3Wide d)
    {
        Vector3Wide left = b * Vector3Wide.Dot(Vector3Wide.Cross(a, b), a);
        Vector3Wide right = d * Vector3Wide.Dot(Vector3Wide.Cross(c, d), c);
        return Vector3Wide.Dot(left, right);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector3Wide Load(float* x, int stride) =>
        new(*(Vector<float>*)x, *(Vector<float>*)(x + stride), *(Vector<float>*)(x + 2 * stride));

    readonly struct ScalarVector(float x, float y, float z)
    {
        public readonly float X = x, Y = y, Z = z;

        public static ScalarVector operator *(ScalarVector v, float scale) => new(v.X * scale, v.Y * scale, v.Z * scale);

        public static float Dot(ScalarVector a, ScalarVector b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z;

        public static ScalarVector Cross(ScalarVector a, ScalarVector b) =>
            new(a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);
    }

#pragma warning disable CS0649 // They are laid over memory that others fill.
    struct ScalarLane
    {
        public ScalarVector A, B, C, D;
    }

    struct Vector3Lane
    {
        public Vector3 A, B, C, D;
    }

    struct WideLane
    {
        public Vector3Wide A, B, C, D;
    }
#pragma warning restore CS0649
}
