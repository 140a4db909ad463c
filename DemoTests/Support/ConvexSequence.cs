using System;
using Demos.References;

namespace DemoTests.Support;

/// <summary>Two shapes that move and turn slowly against each other, frame by frame, with the reference of each frame.</summary>
public static class ConvexSequence
{
    public const int FrameCount = 150;

    /// <summary>Starts in a regime and goes on at steady velocities.</summary>
    /// <param name="a">Shape that stays.</param>
    /// <param name="b">Shape that moves.</param>
    /// <param name="start">How the pair lies at first.</param>
    /// <param name="random">Source of pose and velocities.</param>
    /// <param name="step">Largest movement per frame, relative to the smaller size.</param>
    /// <param name="turn">Largest turn per frame, radians.</param>
    public static ConvexCase[] Create(ConvexShape a, ConvexShape b, ConvexRegime start, ConvexRandom random, double step = 3e-4,
        double turn = 5e-4)
    {
        var first = ConvexPoses.Create(a, b, start, random);
        var velocity = random.NextDirection() * (step * first.Reference.Size * random.Next());
        var axis = random.NextDirection();
        var rate = turn * random.Next();
        var frames = new ConvexCase[FrameCount];
        frames[0] = first;
        // B turns around its middle, wherever the origin of its frame is.
        var startB = (DoubleQuaternion)first.Pose.OrientationB;
        var middle = (Double3)first.Pose.OffsetB + startB.Rotate(b.Middle);
        for (int i = 1; i < FrameCount; ++i)
        {
            var orientation = DoubleQuaternion.Normalize(DoubleQuaternion.FromAxisAngle(axis, rate * i) * startB);
            var offset = middle + velocity * i - orientation.Rotate(b.Middle);
            frames[i] = ConvexPoses.Measure(a, b, new(ConvexGenerator.ToVector(offset), first.Pose.OrientationA,
                new((float)orientation.X, (float)orientation.Y, (float)orientation.Z, (float)orientation.W)));
        }
        return frames;
    }
}

/// <summary>Counts how often normals and depths jump, beside how often the reference's own do.</summary>
/// <remarks>Add the frames of one sequence in order, and <see cref="Restart"/> before the next.</remarks>
public sealed class ConvexSequenceTally
{
    const double FlipDegrees = 20;
    const double SuboptimalExcess = 0.01;

    Double3? lastNormal;
    Double3? lastReference;
    double lastDepth;
    double lastReferenceDepth;

    public int FrameCount { get; private set; }

    /// <summary>Normals that turned by more than 20 degrees from one frame to the next.</summary>
    public int FlipCount { get; private set; }

    /// <summary>As often did the reference's best normal.</summary>
    public int ReferenceFlipCount { get; private set; }

    /// <summary>Frames in which the depth changed by a hundredth of the smaller size more than that of the reference.</summary>
    public int JumpCount { get; private set; }

    /// <summary>Frames with a normal whose depth is a hundredth of the smaller size above the least.</summary>
    public int SuboptimalCount { get; private set; }

    /// <summary>Frames that overlap without a contact.</summary>
    public int MissedCount { get; private set; }

    public void Restart() => (lastNormal, lastReference) = (null, null);

    /// <param name="frame">Pose and reference.</param>
    /// <param name="normal">Normal from B to A in the world that was found; null without a contact.</param>
    /// <param name="depth">Deepest contact.</param>
    public void Add(in ConvexCase frame, Double3? normal, double depth)
    {
        ++FrameCount;
        var size = frame.Reference.Size;
        if (lastReference is { } reference)
            ReferenceFlipCount += Turned(reference, frame.Depth.Normal) ? 1 : 0;
        lastReference = frame.Depth.Normal;
        if (normal is not { } found)
        {
            MissedCount += frame.Depth.Depth > 1e-3 * size ? 1 : 0;
            lastNormal = null;
            return;
        }
        found = ConvexRotation.From(frame.Pose.OrientationA).RotateBack(found);
        SuboptimalCount += frame.Reference.DepthAlong(found, frame.LocalOffsetB) - frame.Depth.Depth > SuboptimalExcess * size ? 1 : 0;
        if (lastNormal is { } last)
        {
            FlipCount += Turned(last, found) ? 1 : 0;
            var change = Math.Abs(depth - lastDepth) - Math.Abs(frame.Depth.Depth - lastReferenceDepth);
            JumpCount += change > 0.01 * size ? 1 : 0;
        }
        (lastNormal, lastDepth, lastReferenceDepth) = (found, depth, frame.Depth.Depth);
    }

    public const string Columns = "frames | flips | of the reference | jumps | suboptimal | missed |";

    public string ToRow() => $"{FrameCount} | {FlipCount} | {ReferenceFlipCount} | {JumpCount} | {SuboptimalCount} | {MissedCount} |";

    public override string ToString() => $"{FrameCount} frames: {FlipCount} flips, reference {ReferenceFlipCount}; {JumpCount} jumps, "
        + $"{SuboptimalCount} suboptimal, {MissedCount} missed";

    static bool Turned(Double3 a, Double3 b) => Math.Atan2(Double3.Cross(a, b).Length, Double3.Dot(a, b)) > FlipDegrees * Math.PI / 180;
}
