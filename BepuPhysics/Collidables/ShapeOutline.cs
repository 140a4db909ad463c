using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>What a convex shape lies in, as a container sees it: a box or a cylinder of any orientation, and a ball around each of its points.</summary>
/// <remarks>A container may leave out what lies beyond it, of what the box around the shape meets. Nothing at all says nothing.</remarks>
struct ShapeOutline
{
    /// <summary>Centre in the container's frame, m.</summary>
    public Vector3 Center;
    /// <summary>From the centre to the sides of the box, in the container's frame, m; of a cylinder Y alone, to its end.</summary>
    public Vector3 X, Y, Z;
    /// <summary>Unit axis of a cylinder, and its radius, m; a segment has none.</summary>
    public Vector3 Axis;
    public float RoundRadius;
    /// <summary>Radius of the ball, m; what of it is margin.</summary>
    public float Radius, Margin;
    /// <summary>Whether it is a box, or a cylinder.</summary>
    public bool IsBox, IsRound;

    /// <summary>Whether it is the ball alone, around the centre.</summary>
    public bool IsBall;

    /// <summary>Whether anything is known.</summary>
    public readonly bool IsKnown => IsBox || IsRound;

    /// <summary>A shape in its own frame, with a margin around it; nothing is known of one that is neither box nor round.</summary>
    // In place: what is made elsewhere first is copied as a whole, and waits for its parts.
    public unsafe void Write(int typeId, void* shape, in Vector3 center, in Quaternion orientation, float margin)
    {
        this = default;
        Center = center;
        Radius = Margin = margin;
        switch (typeId)
        {
            case Box.Id:
                var box = (Box*)shape;
                var axes = Matrix3x3.FromQuaternion(orientation);
                SetBox(axes, new(box->HalfWidth, box->HalfHeight, box->HalfLength));
                break;
            case Sphere.Id:
                Radius += ((Sphere*)shape)->Radius;
                IsRound = IsBall = true;
                break;
            case Capsule.Id:
                Radius += ((Capsule*)shape)->Radius;
                SetRound(Exact.Rotate(Vector3.UnitY, orientation), ((Capsule*)shape)->HalfLength, 0);
                break;
            case Cylinder.Id:
                SetRound(Exact.Rotate(Vector3.UnitY, orientation), ((Cylinder*)shape)->HalfLength, ((Cylinder*)shape)->Radius);
                break;
        }
    }

    /// <summary>Makes it a box.</summary>
    /// <param name="axes">Its axes, as rows.</param>
    /// <param name="half">Half of its sides, m.</param>
    public void SetBox(in Matrix3x3 axes, in Vector3 half)
    {
        (X, Y, Z) = (axes.X * half.X, axes.Y * half.Y, axes.Z * half.Z);
        IsBox = true;
    }

    void SetRound(in Vector3 axis, float halfLength, float radius)
    {
        Axis = axis;
        Y = axis * halfLength;
        RoundRadius = radius;
        IsRound = true;
    }
}
