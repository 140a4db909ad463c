using System.Numerics;
using System.Runtime.Intrinsics;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A small turn of lever arms about a normal.</summary>
/// <param name="normal">The normal, unit length.</param>
/// <param name="tangent">Tangent of half the angle, twice.</param>
readonly struct ArmTurn(Vector3 normal, float tangent)
{
    // v + s n x v + c n x (n x v), of the length of v: s = t / (1 + t^2 / 4), c = s t / 2.
    readonly Vector3 axis = normal;
    readonly float sine = tangent / (1 + tangent * tangent * 0.25f);
    readonly float rest = tangent / (1 + tangent * tangent * 0.25f) * tangent * 0.5f;

    /// <summary>Turns an arm.</summary>
    public Vector3 Apply(in Vector3 arm)
    {
        var across = Exact.Cross(axis, arm);
        return arm + across * sine + Exact.Cross(axis, across) * rest;
    }

    /// <summary>Turns four arms.</summary>
    public (Vector128<float> X, Vector128<float> Y, Vector128<float> Z) Apply(Vector128<float> x, Vector128<float> y, Vector128<float> z)
    {
        var across = Cross(x, y, z);
        var twice = Cross(across.X, across.Y, across.Z);
        return (x + across.X * sine + twice.X * rest, y + across.Y * sine + twice.Y * rest, z + across.Z * sine + twice.Z * rest);
    }

    (Vector128<float> X, Vector128<float> Y, Vector128<float> Z) Cross(Vector128<float> x, Vector128<float> y, Vector128<float> z) =>
        (z * axis.Y - y * axis.Z, x * axis.Z - z * axis.X, y * axis.X - x * axis.Y);
}
