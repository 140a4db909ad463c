namespace BepuPhysics.CollisionDetection;

/// <summary>The part of a body B that is nearest to a convex body A, both at rest, of those that were looked at so far.</summary>
struct NearestPart(double maximum)
{
    readonly double maximum = maximum;

    /// <summary>Whether there is one.</summary>
    public bool Exists;
    /// <summary>How near it is; nothing where there is none.</summary>
    public ShapeDistance Found;
    /// <summary>Number of the part; of several that are equally near the lowest, so that no order of tests shows.</summary>
    public int Child;

    /// <summary>What is farther away is of no interest, m.</summary>
    public readonly double Maximum => Exists ? Found.Distance : maximum;

    /// <summary>Looks at a part.</summary>
    /// <param name="motion">Where the bodies are.</param>
    /// <param name="a">Body A.</param>
    /// <param name="core">The part.</param>
    /// <param name="local">Pose of the part in B.</param>
    /// <param name="child">Its number.</param>
    public void Test(in SweepMotion motion, ref ImpactBody a, in ImpactCore core, in RigidPose local, int child)
    {
        var b = new ImpactBody(core, local, motion.OrientationB, default);
        if (!core.IsPlane)
        {
            var between = (motion.OffsetB + b.BallCenter - a.BallCenter).Length - a.BallRadius - b.BallRadius;
            if (between > Maximum)
                return;
        }
        if (!ImpactPair.FindDistance(ref a, ref b, motion.OffsetB, Maximum, out var found))
            return;
        if (Exists && found.Distance == Found.Distance && child > Child)
            return;
        Exists = true;
        Found = found;
        Child = child;
    }

    /// <summary>Takes it that A is inside of B, which is solid.</summary>
    public void Overlap()
    {
        Exists = true;
        Found = new() { Overlaps = true };
        Child = 0;
    }
}
