using Demos.Accuracy;

namespace Demos.Trade.Cases;

/// <summary>
/// A hanging chain of 100 links with a hundredfold mass at its end: rigid links do not stretch. The second half counts, when it has settled.
/// </summary>
sealed class ChainCase : TradeCase
{
    const int Links = 100;
    const float Load = 100;

    readonly LoadedChain chain;
    double stretchSum, worst;
    int samples;

    public ChainCase(AccuracySettings settings) : base(settings with { Contacts = ContactScope.None }) =>
        chain = new LoadedChain(World, ChainStart.HangingKicked, Links, Load);

    public override int StepCount => 600;

    public override double Error => stretchSum / samples;

    public override void Observe(int step)
    {
        if (step < StepCount / 2)
            return;
        chain.Gaps(out double stretch, ref worst);
        stretchSum += stretch;
        ++samples;
    }
}
