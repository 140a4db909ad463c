using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

// What tells whether sweeps hold a joint (JointNeed.cs).
public readonly partial struct JointConstraint<TBodies, TPrestep, TGeometry, TRows, TMass, TJoint>
{
    // Below, squares of gaps are no numbers to divide by.
    const float LeastGapSquared = 1e-30f;

    static void IConstraint<TBodies, TPrestep, TRows>.RigidError(in TBodies bodies, in Substep substep, in TPrestep prestep, out JointErrorWide error)
    {
        ReadSeparation(bodies, prestep, out error.Linear, out error.Angular);
        // Areas and volumes are no lengths.
        error.RigidMask = Vector.Equals(TJoint.Spring(prestep).AngularFrequency, Vector<float>.Zero);
        error.Linear = MakesHubs ? Wide.Mask(error.RigidMask, error.Linear) : Vector<float>.Zero;
        error.Angular = Wide.Mask(error.RigidMask, error.Angular);
        ReadSlip(bodies, substep, prestep, out error.LinearSlipSquared, out error.AngularSlipSquared);
        error.LinearSlipSquared = MakesHubs ? Wide.Mask(error.RigidMask, error.LinearSlipSquared) : Vector<float>.Zero;
        error.AngularSlipSquared = Wide.Mask(error.RigidMask, error.AngularSlipSquared);
        ref var slots = ref Unsafe.AsRef(in bodies);
        ref var first = ref BodySlots.At(ref slots, 0);
        ref var last = ref BodySlots.At(ref slots, TBodies.Count - 1);
        error.TurnASquared = first.Angular.LengthSquared();
        error.TurnBSquared = last.Angular.LengthSquared();
        if (TJoint.HoldsPoints)
        {
            TJoint.Prepare(bodies, prestep, out var geometry);
            TJoint.PointLoad(geometry, default, out _, out var offsetA, out var offsetB);
            error.ArmASquared = offsetA.LengthSquared();
            error.ArmBSquared = offsetB.LengthSquared();
        }
        else
        {
            error.ArmASquared = error.ArmBSquared = (first.Position - last.Position).LengthSquared();
        }
    }

    // C and C' in the middle of the last substep: at its end J would have turned on from where v was solved for. What of C' is along C stores energy in the
    // joint's spring, or takes it out; what is across turns the gap, against what the spring damps.
    static void ReadSlip(in TBodies bodies, in Substep substep, in TPrestep prestep, out Vector<float> linear, out Vector<float> angular)
    {
        linear = angular = Vector<float>.Zero;
        if (TJoint.Kind != RowKind.Equality)
            return;
        var before = bodies;
        for (int slot = 0; slot < TBodies.Count; ++slot)
            MoveBack(ref BodySlots.At(ref before, slot), new Vector<float>(0.5f * substep.Dt));
        TJoint.Prepare(before, prestep, out var geometry);
        TJoint.PositionError(before, prestep, geometry, out var error);
        TJoint.LeanRows(before, prestep, ref geometry);
        TJoint.RelativeVelocity(geometry, before, out var velocity);
        Vector<float> linearGap = Vector<float>.Zero, linearAlong = Vector<float>.Zero;
        Vector<float> angularGap = Vector<float>.Zero, angularAlong = Vector<float>.Zero;
        for (int i = 0; i < RowCount; ++i)
        {
            var (gap, speed) = (Row(ref error, i), Row(ref velocity, i));
            if (TJoint.IsLinear(i))
            {
                linearGap += gap * gap;
                linearAlong += gap * speed;
                linear += speed * speed;
            }
            else
            {
                angularGap += gap * gap;
                angularAlong += gap * speed;
                angular += speed * speed;
            }
        }
        linear = Across(linear, linearAlong, linearGap);
        angular = Across(angular, angularAlong, angularGap);
    }

    // Without a gap there is nothing to turn.
    static Vector<float> Across(Vector<float> speedSquared, Vector<float> along, Vector<float> gapSquared)
    {
        var across = speedSquared - along * along / Wide.Max(gapSquared, new Vector<float>(LeastGapSquared));
        return Wide.Mask(Vector.GreaterThan(gapSquared, new Vector<float>(LeastGapSquared)), Wide.Max(across, Vector<float>.Zero));
    }

    static void MoveBack(ref SolverBodyWide body, Vector<float> time)
    {
        body.Position -= body.Linear * time;
        var half = body.Angular * (time * new Vector<float>(-0.5f));
        var back = new QuaternionWide(half.X, half.Y, half.Z, Vector<float>.One);
        body.Orientation = QuaternionWide.Normalize(QuaternionWide.Concatenate(body.Orientation, back));
    }
}
