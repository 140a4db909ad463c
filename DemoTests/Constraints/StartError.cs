using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Constraints;
using DemoTests.Scenes;

namespace DemoTests.Constraints;

/// <summary>What a joint of a tree is off by where the tree begins: what was left when its body was put in place, and what poses are rounded by.</summary>
/// <param name="Child">The body that hangs in it.</param>
/// <param name="Parents">The other bodies.</param>
/// <param name="Linear">Along directions, m.</param>
/// <param name="Angular">About axes, rad.</param>
readonly record struct StartError(BodyHandle Child, BodyHandle[] Parents, double Linear, double Angular)
{
    // Of an orientation in single precision, rad.
    const double RoundedAngle = 1.0 / (1 << 23);

    public static StartError Of(RowBench bench, ConstraintRow[] rows, BodyHandle child, BodyHandle[] parents)
    {
        double linear = 0, angular = 0;
        for (int i = 0; i < rows.Length; ++i)
        {
            if (bench.Processor.IsLinear(i))
                linear += Math.Abs(rows[i].PositionError);
            else
                angular += Math.Abs(rows[i].PositionError);
        }
        for (int i = 0; i < bench.BodyCount; ++i)
        {
            var position = Vector3.Abs(bench.Poses[i].Position);
            linear += new Vector3(Rounding(position.X), Rounding(position.Y), Rounding(position.Z)).Length();
            angular += RoundedAngle;
        }
        return new(child, parents, linear, angular);
    }

    static float Rounding(float value) => MathF.BitIncrement(value) - value;

    /// <summary>Sum of masses times the heights, kg m, by which they are lifted at most where all joints are put right.</summary>
    // To put a joint right moves all that hangs from it, and turns it about a place that is no farther than the farthest of its bodies.
    public static double Lift(List<StartError> joints, TestWorld world, Dictionary<BodyHandle, float> masses)
    {
        double sum = 0;
        for (int i = 0; i < joints.Count; ++i)
        {
            var ends = joints[i].Parents.Append(joints[i].Child).Select(body => world.Bodies[body].Pose.Position).ToArray();
            var moved = new HashSet<BodyHandle>();
            foreach (var joint in joints.Skip(i).Where(joint => joint == joints[i] || joint.Parents.Any(moved.Contains)))
            {
                moved.Add(joint.Child);
                var arm = ends.Max(end => (world.Bodies[joint.Child].Pose.Position - end).Length());
                sum += masses[joint.Child] * (joints[i].Linear + joints[i].Angular * arm);
            }
        }
        return sum;
    }
}
