using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;

namespace Demos.Trade.Cases;

/// <summary>
/// Spheres that fall from many heights and bounce without loss come back to where they were. Many, since the height that one reaches depends
/// on where in a step it meets the ground.
/// </summary>
sealed class BounceCase : TradeCase
{
    const int Count = 16;
    const float Radius = .25f;

    readonly BodyHandle[] spheres = new BodyHandle[Count];
    readonly double[] before = new double[Count], beforeThat = new double[Count], reached = new double[Count];
    readonly bool[] hasLanded = new bool[Count];

    public BounceCase(AccuracySettings settings) : base(settings with { Restitution = 1, MaximumRecoveryVelocity = float.MaxValue })
    {
        World.AddGround();
        for (int i = 0; i < Count; ++i)
        {
            spheres[i] = World.AddDynamic(new Sphere(Radius), 1, new RigidPose(new Vector3((i - Count / 2) * 2, (float)Height(i) + Radius, 0)));
            before[i] = beforeThat[i] = Height(i);
        }
    }

    /// <summary>Until the highest, which is up again after 1.43 s, has surely turned.</summary>
    public override int StepCount => 120;

    public override double Error
    {
        get
        {
            double sum = 0;
            for (int i = 0; i < Count; ++i)
                sum += Math.Abs(reached[i] / Height(i) - 1);
            return sum / Count;
        }
    }

    /// <summary>Finds the peak of the first bounce from the parabola through three steps.</summary>
    public override void Observe(int step)
    {
        for (int i = 0; i < Count; ++i)
        {
            double height = World.Position(spheres[i]).Y - Radius, rise = height - before[i], riseBefore = before[i] - beforeThat[i];
            hasLanded[i] |= rise > 0;
            if (hasLanded[i] && reached[i] == 0 && rise <= 0 && riseBefore > 0)
                reached[i] = before[i] + (rise + riseBefore) * (rise + riseBefore) / (8 * (riseBefore - rise));
            (beforeThat[i], before[i]) = (before[i], height);
        }
    }

    static double Height(int i) => 1 + .1 * i;
}
