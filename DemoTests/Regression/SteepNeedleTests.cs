using System.Numerics;
using DemoTests.CollisionDetection;
using DemoTests.Support;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// A coin at the edge of a needle that is a hundred times as large and steep to the normal. Contacts lie in the middle between both surfaces.
/// The height of the needle's was taken from its plane, a border beside it, and rose over all of the needle by a hundredth of the coin's size.
/// </summary>
public class SteepNeedleTests
{
    static readonly ConvexShape needle = ConvexShape.Triangle(
        new(-38.166775f, 54.624043f, -46.692104f), new(38.166775f, -54.624043f, 46.692104f), new(38.5801f, -53.7449f, 47.382732f));

    static readonly ConvexShape otherNeedle = ConvexShape.Triangle(
        new(69.52899f, -35.36593f, -60.658062f), new(-69.52899f, 35.36593f, 60.658062f), new(-70.06175f, 35.928436f, 59.71942f));

    static readonly ConvexShape coin = ConvexShape.Cylinder(.807466507f, 2 * .0325602777f);

    static readonly ConvexShape otherCoin = ConvexShape.Cylinder(.663037658f, 2 * .0111283055f);

    public static TheoryData<ConvexShape, ConvexShape, ConvexPose> Poses() => new()
    {
        {
            needle, coin, new(new(41.298054f, 5.8098493f, 65.034645f), new Quaternion(.26318786f, -.28327042f, .7526124f, .53297704f),
                new Quaternion(-.38747776f, .3435939f, -.8514795f, -.082382835f))
        },
        {
            needle, coin, new(new(-33.99757f, -14.284557f, -1.0368829f), new Quaternion(.34114403f, .8630603f, -.37001982f, -.042813607f),
                new Quaternion(.026212309f, .75782555f, -.08497078f, -.64636934f))
        },
        {
            otherNeedle, otherCoin, new(new(-14.065968f, -8.082298f, 2.9255972f), new Quaternion(.44438198f, .23351781f, -.57199407f, -.648704f),
                new Quaternion(.04818965f, -.13711043f, .8940866f, -.4236598f))
        },
    };

    [Theory]
    [MemberData(nameof(Poses))]
    public void Contacts_are_between_both_surfaces(ConvexShape a, ConvexShape b, ConvexPose pose)
    {
        using var library = new ConvexPairLibrary();
        var pair = ConvexPoses.Measure(a, b, pose);
        var margin = (float)(ConvexPoses.Margin * pair.Reference.Size);
        var manifold = library.Run([(library.Create(a), library.Create(b), pose, margin)])[0];
        var tally = new ConvexPairTally();
        tally.Add(pair, manifold, margin);
        Assert.NotEqual(0, manifold.Count);
        Assert.True(tally.OutsideCount == 0, tally.WorstOutsidePose);
    }
}
