using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.Running;

namespace Demos.Trade.Cases;

/// <summary>Ragdolls that fall in a heap: their joints have no gap.</summary>
sealed class RagdollCase : TradeCase
{
    const int Columns = 6, Layers = 5;
    const float Radius = .06f, BodyDensity = 1000;

    /// <summary>Between the ends of two limbs at a joint: within the limit of its swing they never touch.</summary>
    const float Clearance = .02f;

    /// <summary>Cosine of the greatest swing.</summary>
    const float LeastDot = .75f;

    readonly JointGaps gaps;

    public RagdollCase(AccuracySettings settings) : base(settings)
    {
        gaps = new JointGaps(World);
        World.AddGround();
        for (int i = 0; i < Columns * Layers; ++i)
        {
            int column = i % Columns, layer = i / Columns;
            AddRagdoll(new Vector3((column % 3 - 1) * 1.5f + .3f * layer, .8f + layer * .5f, (column / 3 - .5f) * 2 + .2f * layer));
        }
    }

    public override int StepCount => 300;

    public override double Error => gaps.Mean;

    public override void Observe(int step) => gaps.Observe();

    /// <summary>Face down, its spine along z: two parts of the trunk, a head, and four limbs of two parts.</summary>
    void AddRagdoll(Vector3 hip)
    {
        var spine = Vector3.UnitZ;
        BodyHandle pelvis = AddLimb(hip, spine, .18f, .1f), chest = AddLimb(hip + spine * .4f, spine, .18f, .1f);
        Join(pelvis, chest, hip + spine * .2f, spine);
        Vector3 neck = hip + spine * .6f;
        Join(chest, AddLimb(neck + spine * .09f, spine, .04f, Radius), neck, spine);
        for (int side = -1; side <= 1; side += 2)
        {
            var aside = new Vector3(side, 0, 0);
            AddPair(chest, hip + spine * .45f + aside * .14f, aside, .14f);
            AddPair(pelvis, hip - spine * .24f + aside * .1f, -spine, .26f);
        }
    }

    void AddPair(BodyHandle trunk, Vector3 start, Vector3 along, float length)
    {
        float half = length / 2 + Radius + Clearance / 2;
        BodyHandle upper = AddLimb(start + along * half, along, length, Radius);
        BodyHandle lower = AddLimb(start + along * (3 * half), along, length, Radius);
        Join(trunk, upper, start, along);
        Join(upper, lower, start + along * (2 * half), along);
    }

    /// <param name="center">Where it is, m.</param>
    /// <param name="along">Direction of its local y.</param>
    /// <param name="length">Between the centres of its ends, m.</param>
    /// <param name="radius">Of the capsule, m.</param>
    BodyHandle AddLimb(Vector3 center, Vector3 along, float length, float radius)
    {
        float volume = System.MathF.PI * radius * radius * (length + radius * 4 / 3);
        return World.AddDynamic(new Capsule(radius, length), BodyDensity * volume, new RigidPose(center, SceneMath.Between(Vector3.UnitY, along)));
    }

    void Join(BodyHandle a, BodyHandle b, Vector3 point, Vector3 along)
    {
        Vector3 offsetA = ToLocal(a, point), offsetB = ToLocal(b, point);
        World.Simulation.Solver.Add(a, b, new BallSocket { LocalOffsetA = offsetA, LocalOffsetB = offsetB, SpringSettings = World.Settings.Spring });
        World.Simulation.Solver.Add(a, b, new SwingLimit
        {
            AxisLocalA = TurnedBack(a, along),
            AxisLocalB = TurnedBack(b, along),
            MinimumDot = LeastDot,
            SpringSettings = World.Settings.Spring,
        });
        gaps.Add(a, b, offsetA, offsetB);
    }

    Vector3 ToLocal(BodyHandle body, Vector3 point) => TurnedBack(body, point - World.Bodies[body].Pose.Position);

    Vector3 TurnedBack(BodyHandle body, Vector3 direction) =>
        SceneMath.Rotate(direction, Quaternion.Conjugate(World.Bodies[body].Pose.Orientation));
}
