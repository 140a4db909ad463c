using Demos.Accuracy;

namespace Demos.Trade.Cases;

/// <summary>A heavy cube on a light one: rigid cubes do not sink into each other.</summary>
sealed class HeavyCase : TradeCase
{
    readonly Stack stack;

    public HeavyCase(AccuracySettings settings) : base(settings)
    {
        World.AddGround();
        stack = new Stack(World, default, 1, 1, 1000);
    }

    public override int StepCount => 600;

    /// <summary>More than half of the light cube is one that was crushed.</summary>
    public override double Error => OrBroken(stack.Loss, .5);
}
