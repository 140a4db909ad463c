using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics.Constraints;
using BepuUtilities;
using Xunit;

namespace DemoTests.Constraints;

public class BallSocketTests : JointTests<BallSocket>
{
    private protected override BallSocket Describe(JointSamples samples, SpringSettings spring) =>
        new() { LocalOffsetA = samples.Vector(1), LocalOffsetB = samples.Vector(1), SpringSettings = spring };

    private protected override double[] Error(BallSocket d, DoublePose[] poses) =>
        (poses[0].Position + poses[0].ToWorld(d.LocalOffsetA) - poses[1].Position - poses[1].ToWorld(d.LocalOffsetB)).ToArray();

    private protected override void Settle(BallSocket d, SampleBody[] bodies) => Rotations.JoinAnchors(bodies, d.LocalOffsetA, d.LocalOffsetB);

    private protected override IEnumerable<(string, BallSocket, SampleBody[])> DegenerateCases(JointSamples samples)
    {
        yield return ("No arms", new(), NewBodies(samples));
    }
}

public class WeldTests : JointTests<Weld>
{
    private protected override Weld Describe(JointSamples samples, SpringSettings spring) =>
        new() { LocalOffset = samples.Vector(1), LocalOrientation = samples.Rotation(), SpringSettings = spring };

    private protected override double[] Error(Weld d, DoublePose[] poses)
    {
        var position = poses[0].Position + poses[0].ToWorld(d.LocalOffset) - poses[1].Position;
        var rotation = (poses[0].Orientation * DoubleRotation.From(d.LocalOrientation) * poses[1].Orientation.Inverse).Vector;
        return [.. position.ToArray(), .. rotation.ToArray()];
    }

    /// <summary>Where A is by far easier to turn, its centre is held at a point of B.</summary>
    private protected override double[] Error(Weld d, DoublePose[] poses, SampleBody[] bodies)
    {
        var error = Error(d, poses);
        if (Trace(bodies[0]) <= 3.7 * Trace(bodies[1]))
            return error;
        var frameOfA = poses[1].Orientation * DoubleRotation.From(d.LocalOrientation).Inverse;
        var position = poses[0].Position - poses[1].Position + frameOfA * new DoubleVector(d.LocalOffset);
        return [.. position.ToArray(), .. error[3..]];

        static double Trace(SampleBody body) => (double)body.InverseInertia.XX + body.InverseInertia.YY + body.InverseInertia.ZZ;
    }

    /// <summary>Its forces act at one place, whatever the gap, as long as that is none that has nothing to do with its arm.</summary>
    private protected override float GapThatKeepsMomentum => 0.1f;

    private protected override bool IsSmooth(Weld d, DoublePose[] poses) =>
        (poses[0].Orientation * DoubleRotation.From(d.LocalOrientation) * poses[1].Orientation.Inverse).Vector.Length < 3;

    private protected override void Settle(Weld d, SampleBody[] bodies)
    {
        bodies[1].Orientation = Exact.Concatenate(d.LocalOrientation, bodies[0].Orientation);
        Rotations.JoinAnchors(bodies, d.LocalOffset, default);
    }

    private protected override IEnumerable<(string, Weld, SampleBody[])> DegenerateCases(JointSamples samples)
    {
        var weld = new Weld { LocalOrientation = Quaternion.Identity };
        foreach (var axis in new Vector3[] { new(1, 0, 0), new(0, 1, 0), new(0, 0, 1), new(0, 0, -1), samples.Direction() })
        {
            var bodies = NewBodies(samples);
            bodies[0].Orientation = Quaternion.Identity;
            bodies[1].Orientation = new(axis, 0);
            yield return ($"Half a turn about {axis}", weld, bodies);
            bodies = NewBodies(samples);
            bodies[0].Orientation = Quaternion.Identity;
            bodies[1].Orientation = new(axis * 1e-30f, -1);
            yield return ($"No rotation, by the other quaternion, {axis}", weld, bodies);
        }
    }

    [Fact]
    public void HalfATurnIsSeenAsSuch()
    {
        var bodies = NewBodies(new(1));
        bodies[0].Orientation = Quaternion.Identity;
        bodies[1].Orientation = new(0, 1, 0, 0);
        var probe = JointProbes.New<Weld>();
        probe.Set(0, new() { LocalOrientation = Quaternion.Identity }, bodies);
        AssertClose([0, -Math.PI, 0], probe.PositionError(0)[3..], 1e-6);
    }

