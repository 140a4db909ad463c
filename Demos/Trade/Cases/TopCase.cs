using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.References;
using Demos.Running;

namespace Demos.Trade.Cases;

/// <summary>A disc on an arm, held in a point and spun: where its axis points, against Euler's equations.</summary>
sealed class TopCase : TradeCase
{
    const int Steps = 600;
    const float Radius = .5f, Thickness = .1f, Arm = .5f, Spin = 200, TiltDegrees = 30;

    static readonly Lazy<Double3[]> trueAxes = new(IntegrateAxes);

    readonly BodyHandle disc;
    double angleSum;

    public TopCase(AccuracySettings settings) : base(settings with { Contacts = ContactScope.None })
    {
        (float sine, float cosine) = MathF.SinCos(TiltDegrees / 2 * MathF.PI / 180);
        var tilt = new Quaternion(sine, 0, 0, cosine);
        Vector3 axis = SceneMath.Rotate(Vector3.UnitY, tilt);
        disc = World.AddDynamic(
            new Cylinder(Radius, Thickness), 1, new RigidPose(axis * Arm, tilt), new BodyVelocity(Vector3.Zero, axis * Spin));
        World.Simulation.Solver.Add(World.AddAnchor(Vector3.Zero), disc, new BallSocket
        {
            LocalOffsetB = new Vector3(0, -Arm, 0),
            SpringSettings = World.Settings.Spring,
        });
    }

    public override int StepCount => Steps;

    public override double Error => angleSum / Steps;

    public override void Observe(int step)
    {
        Double3 axis = World.Orientation(disc).Rotate(new Double3(0, 1, 0)), truth = trueAxes.Value[step];
        angleSum += Math.Atan2(Double3.Cross(axis, truth).Length, Double3.Dot(axis, truth));
    }

    static Double3[] IntegrateAxes()
    {
        var top = HeavyTop.OfDisc(Radius, Thickness, 1, Arm, Spin, TiltDegrees * Math.PI / 180, 9.81f);
        var axes = new Double3[Steps];
        for (int i = 0; i < Steps; ++i)
        {
            top.Advance(1 / 60.0, 1 / 12000.0);
            axes[i] = top.Axis;
        }
        return axes;
    }
}
