using System;
using BepuUtilities.Memory;

namespace BepuPhysics.Constraints;

/// <summary>Which joints of a structure move which of its dynamic bodies, both counted from zero.</summary>
readonly struct JointGraph
{
    readonly Buffer<int> bodyStarts;
    readonly Buffer<int> bodiesOfJoints;
    readonly Buffer<int> jointStarts;
    readonly Buffer<int> jointsOfBodies;

    /// <summary>Number of joints.</summary>
    internal readonly int JointCount;
    /// <summary>Number of bodies.</summary>
    internal readonly int BodyCount;

    /// <summary>Arranges a structure.</summary>
    /// <param name="jointCount">Number of joints.</param>
    /// <param name="bodyCount">Number of bodies.</param>
    /// <param name="bodyStarts">Where the bodies of each joint begin; one more than there are joints.</param>
    /// <param name="bodiesOfJoints">The bodies of the joints.</param>
    /// <param name="pool">Memory.</param>
    internal JointGraph(int jointCount, int bodyCount, Buffer<int> bodyStarts, Buffer<int> bodiesOfJoints, BufferPool pool)
    {
        JointCount = jointCount;
        BodyCount = bodyCount;
        this.bodyStarts = bodyStarts;
        this.bodiesOfJoints = bodiesOfJoints;
        var incidences = bodyStarts[jointCount];
        pool.Take(bodyCount + 2, out jointStarts);
        pool.Take(Math.Max(1, incidences), out jointsOfBodies);
        jointStarts.Clear(0, bodyCount + 2);
        // Counted two places further on, so that filling leaves starts behind.
        for (int i = 0; i < incidences; ++i)
            ++jointStarts[bodiesOfJoints[i] + 2];
        for (int i = 2; i < bodyCount + 2; ++i)
            jointStarts[i] += jointStarts[i - 1];
        for (int joint = 0; joint < jointCount; ++joint)
        {
            foreach (var body in BodiesOf(joint))
                jointsOfBodies[jointStarts[body + 1]++] = joint;
        }
    }

    /// <summary>Dynamic bodies of a joint.</summary>
    internal unsafe ReadOnlySpan<int> BodiesOf(int joint) => new(bodiesOfJoints.Memory + bodyStarts[joint], bodyStarts[joint + 1] - bodyStarts[joint]);

    /// <summary>Joints of a dynamic body, in their order.</summary>
    internal unsafe ReadOnlySpan<int> JointsOf(int body) => new(jointsOfBodies.Memory + jointStarts[body], jointStarts[body + 1] - jointStarts[body]);

    /// <summary>Whether the structure has loops; the ground counts as one body.</summary>
    /// <param name="joints">The joints.</param>
    /// <param name="withBounds">Whether limits, servos and motors count.</param>
    /// <param name="pool">Memory for the time being.</param>
    // A joint closes a loop if two of its bodies hang together by those before it. Two joints between the same two bodies are a loop as well: they may say
    // nearly the same, and hard rows would take what they are off by for speed.
    internal bool HasLoops(ReadOnlySpan<DirectNode> joints, bool withBounds, BufferPool pool)
    {
        pool.Take<int>(BodyCount + 1, out var parts);
        DisjointSets.Begin(parts, BodyCount + 1);
        var hasLoop = false;
        for (int joint = 0; joint < JointCount && !hasLoop; ++joint)
        {
            if (joints[joint].HasBounds && !withBounds)
                continue;
            var ofJoint = BodiesOf(joint);
            var root = DisjointSets.Root(parts, ofJoint.Length == 1 ? BodyCount : ofJoint[0]);
            foreach (var body in ofJoint.Length == 1 ? ofJoint : ofJoint[1..])
            {
                var other = DisjointSets.Root(parts, body);
                hasLoop |= root == other;
                root = root == other ? root : DisjointSets.Join(parts, root, other);
            }
        }
        pool.Return(ref parts);
        return hasLoop;
    }

    internal void Dispose(BufferPool pool)
    {
        var (starts, joints) = (jointStarts, jointsOfBodies);
        pool.Return(ref starts);
        pool.Return(ref joints);
    }
}
