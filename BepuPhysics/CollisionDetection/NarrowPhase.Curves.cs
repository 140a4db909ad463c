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
    /// <param name="worker">Who notes what bends.</param>
    /// <param name="pair">What is round, and a static.</param>
    /// <param name="last">Its patch of the last step.</param>
    /// <param name="found">Its contacts as they were found.</param>
    /// <param name="led">Room for others.</param>
    // The surface turns by t in a step, in which the body goes by v dt: it bends up ahead where v . t < 0. The plane that the body touches at the part s of the
    // step has the normal n + s t, and is below it by -s^2 v . t dt / 2 now.
    [MethodImpl(MethodImplOptions.NoInlining)]
    ref readonly ConvexContactManifold LeadAlong(
        ref Worker worker, in CollidablePair pair, in PatchMemory last, in ConvexContactManifold found, ref ConvexContactManifold led)
    {
        var turn = found.Normal - last.Normal;
        var rise = -Exact.Dot(VelocityOf(pair.A).Linear, turn);
        // What bends away gives nothing.
        if (!(rise > 0))
            return ref found;
        var isSmooth = last.IsSmooth(Exact.LengthSquared(turn)) && found.GreatestDepth >= -0.5f * stepTime * rise;
        // What turns by more than what one patch may have of normals is an edge elsewhere.
        if (!isSmooth && Exact.Dot(found.Normal, last.Normal) < PatchSet.SameNormal)
            return ref found;
        if (!TryGetRollingRadius(pair.A, found.Normal, out var radius, out var isBall))
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
        // What touches with one end alone has another velocity there.
        if (isSmooth && (led.Count > 1 || isBall))
            Note(ref worker.Bends, new() { Pair = pair, Normal = led.Normal, Turn = turn, Depth = led.GreatestDepth }, worker.Pool);
        return ref led;
    }

    // A smooth surface that bends up below what rolls.
    struct Bend : INote
    {
        public CollidablePair Pair { get; init; }
        /// <summary>Normal of the plane that holds it in this step.</summary>
        public Vector3 Normal;
        /// <summary>By how much the normal has turned since the last step.</summary>
        public Vector3 Turn;
        /// <summary>Depth of the deepest contact with the plane, m.</summary>
        public float Depth;
    }

    // In the order of pairs, with velocities as they are when all have been noted.
    void NoteSmoothBends()
    {
        SmoothBends.Clear();
        order.Count = 0;
        for (int i = 0; i < workers.Length; ++i)
            Gather(ref workers[i].Bends, i);
        SortByKey();
        foreach (ref var note in order.AsSpan())
            AddSmoothBend(workers[note.Worker].Bends[note.Index]);
    }

    void AddSmoothBend(in Bend bend)
    {
        ref var location = ref Simulation.Bodies.Locations[bend.Pair.A.Slot];
        ref var set = ref Simulation.Bodies.SetOf(location);
        if (!(set.LocalInertias[location.Index].InverseMass > 0))
            return;
        var velocity = set.MotionStates[location.Index].Velocity.Linear;
        var turned = Exact.Dot(velocity, bend.Turn);
        // What hits it besides is stopped for good.
        var into = MathHelper.Max(Exact.Dot(velocity, bend.Normal), turned);
        if (!(into < 0) || !(bend.Depth >= into * stepTime))
            return;
        // What went away from the last plane, as it was pushed out, was no part of the way.
        var apart = into - turned;
        var across = into * into - apart * apart;
        if (across > 0)
        {
            var along = Exact.LengthSquared(velocity - bend.Normal * into);
            SmoothBends.Add(new() { Body = bend.Pair.A.BodyHandle, Normal = bend.Normal, Across = across, Along = along });
        }
    }

    // A cylinder that stands, or leans, has another place than that of its side.
    bool TryGetRollingRadius(CollidableReference body, in Vector3 normal, out float radius, out bool isBall)
    {
        Simulation.GetPoseAndShape(body, out var pose, out var shape);
        isBall = shape.Type == Sphere.Id;
        radius = shape.Type switch
        {
            Sphere.Id => Simulation.Shapes.GetShape<Sphere>(shape.Index).Radius,
            Capsule.Id => Simulation.Shapes.GetShape<Capsule>(shape.Index).Radius,
            _ => Simulation.Shapes.GetShape<Cylinder>(shape.Index).Radius,
        };
        return shape.Type != Cylinder.Id || MathF.Abs(Exact.Dot(Exact.Rotate(Vector3.UnitY, pose.Orientation), normal)) <= GreatestLean;
    }
}