    /// <summary>Bodies that can turn about one axis only are held about this one; the others are not there to be held.</summary>
    [Fact]
    public void LockedAxesDoNotLoosenTheFreeOne()
    {
        var samples = new JointSamples(5);
        for (int trial = 0; trial < 50; ++trial)
        {
            var rotation = samples.Rotation();
            var bodies = NewBodies(samples);
            var weld = new Weld { LocalOrientation = Quaternion.Identity };
            foreach (ref var body in bodies.AsSpan())
            {
                body.Orientation = rotation;
                body.Position = default;
                body.InverseInertia = JointSamples.InWorld(new(0, 4, 0), rotation);
                body.Angular = Exact.Rotate(new(0, samples.Uniform(-3, 3), 0), rotation);
            }
            var probe = JointProbes.New<Weld>();
            probe.Set(0, weld, bodies);
            for (int i = 0; i < 60; ++i)
            {
                probe.WarmStart(new(0, 1 / 240f, 1, 1));
                probe.Solve(new(0, 1 / 240f, 1, 1));
            }
            AssertClose(new double[6], probe.RelativeVelocity(0), 1e-3);
        }
    }
}

public class HingeTests : JointTests<Hinge>
{
    private protected override Hinge Describe(JointSamples samples, SpringSettings spring) => new()
    {
        LocalOffsetA = samples.Vector(1),
        LocalHingeAxisA = samples.Direction(),
        LocalOffsetB = samples.Vector(1),
        LocalHingeAxisB = samples.Direction(),
        SpringSettings = spring,
    };

    private protected override double[] Error(Hinge d, DoublePose[] poses)
    {
        var position = poses[0].Position + poses[0].ToWorld(d.LocalOffsetA) - poses[1].Position - poses[1].ToWorld(d.LocalOffsetB);
        return [.. position.ToArray(), .. Rotations.TurnToAlign(poses, d.LocalHingeAxisA, d.LocalHingeAxisB)];
    }

    private protected override bool IsSmooth(Hinge d, DoublePose[] poses) =>
        DoubleVector.Dot(poses[0].ToWorld(d.LocalHingeAxisA), poses[1].ToWorld(d.LocalHingeAxisB)) > -0.99;

    private protected override void Settle(Hinge d, SampleBody[] bodies)
    {
        Rotations.Align(bodies, d.LocalHingeAxisA, d.LocalHingeAxisB);
        Rotations.JoinAnchors(bodies, d.LocalOffsetA, d.LocalOffsetB);
    }

    private protected override IEnumerable<(string, Hinge, SampleBody[])> DegenerateCases(JointSamples samples) =>
        Rotations.ParallelAxes(samples, NewBodies, (a, b) => new Hinge { LocalHingeAxisA = a, LocalHingeAxisB = b });

    [Fact]
    public void OppositeAxesAreHalfATurnApart()
    {
        var bodies = NewBodies(new(1));
        bodies[0].Orientation = bodies[1].Orientation = Quaternion.Identity;
        var probe = JointProbes.New<Hinge>();
        probe.Set(0, new() { LocalHingeAxisA = new(0, 0, 1), LocalHingeAxisB = new(0, 0, -1) }, bodies);
        AssertClose([Math.PI, 0], probe.PositionError(0)[3..], 1e-6);
    }
}

public class SwivelHingeTests : JointTests<SwivelHinge>
{
    private protected override SwivelHinge Describe(JointSamples samples, SpringSettings spring) => new()
    {
        LocalOffsetA = samples.Vector(1),
        LocalSwivelAxisA = samples.Direction(),
        LocalOffsetB = samples.Vector(1),
        LocalHingeAxisB = samples.Direction(),
        SpringSettings = spring,
    };

    private protected override double[] Error(SwivelHinge d, DoublePose[] poses)
    {
        var position = poses[0].Position + poses[0].ToWorld(d.LocalOffsetA) - poses[1].Position - poses[1].ToWorld(d.LocalOffsetB);
        return [.. position.ToArray(), Math.PI / 2 - Angle(d, poses)];
    }

    static double Angle(SwivelHinge d, DoublePose[] poses) =>
        DoubleVector.Angle(poses[0].ToWorld(d.LocalSwivelAxisA), poses[1].ToWorld(d.LocalHingeAxisB));

    private protected override bool IsSmooth(SwivelHinge d, DoublePose[] poses) => Angle(d, poses) is > 0.05 and < Math.PI - 0.05;

    private protected override void Settle(SwivelHinge d, SampleBody[] bodies) => Rotations.JoinAnchors(bodies, d.LocalOffsetA, d.LocalOffsetB);

    private protected override IEnumerable<(string, SwivelHinge, SampleBody[])> DegenerateCases(JointSamples samples) =>
        Rotations.ParallelAxes(samples, NewBodies, (a, b) => new SwivelHinge { LocalSwivelAxisA = a, LocalHingeAxisB = b });
}
