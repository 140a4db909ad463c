using System;
using System.Numerics;
using BepuPhysics.Collidables;

namespace DemoTests.CollisionDetection.References;

/// <summary>A box with a radius around it, in double precision: spheres and capsules are those whose box is a point or a segment.</summary>
sealed class RoundedBox
{
    public readonly Double3 Center;
    public readonly Double3[] Axes = new Double3[3];
    public readonly double[] Half;
    public readonly double Radius;

    public RoundedBox(Sphere sphere, Vector3 position) : this(position, Quaternion.Identity, [0, 0, 0], sphere.Radius) { }

    public RoundedBox(Capsule capsule, Vector3 position, Quaternion orientation) :
        this(position, orientation, [0, capsule.HalfLength, 0], capsule.Radius)
    { }

    public RoundedBox(Box box, Vector3 position, Quaternion orientation) :
        this(position, orientation, [box.HalfWidth, box.HalfHeight, box.HalfLength], 0)
    { }

    RoundedBox(Vector3 position, Quaternion orientation, double[] half, double radius)
    {
        Center = new(position);
        Half = half;
        Radius = radius;
        for (int i = 0; i < 3; ++i)
            Axes[i] = Double3.RotatedAxis(orientation, i);
    }

    public bool IsBox => Half[0] > 0;

    /// <summary>Distance from the centre to the farthest point.</summary>
    public double Size => Radius + Math.Sqrt(Half[0] * Half[0] + Half[1] * Half[1] + Half[2] * Half[2]);

    /// <summary>Extent from the centre along a unit direction.</summary>
    public double Extent(Double3 direction)
    {
        var extent = Radius;
        for (int i = 0; i < 3; ++i)
            extent += Half[i] * Math.Abs(Double3.Dot(direction, Axes[i]));
        return extent;
    }

    /// <summary>Corner of the core by its number.</summary>
    public Double3 Corner(int index)
    {
        var corner = Center;
        for (int i = 0; i < 3; ++i)
            corner += Axes[i] * ((index >> i & 1) == 0 ? -Half[i] : Half[i]);
        return corner;
    }

    /// <summary>Distance of a point from the core; zero inside.</summary>
    public double CoreDistance(Double3 point)
    {
        var sum = 0.0;
        for (int i = 0; i < 3; ++i)
        {
            var outside = Math.Max(0, Math.Abs(Double3.Dot(point - Center, Axes[i])) - Half[i]);
            sum += outside * outside;
        }
        return Math.Sqrt(sum);
    }

    /// <summary>Distance of a point from the surface, negative inside.</summary>
    public double SignedDistance(Double3 point)
    {
        var distance = CoreDistance(point);
        if (distance > 0 || !IsBox)
            return distance - Radius;
        var deepest = double.MinValue;
        for (int i = 0; i < 3; ++i)
            deepest = Math.Max(deepest, Math.Abs(Double3.Dot(point - Center, Axes[i])) - Half[i]);
        return deepest;
    }
}
