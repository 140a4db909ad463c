using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>Mass, centre of mass and inertia of what triangles enclose, or of the triangles as thin sheets.</summary>
/// <remarks>
/// Triangles are clockwise seen from outside, as the front of a <see cref="Triangle"/> is. Sums are kept in double precision. Tensors are not inverted,
/// and are around the origin of the triangles' coordinates.
/// </remarks>
public static class MeshInertiaHelper
{
    /// <summary>Volume of the tetrahedron from the origin to a triangle; negative if the origin is in front of it.</summary>
    /// <param name="a">First corner, m.</param>
    /// <param name="b">Second corner, m.</param>
    /// <param name="c">Third corner, m.</param>
    public static float ComputeTetrahedronVolume(Vector3 a, Vector3 b, Vector3 c)
    {
        var integrals = default(MassIntegrals);
        AddSolid(ref integrals, a, b, c);
        return (float)integrals.Measure;
    }

    /// <summary>Inertia tensor of a tetrahedron from the origin to a triangle, around the origin.</summary>
    /// <param name="a">First corner, m.</param>
    /// <param name="b">Second corner, m.</param>
    /// <param name="c">Third corner, m.</param>
    /// <param name="mass">Mass of the tetrahedron, kg.</param>
    /// <param name="inertiaTensor">Inertia tensor, kg m2; zero for a tetrahedron without volume.</param>
    public static void ComputeTetrahedronContribution(Vector3 a, Vector3 b, Vector3 c, float mass, out Symmetric3x3 inertiaTensor)
    {
        var integrals = default(MassIntegrals);
        AddSolid(ref integrals, a, b, c);
        inertiaTensor = Tensor(integrals, mass);
    }

    /// <summary>Volume and inertia tensor of a tetrahedron from the origin to a triangle, of density 1.</summary>
    /// <param name="a">First corner, m.</param>
    /// <param name="b">Second corner, m.</param>
    /// <param name="c">Third corner, m.</param>
    /// <param name="volume">Volume, m3; negative if the origin is in front of the triangle.</param>
    /// <param name="inertiaTensor">Inertia tensor around the origin, of the sign of the volume.</param>
    public static void ComputeTetrahedronContribution(Vector3 a, Vector3 b, Vector3 c, out float volume, out Symmetric3x3 inertiaTensor)
    {
        var integrals = default(MassIntegrals);
        AddSolid(ref integrals, a, b, c);
        volume = (float)integrals.Measure;
        inertiaTensor = Tensor(integrals, volume);
    }

    /// <summary>Area of a triangle.</summary>
    /// <param name="a">First corner, m.</param>
    /// <param name="b">Second corner, m.</param>
    /// <param name="c">Third corner, m.</param>
    public static float ComputeTriangleArea(Vector3 a, Vector3 b, Vector3 c)
    {
        var integrals = default(MassIntegrals);
        integrals.AddTriangle(Widen(a), Widen(b), Widen(c));
        return (float)integrals.Measure;
    }

    /// <summary>Inertia tensor of a triangle as a thin sheet, around the origin.</summary>
    /// <param name="a">First corner, m.</param>
    /// <param name="b">Second corner, m.</param>
    /// <param name="c">Third corner, m.</param>
    /// <param name="mass">Mass of the triangle, kg.</param>
    /// <param name="inertiaTensor">Inertia tensor, kg m2; zero for a triangle without area.</param>
    public static void ComputeTriangleContribution(Vector3 a, Vector3 b, Vector3 c, float mass, out Symmetric3x3 inertiaTensor)
    {
        var integrals = default(MassIntegrals);
        integrals.AddTriangle(Widen(a), Widen(b), Widen(c));
        inertiaTensor = Tensor(integrals, mass);
    }

    /// <summary>Area and inertia tensor of a triangle as a thin sheet of density 1.</summary>
    /// <param name="a">First corner, m.</param>
    /// <param name="b">Second corner, m.</param>
    /// <param name="c">Third corner, m.</param>
    /// <param name="area">Area, m2.</param>
    /// <param name="inertiaTensor">Inertia tensor around the origin.</param>
    public static void ComputeTriangleContribution(Vector3 a, Vector3 b, Vector3 c, out float area, out Symmetric3x3 inertiaTensor)
    {
        var integrals = default(MassIntegrals);
        integrals.AddTriangle(Widen(a), Widen(b), Widen(c));
        area = (float)integrals.Measure;
        inertiaTensor = Tensor(integrals, area);
    }

    /// <summary>Volume and inertia tensor of what a closed surface encloses.</summary>
    /// <param name="triangleSource">The triangles.</param>
    /// <param name="mass">Mass of all, kg.</param>
    /// <param name="volume">Volume, m3; negative if the triangles are inside out.</param>
    /// <param name="inertia">Inertia tensor around the origin, kg m2; zero without volume.</param>
    public static void ComputeClosedInertia<TTriangleSource>(ref TTriangleSource triangleSource, float mass, out float volume, out Symmetric3x3 inertia)
        where TTriangleSource : ITriangleSource => ComputeClosedInertia(ref triangleSource, mass, out volume, out inertia, out _);

