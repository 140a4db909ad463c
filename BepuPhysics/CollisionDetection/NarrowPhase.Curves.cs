using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Collidables;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

// What rolls along a curved surface is held by the plane that it touches a part of the step later. The solver keeps the plane of a contact
// for a step. With that of the beginning a ball in a bowl goes straight on into the wall and is lifted out of it in the next step, against its
// weight and for nothing: it gains the part g dt / r of its energy in a second, of whatever surface it follows with a radius r.
public sealed unsafe partial class NarrowPhase<TCallbacks>
{
    // Sine of the greatest angle between a surface and the axis of a cylinder that rolls on its side.
    const float GreatestLean = 1e-2f;

    static bool MayRoll(in TestedPair tested, TypedIndex shapeA) =>
        shapeA.Type is Sphere.Id or Capsule.Id or Cylinder.Id && !tested.IsImpact && tested.Pair.B.Mobility == CollidableMobility.Static;

    /// <summary>Turns the normal of what rolls by as much as the surface will have turned below it when the solver needs it in the mean.</summary>
    /// <param name="pair">What is round, and a static.</param>
    /// <param name="last">Normal of the contacts in the last step.</param>
    /// <param name="found">Its contacts as they were found.</param>
    /// <param name="led">Room for others.</param>
    // The surface turns by t in a step, in which the body goes by v dt: it bends up ahead where v . t < 0. The plane that the body touches at the part s of the
    // step has the normal n + s t, and is below it by -s^2 v . t dt / 2 now.
    [MethodImpl(MethodImplOptions.NoInlining)]
    ref readonly ConvexContactManifold LeadAlong(
        in CollidablePair pair, in Vector3 last, in ConvexContactManifold found, ref ConvexContactManifold led)
    {
        var turn = found.Normal - last;
        var rise = -Exact.Dot(VelocityOf(pair.A).Linear, turn);
        // What bends away gives nothing. What turns by more than what one patch may have of normals is an edge.
        if (!(rise > 0) || Exact.Dot(found.Normal, last) < PatchSet.SameNormal || !TryGetRollingRadius(pair.A, found.Normal, out var radius))
            return ref found;
        var share = rimTime / stepTime;
        var normal = found.Normal + turn * share;
        normal *= 1 / Exact.Length(normal);
        // What touches is round about the axis, or the middle.
        var shift = (found.Normal - normal) * radius;
        var below = share * share * 0.5f * stepTime * rise;
        led = found;
        led.Normal = normal;
        for (int i = 0; i < led.Count; ++i)
        {
            ConvexContactManifold.GetConvexContactReference(ref led, i).Offset += shift;
            led.AddDepth(i, -below);
        }
        return ref led;
    }

    // A cylinder that stands, or leans, has another place than that of its side.
    bool TryGetRollingRadius(CollidableReference body, in Vector3 normal, out float radius)
    {
        Simulation.GetPoseAndShape(body, out var pose, out var shape);
        radius = shape.Type switch
        {
            Sphere.Id => Simulation.Shapes.GetShape<Sphere>(shape.Index).Radius,
            Capsule.Id => Simulation.Shapes.GetShape<Capsule>(shape.Index).Radius,
            _ => Simulation.Shapes.GetShape<Cylinder>(shape.Index).Radius,
        };
        return shape.Type != Cylinder.Id || MathF.Abs(Exact.Dot(Exact.Rotate(Vector3.UnitY, pose.Orientation), normal)) <= GreatestLean;
    }
}
