using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics.Constraints;

namespace Demos.Pages;

/// <summary>A way in which a body can move against the others of a joint.</summary>
/// <param name="Direction">Direction of the way, or axis of the turn; a unit vector.</param>
/// <param name="IsTurn">Whether it is a turn about the axis.</param>
/// <param name="Point">Point through which the axis goes, m.</param>
readonly record struct JointMotion(Vector3 Direction, bool IsTurn, Vector3 Point)
{
    const float Speed = 0.01f;
    const float Kept = 0.98f;

    static readonly (Vector3 Direction, string Name)[] axes = [(Vector3.UnitX, "x"), (Vector3.UnitY, "y"), (Vector3.UnitZ, "z")];

    /// <summary>The motion in words.</summary>
    public override string ToString()
    {
        var direction = Direction;
        return $"{(IsTurn ? "turn about" : "move along")} {axes.First(axis => axis.Direction == direction).Name}";
    }

    /// <summary>The motions along and about the axes of the world that a picture shows, found by trying them in a step.</summary>
    /// <param name="facts">Type of the joint.</param>
    /// <param name="point">Where the joint holds the body that moves, m.</param>
    /// <returns>Those that a joint which always holds leaves free; of limits, servos and motors, those that they act on.</returns>
    public static List<JointMotion> Find(JointFacts facts, Vector3 point)
    {
        var isAsked = facts.Kind == RowKind.Equality;
        List<JointMotion> motions = [];
        var moving = MovingBody(facts);
        foreach (var isTurn in new[] { false, true })
        {
            motions.AddRange(axes.Select(axis => new JointMotion(axis.Direction, isTurn, isTurn ? point : JointStage.Places[moving]))
                .Where(motion => motion.IsFree(facts) == isAsked));
        }
        return motions;
    }

    /// <summary>The body whose motions are shown: the second, where there is one.</summary>
    public static int MovingBody(JointFacts facts) => Math.Min(1, facts.BodyCount - 1);

    // Limits are free one way and not the other.
    bool IsFree(JointFacts facts) => IsKept(facts, Speed) && IsKept(facts, -Speed);

    // Whether a body that starts so is still moving so after a step. What motors add is there without it too.
    bool IsKept(JointFacts facts, float speed)
    {
        var angular = IsTurn ? Direction * speed : default;
        var linear = IsTurn ? Vector3.Cross(angular, JointStage.Places[MovingBody(facts)] - Point) : Direction * speed;
        var (restLinear, restAngular) = Step(facts, default, default);
        var (movedLinear, movedAngular) = Step(facts, linear, angular);
        return Vector3.Distance(movedLinear - restLinear, linear) <= (1 - Kept) * Speed &&
            Vector3.Distance(movedAngular - restAngular, angular) <= (1 - Kept) * Speed;
    }

    static (Vector3 Linear, Vector3 Angular) Step(JointFacts facts, Vector3 linear, Vector3 angular)
    {
        var moving = MovingBody(facts);
        using JointStage stage = new(facts, moving);
        var body = stage.Simulation.Bodies[stage.Bodies[moving]];
        body.Velocity.Linear = linear;
        body.Velocity.Angular = angular;
        stage.Simulation.Timestep(1 / 240f);
        return (body.Velocity.Linear, body.Velocity.Angular);
    }
}
