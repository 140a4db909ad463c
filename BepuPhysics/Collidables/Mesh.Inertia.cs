using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Collidables;

// Centre of mass and inertia of a mesh.
public unsafe partial struct Mesh
{
    /// <summary>Gives the triangles of a mesh, scaled, but those that are left out.</summary>
    /// <param name="mesh">The mesh.</param>
    public struct MeshTriangleSource(in Mesh mesh) : ITriangleSource
    {
        readonly Mesh mesh = mesh;
        int next;

        /// <inheritdoc/>
        public bool GetNextTriangle(out Vector3 a, out Vector3 b, out Vector3 c)
        {
            while (next < mesh.ChildCount)
            {
                var triangle = next++;
                if (mesh.Header->IsLeftOut(triangle))
                    continue;
                mesh.GetChild(triangle, out var child);
                (a, b, c) = (child.A, child.B, child.C);
                return true;
            }
            a = b = c = default;
            return false;
        }
    }

    /// <summary>Inverse mass and inertia of what a closed mesh encloses, around its centre of mass, to which the origin of the mesh is moved.</summary>
    /// <remarks>All that share the memory of the mesh are moved.</remarks>
    /// <param name="mass">Mass, kg; finite and positive.</param>
    /// <param name="center">Centre of mass in the coordinates that the mesh had before, m.</param>
    /// <exception cref="ArgumentException">The triangles enclose nothing or are inside out, or the mass is out of range.</exception>
    public BodyInertia ComputeClosedInertia(float mass, out Vector3 center)
    {
        var inertia = ComputeCenteredInertia(mass, out center);
        Recenter(center);
        return inertia;
    }

    /// <summary>As <see cref="ComputeClosedInertia(float, out Vector3)"/>, with the mesh where it is.</summary>
    internal readonly BodyInertia ComputeCenteredInertia(float mass, out Vector3 center)
    {
        var inertia = Integrate(isClosed: true, out var volume).Invert(mass, volume.Size, aroundCenter: true);
        center = volume.Center;
        return inertia;
    }

    /// <summary>Inverse mass and inertia of what a closed mesh encloses, around the origin of its frame.</summary>
    /// <param name="mass">Mass, kg; finite and positive.</param>
    /// <exception cref="ArgumentException">The triangles enclose nothing or are inside out, or the mass is out of range.</exception>
    public readonly BodyInertia ComputeClosedInertia(float mass) =>
        Integrate(isClosed: true, out var volume).Invert(mass, volume.Size, aroundCenter: false);

    /// <summary>Volume and centre of mass of what a closed mesh encloses.</summary>
    /// <param name="volume">Volume, m3.</param>
    /// <param name="center">Centre of mass, m.</param>
    /// <exception cref="ArgumentException">The triangles enclose nothing or are inside out.</exception>
    public readonly void ComputeClosedCenterOfMass(out float volume, out Vector3 center)
    {
        var integrals = Integrate(isClosed: true, out var measure);
        volume = (float)(integrals.Measure * measure.Size * measure.Size * measure.Size);
        center = measure.Center;
    }

    /// <summary>Centre of mass of what a closed mesh encloses, m.</summary>
    /// <exception cref="ArgumentException">The triangles enclose nothing or are inside out.</exception>
    public readonly Vector3 ComputeClosedCenterOfMass()
    {
        Integrate(isClosed: true, out var volume);
        return volume.Center;
    }

    /// <summary>Inverse mass and inertia of the triangles as thin sheets, around their centre of mass, to which the origin of the mesh is moved.</summary>
    /// <remarks>All that share the memory of the mesh are moved.</remarks>
    /// <param name="mass">Mass, kg; finite and positive.</param>
    /// <param name="center">Centre of mass in the coordinates that the mesh had before, m.</param>
    /// <exception cref="ArgumentException">The mass is out of range.</exception>
    public BodyInertia ComputeOpenInertia(float mass, out Vector3 center)
    {
        var inertia = Integrate(isClosed: false, out var area).Invert(mass, area.Size, aroundCenter: true);
        center = area.Center;
        Recenter(center);
        return inertia;
    }

    /// <summary>Inverse mass and inertia of the triangles as thin sheets, around the origin of the mesh's frame.</summary>
    /// <param name="mass">Mass, kg; finite and positive.</param>
    /// <exception cref="ArgumentException">The mass is out of range.</exception>
    public readonly BodyInertia ComputeOpenInertia(float mass) =>
        Integrate(isClosed: false, out var area).Invert(mass, area.Size, aroundCenter: false);

    /// <summary>Centre of mass of the triangles as thin sheets, m.</summary>
    public readonly Vector3 ComputeOpenCenterOfMass()
    {
        Integrate(isClosed: false, out var area);
        return area.Center;
    }

    /// <summary>Moves the origin of the mesh.</summary>
    /// <remarks>Of all that share its memory. Corners are rounded anew. Bounds of what uses the mesh as a shape are to be updated.</remarks>
    /// <param name="newCenter">The new origin in the coordinates of the mesh, scaled, m.</param>
    /// <exception cref="ArgumentException">The new origin is not finite, or corners are too far from it.</exception>
    public void Recenter(Vector3 newCenter)
    {
        Validate();
        GetScaledBounds(out var min, out var max);
        Vector3 low = min - newCenter, high = max - newCenter;
        const float Limit = ShapeLimits.MaximumSize;
        if (!(low.X >= -Limit && low.Y >= -Limit && low.Z >= -Limit && high.X <= Limit && high.Y <= Limit && high.Z <= Limit))
            throw new ArgumentException($"Around {newCenter} the mesh would reach from {low} to {high}; the limit is {Limit} m.", nameof(newCenter));
        var offset = newCenter / scale;
        var vertices = Header->Vertices;
        for (int i = 0; i < Header->VertexCount; ++i)
            vertices[i] -= offset;
        MeshBuilder.Measure(ref *Header, vertices);
        MeshTree.Refit(Header);
    }

    // In units of the mesh's size, so that no power of one leaves the range even of a double's precision.
    struct Measured
    {
        public double Size;
        public Vector3 Center;
    }

    struct ScaledSource(in Mesh mesh, double size) : ITriangleSource
    {
        MeshTriangleSource source = new(mesh);
        readonly float inverse = (float)(1 / size);

        public bool GetNextTriangle(out Vector3 a, out Vector3 b, out Vector3 c)
        {
            if (!source.GetNextTriangle(out a, out b, out c))
                return false;
            a *= inverse;
            b *= inverse;
            c *= inverse;
            return true;
        }
    }

    readonly MassIntegrals Integrate(bool isClosed, out Measured measured)
    {
        Validate();
        GetScaledBounds(out var min, out var max);
        var extent = Exact.Max(Vector3.Abs(min), Vector3.Abs(max)).Largest();
        // A power of two, by which corners are divided without being rounded.
        var size = BitConverter.Int64BitsToDouble(BitConverter.DoubleToInt64Bits(extent) & 0x7FF0_0000_0000_0000);
        var source = new ScaledSource(this, size);
        var integrals = MeshInertiaHelper.Integrate(ref source, isClosed);
        if (!(integrals.Measure > 0))
        {
            throw new ArgumentException($"The volume of the mesh is {integrals.Measure * size * size * size} m3: it is not closed, flat, or inside out. " +
                "Triangles are clockwise seen from outside.");
        }
        var (x, y, z) = integrals.Center;
        measured = new() { Size = size, Center = new((float)(x * size), (float)(y * size), (float)(z * size)) };
        return integrals;
    }
}
