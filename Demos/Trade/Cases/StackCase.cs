using Demos.Accuracy;

namespace Demos.Trade.Cases;

/// <summary>Cubes exactly on top of one another: they stay where they are.</summary>
class StackCase : TradeCase
{
    readonly Stack stack;

    public StackCase(AccuracySettings settings) : this(settings, 30)
    {
    }

    protected StackCase(AccuracySettings settings, int count) : base(settings)
    {
        World.AddGround();
        stack = Stack.OfEqual(World, count);
    }

    public override int StepCount => 600;

    /// <summary>More than the size of a cube is a stack that fell.</summary>
    public override double Error => OrBroken(stack.Loss + stack.Drift, 1);
}
