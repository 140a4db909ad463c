using Demos.Accuracy;

namespace Demos.Trade.Cases;

/// <summary>A stack under steps of changing length.</summary>
sealed class StepLengthCase(AccuracySettings settings) : StackCase(settings, 10)
{
    public override int StepCount => 390;

    public override float StepDuration(int step) => StutteringSteps.Duration(step);
}