    /// <summary>Volume, centre of mass and inertia tensor of what a closed surface encloses.</summary>
    /// <param name="triangleSource">The triangles.</param>
    /// <param name="mass">Mass of all, kg.</param>
    /// <param name="volume">Volume, m3; negative if the triangles are inside out.</param>
    /// <param name="inertia">Inertia tensor around the origin, not the centre; zero without volume.</param>
    /// <param name="center">Centre of mass, m; the origin without volume.</param>
    public static void ComputeClosedInertia<TTriangleSource>(
        ref TTriangleSource triangleSource, float mass, out float volume, out Symmetric3x3 inertia, out Vector3 center)
        where TTriangleSource : ITriangleSource
    {
        var integrals = Integrate(ref triangleSource, isClosed: true);
        volume = (float)integrals.Measure;
        inertia = Tensor(integrals, mass);
        center = Center(integrals);
    }

    /// <summary>Volume and centre of mass of what a closed surface encloses.</summary>
    /// <param name="triangleSource">The triangles.</param>
    /// <param name="volume">Volume, m3; negative if the triangles are inside out.</param>
    /// <param name="center">Centre of mass, m; the origin without volume.</param>
    public static void ComputeClosedCenterOfMass<TTriangleSource>(ref TTriangleSource triangleSource, out float volume, out Vector3 center)
        where TTriangleSource : ITriangleSource => ComputeClosedInertia(ref triangleSource, 1, out volume, out _, out center);

    /// <summary>Inertia tensor of triangles as thin sheets.</summary>
    /// <param name="triangleSource">The triangles.</param>
    /// <param name="mass">Mass of all, kg.</param>
    /// <param name="inertia">Inertia tensor around the origin, kg m2; zero without area.</param>
    public static void ComputeOpenInertia<TTriangleSource>(ref TTriangleSource triangleSource, float mass, out Symmetric3x3 inertia)
        where TTriangleSource : ITriangleSource => ComputeOpenInertia(ref triangleSource, mass, out inertia, out _);

    /// <summary>Inertia tensor and centre of mass of triangles as thin sheets.</summary>
    /// <param name="triangleSource">The triangles.</param>
    /// <param name="mass">Mass of all, kg.</param>
    /// <param name="inertia">Inertia tensor around the origin, not the centre; zero without area.</param>
    /// <param name="center">Centre of mass, m; the origin without area.</param>
    public static void ComputeOpenInertia<TTriangleSource>(ref TTriangleSource triangleSource, float mass, out Symmetric3x3 inertia, out Vector3 center)
        where TTriangleSource : ITriangleSource
    {
        var integrals = Integrate(ref triangleSource, isClosed: false);
        inertia = Tensor(integrals, mass);
        center = Center(integrals);
    }

    /// <summary>Centre of mass of triangles as thin sheets; the origin without area.</summary>
    /// <param name="triangleSource">The triangles.</param>
    public static Vector3 ComputeOpenCenterOfMass<TTriangleSource>(ref TTriangleSource triangleSource) where TTriangleSource : ITriangleSource
    {
        ComputeOpenInertia(ref triangleSource, 1, out _, out var center);
        return center;
    }

    /// <summary>What is to be added to an inertia tensor around a point to have it around the centre of mass: by the theorem of parallel axes.</summary>
    /// <param name="mass">Mass, kg.</param>
    /// <param name="offset">From the point to the centre of mass, m.</param>
    /// <param name="inertiaOffset">The difference, kg m2; negative on the diagonal.</param>
    public static void GetInertiaOffset(float mass, Vector3 offset, out Symmetric3x3 inertiaOffset)
    {
        float x = offset.X * offset.X, y = offset.Y * offset.Y, z = offset.Z * offset.Z;
        inertiaOffset = new(-mass * (y + z), mass * (offset.Y * offset.X), -mass * (x + z), mass * (offset.Z * offset.X), mass * (offset.Z * offset.Y),
            -mass * (x + y));
    }

    internal static MassIntegrals Integrate<TTriangleSource>(ref TTriangleSource source, bool isClosed) where TTriangleSource : ITriangleSource
    {
        var integrals = default(MassIntegrals);
        while (source.GetNextTriangle(out var a, out var b, out var c))
        {
            if (isClosed)
                AddSolid(ref integrals, a, b, c);
            else
                integrals.AddTriangle(Widen(a), Widen(b), Widen(c));
        }
        return integrals;
    }

    // The integral takes triangles that are counterclockwise seen from outside.
    static void AddSolid(ref MassIntegrals integrals, Vector3 a, Vector3 b, Vector3 c) => integrals.AddTetrahedron(Widen(a), Widen(c), Widen(b));

    static (double X, double Y, double Z) Widen(Vector3 v) => (v.X, v.Y, v.Z);

    static Vector3 Center(in MassIntegrals integrals)
    {
        if (integrals.Measure == 0)
            return default;
        var (x, y, z) = integrals.Center;
        return new((float)x, (float)y, (float)z);
    }

    static Symmetric3x3 Tensor(in MassIntegrals integrals, double mass)
    {
        if (integrals.Measure == 0)
            return default;
        return integrals.GetMoments(aroundCenter: false).ToFloats(mass);
    }
}
