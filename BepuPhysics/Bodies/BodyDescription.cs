using System.Numerics;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Everything about a body when it is added.</summary>
public struct BodyDescription
{
    /// <summary>Where the body is. An orientation that is off unit length by up to .5 % is normalised, and refused beyond.</summary>
    public RigidPose Pose;
    /// <summary>How it moves.</summary>
    public BodyVelocity Velocity;
    /// <summary>Its inverse mass and inertia in its own frame; all zero for a kinematic body.</summary>
    public BodyInertia LocalInertia;
    /// <summary>Its shape.</summary>
    public CollidableDescription Collidable;
    /// <summary>When it may sleep.</summary>
    public BodyActivityDescription Activity;

    /// <summary>A body that forces and contacts move.</summary>
    public static BodyDescription CreateDynamic(
        RigidPose pose, BodyVelocity velocity, BodyInertia inertia, CollidableDescription collidable, BodyActivityDescription activity) =>
        new() { Pose = pose, Velocity = velocity, LocalInertia = inertia, Collidable = collidable, Activity = activity };

    /// <summary>A body that forces and contacts move, at rest.</summary>
    public static BodyDescription CreateDynamic(
        RigidPose pose, BodyInertia inertia, CollidableDescription collidable, BodyActivityDescription activity) =>
        CreateDynamic(pose, default, inertia, collidable, activity);

    /// <summary>A body that keeps the velocity it is given.</summary>
    public static BodyDescription CreateKinematic(
        RigidPose pose, BodyVelocity velocity, CollidableDescription collidable, BodyActivityDescription activity) =>
        new() { Pose = pose, Velocity = velocity, Collidable = collidable, Activity = activity };

    /// <summary>A body that keeps the velocity it is given, at rest.</summary>
    public static BodyDescription CreateKinematic(RigidPose pose, CollidableDescription collidable, BodyActivityDescription activity) =>
        CreateKinematic(pose, default, collidable, activity);

    /// <summary>A dynamic body of a convex shape of uniform density. Adds the shape.</summary>
    public static BodyDescription CreateConvexDynamic<TShape>(RigidPose pose, BodyVelocity velocity, float mass, Shapes shapes, in TShape shape)
        where TShape : unmanaged, IConvexShape =>
        CreateDynamic(pose, velocity, shape.ComputeInertia(mass), shapes.Add(shape), GetDefaultActivity(shape));

    /// <summary>A dynamic body of a convex shape of uniform density, at rest. Adds the shape.</summary>
    public static BodyDescription CreateConvexDynamic<TShape>(RigidPose pose, float mass, Shapes shapes, in TShape shape)
        where TShape : unmanaged, IConvexShape => CreateConvexDynamic(pose, default, mass, shapes, shape);

    /// <summary>A kinematic body of a convex shape. Adds the shape.</summary>
    public static BodyDescription CreateConvexKinematic<TShape>(RigidPose pose, BodyVelocity velocity, Shapes shapes, TShape shape)
        where TShape : unmanaged, IConvexShape => CreateKinematic(pose, velocity, shapes.Add(shape), GetDefaultActivity(shape));

    /// <summary>A kinematic body of a convex shape, at rest. Adds the shape.</summary>
    public static BodyDescription CreateConvexKinematic<TShape>(RigidPose pose, Shapes shapes, TShape shape)
        where TShape : unmanaged, IConvexShape => CreateConvexKinematic(pose, default, shapes, shape);

    /// <summary>A speculative margin in proportion to a shape: a tenth of its smallest extent.</summary>
    public static float GetDefaultSpeculativeMargin<TShape>(in TShape shape) where TShape : unmanaged, IConvexShape
    {
        shape.ComputeBounds(Quaternion.Identity, out var min, out var max);
        var span = max - min;
        return 0.1f * MathHelper.Min(span.X, MathHelper.Min(span.Y, span.Z));
    }

    /// <summary>
    /// A sleep threshold in proportion to a shape, up to that of one whose radius is a metre: slower than a tenth of its radius per second, at most .1 m/s, and
    /// than as much in radians per second.
    /// </summary>
    // The threshold is of speeds in m/s and rad/s together. In proportion without an end a space station whose rim moves at 20 m/s would count as at rest, and
    // the load of a crane where it turns back.
    public static BodyActivityDescription GetDefaultActivity<TShape>(in TShape shape) where TShape : unmanaged, IConvexShape
    {
        shape.ComputeAngularExpansionData(out var maximumRadius, out _);
        var radius = MathHelper.Min(1, maximumRadius);
        return new(0.01f * radius * radius);
    }
}
