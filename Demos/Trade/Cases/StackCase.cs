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

    public override double Error => stack.Loss + stack.Drift;
}
