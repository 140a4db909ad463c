using System;
using System.Linq;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using DemoTests.Support;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>
/// Slivers that barely touch something much larger or smaller. Rounding is then as much as what tells axes and corners apart, and still no
/// contact may be anywhere but between both surfaces.
/// </summary>
public class OutsideContactTests
{
    const float Depth = 0.01f;

    // Along many axes these are as deep: the one that is chosen belongs to edges, or to a face, that are not where the triangles touch; or the
    // edges are nearly parallel, and cross beyond their ends.
    static readonly (ConvexShape A, ConvexShape B, ConvexPose Pose)[] triangles =
    [
        (ConvexShape.Triangle(new(-0.19487372f, -0.02604647f, -0.98048246f), new(0.19487372f, 0.02604647f, 0.98048246f),
                new(0.16099313f, 0.031716388f, 0.9870657f)),
            ConvexShape.Triangle(new(-20.614843f, 13.211965f, 6.484843f), new(20.614843f, -13.211965f, -6.484843f),
                new(20.553003f, -13.420474f, -6.2566156f)),
            new(new(6.5226307f, -17.660677f, -17.223433f), new(0.60916704f, -0.15153612f, -0.7541065f, 0.19306919f),
                new(-0.050752584f, -0.5848012f, 0.72237986f, 0.365512f))),
        (ConvexShape.Triangle(new(0.25878578f, 0.43005908f, -0.86491567f), new(-0.25878578f, -0.43005908f, 0.86491567f),
                new(-0.093744524f, -0.17373453f, 0.3489404f)),
            ConvexShape.Triangle(new(-42.91725f, -0.97454387f, -29.73542f), new(-30.91607f, 8.882305f, 43.018837f), new(-32.32029f, 7.1030006f, 33.247692f)),
            new(new(-31.732065f, 38.963787f, -17.2787f), new(0.79590386f, -0.529454f, -0.15727231f, 0.2479535f),
                new(-0.50224626f, -0.5405018f, -0.22665773f, -0.6357931f))),
        (ConvexShape.Triangle(new(-8.925149f, 0.97000986f, 1.5734382f), new(0.79431367f, 9.927783f, -8.094275f), new(0.71856916f, 9.816884f, -8.27318f)),
            ConvexShape.Triangle(new(-0.9790237f, 0.19974808f, -0.04016643f), new(0.37686095f, -0.076890126f, 0.015461485f),
                new(0.07817309f, 0.27686775f, -0.5285385f)),
            new(new(-1.8134266f, 10.507391f, -7.19742f), new(0.040004995f, -0.2321134f, 0.2844516f, 0.9293063f),
                new(0.55475736f, -0.08167141f, -0.7475337f, 0.35604423f))),
        (ConvexShape.Triangle(new(-0.8716225f, -0.15598814f, -0.50057286f), new(0.8331697f, 0.05241454f, 0.5242451f),
                new(0.1618481f, -0.03830113f, 0.14318185f)),
            ConvexShape.Triangle(new(84.465416f, -4.0721254f, -18.286861f), new(-46.795734f, 2.256049f, 10.131331f),
                new(-12.136051f, -59.449978f, -42.817017f)),
            new(new(-24.169287f, 31.99278f, 4.725457f), new(-0.4080173f, 0.28096744f, -0.6384137f, -0.58907306f),
                new(0.16543661f, 0.5648941f, -0.60848445f, -0.5322331f))),
        (ConvexShape.Triangle(new(-0.9327926f, 5.2624516f, 6.9270267f), new(0.420497f, -2.37228f, -3.1226597f), new(3.5053616f, 3.1378787f, -1.9118099f)),
            ConvexShape.Triangle(new(-0.6382184f, -0.07480089f, -0.7662128f), new(0.27118745f, 0.03178389f, 0.32557398f),
                new(-0.28768113f, 0.7987817f, 0.16164415f)),
            new(new(0.35947797f, -0.3496897f, -5.255866f), new(-0.5692913f, 0.07863093f, 0.5373188f, 0.61726254f),
                new(0.12403073f, 0.76348966f, 0.2178372f, -0.59518635f))),
        (ConvexShape.Triangle(new(-0.5401214f, 0.399208f, -0.7408791f), new(0.5401214f, -0.399208f, 0.7408791f), new(0.5257029f, -0.41018292f, 0.74547696f)),
            ConvexShape.Triangle(new(-36.23718f, 34.947826f, 33.654472f), new(36.23718f, -34.947826f, -33.654472f), new(36.859135f, -34.77406f, -33.165234f)),
            new(new(-34.27112f, -16.914593f, 20.410799f), new(-0.58265555f, 0.4071667f, -0.688068f, -0.14591195f),
                new(0.63858885f, -0.122353785f, 0.05508743f, 0.75775933f))),
        (ConvexShape.Triangle(new(-194.09778f, 49.572227f, 117.173325f), new(-26.287374f, -177.65506f, 14.044605f), new(-61.034668f, -130.99583f, 33.45078f)),
            ConvexShape.Triangle(new(0.16594657f, 0.1333572f, 0.97707605f), new(-0.16594657f, -0.1333572f, -0.97707605f),
                new(-0.016089492f, -0.035520572f, -0.24465829f)),
            new(new(118.02917f, -80.7902f, 11.533193f), new(0.15177356f, -0.24240948f, 0.6883488f, 0.66661704f),
                new(-0.48845494f, -0.44072005f, 0.753036f, -0.010694766f))),
    ];

    // A long cylinder across the tip of a sliver: what the far end of the cylinder is rounded to is a hundred times as much along the sliver.
    static readonly (ConvexShape A, ConvexShape B, ConvexPose Pose)[] cylinders =
    [
        (ConvexShape.Triangle(new(-0.6805266f, 0.62585974f, -0.38102892f), new(0.6805266f, -0.62585974f, 0.38102892f),
                new(-0.16046482f, 0.14184216f, -0.102494024f)),
            ConvexShape.Cylinder(1.6785548f, 330.18097f),
            new(new(3.9263475f, 3.9342587f, -4.4159765f), new(0.5413411f, -0.7282287f, 0.22979422f, 0.35189122f),
                new(-0.6277942f, -0.18123566f, -0.65627646f, -0.37726554f))),
        (ConvexShape.Triangle(new(0.26197976f, 0.1279704f, -0.8038528f), new(-1.38249f, -0.27109334f, 0.26219934f),
                new(-1.3736213f, -0.2760101f, 0.27403954f)),
            ConvexShape.Cylinder(1.4744148f, 279.4477f),
            new(new(0.74549794f, -0.3898464f, 2.33767f), new(-0.0879262f, -0.29302928f, -0.93268657f, 0.19104598f),
                new(-0.5914899f, 0.7131494f, -0.28951725f, 0.24028601f))),
        (ConvexShape.Triangle(new(-0.3476531f, 0.4805224f, 0.121782094f), new(1.0311236f, -0.927586f, -0.21910717f),
                new(-0.17109677f, 0.31612897f, 0.07580804f)),
            ConvexShape.Cylinder(5.858632f, 302.98694f),
            new(new(-70.8312f, -19.21843f, 60.576317f), new(0.65340704f, 0.49921575f, -0.530461f, -0.20604365f),
                new(0.6038795f, 0.6559476f, -0.042855307f, -0.45080554f))),
        (ConvexShape.Triangle(new(0.88872105f, 0.4552659f, 0.053924102f), new(-0.88872105f, -0.4552659f, -0.053924102f),
                new(-0.8829515f, -0.46582732f, -0.059845116f)),
            ConvexShape.Cylinder(2.1446688f, 297.651f),
            new(new(-2.6696377f, 0.89288753f, 1.2424163f), new(0.0444881f, -0.35661724f, -0.75081724f, -0.55418265f),
                new(-0.42668998f, 0.20938101f, -0.82236755f, -0.31274092f))),
        (ConvexShape.Triangle(new(0.59509623f, 0.8014627f, -0.05931271f), new(-0.59509623f, -0.8014627f, 0.05931271f),
                new(-0.60581505f, -0.79306585f, 0.065231055f)),
            ConvexShape.Cylinder(28.269716f, 34.609856f),
            new(new(-21.482603f, 10.955488f, -15.863507f), new(-0.47600615f, -0.15819946f, 0.12366532f, 0.8562114f),
                new(-0.75253695f, -0.2268722f, -0.008941516f, 0.6181724f))),
        // Newton steps throughout would run in circles here: the search stopped beside the nearest points, a thousandth of the size off.
        (ConvexShape.Triangle(new(0.5356998f, -0.73686105f, -0.037811495f), new(0.7657982f, 0.04375459f, 1.9237988f),
                new(0.6904687f, -0.24484706f, 1.235121f)),
            ConvexShape.Cylinder(0.757827818f, 2 * 0.158781633f),
            new(new(0.8523106f, -1.3133869f, 0.39510924f), new(-0.6274276f, 0.6175148f, -0.20687637f, 0.42686328f),
                new(0.60326785f, -0.67935836f, 0.32719275f, -0.25977883f))),
        (ConvexShape.Box(2 * 0.30445534f, 2 * 0.28478613f, 2 * 0.6f),
            ConvexShape.Cylinder(0.818402708f, 2 * 0.0146210184f),
            new(new(0.78317565f, -0.59330094f, -0.52268493f), new(-0.5740082f, -0.18860927f, 0.79040486f, -0.101001605f),
                new(-0.3896132f, 0.865003f, -0.17412332f, 0.2639176f))),
    ];

    public static TheoryData<ConvexKind, int> Poses()
    {
        var data = new TheoryData<ConvexKind, int>();
        for (int i = 0; i < triangles.Length; ++i)
            data.Add(ConvexKind.Triangle, i);
        for (int i = 0; i < cylinders.Length; ++i)
            data.Add(ConvexKind.Cylinder, i);
        return data;
    }

    /// <summary>
    /// A contact is halfway between two points that are its depth apart, one of either surface, so from both it is at most half its depth away.
    /// </summary>
    [Theory]
    [MemberData(nameof(Poses))]
    public void Contacts_are_between_both_surfaces(ConvexKind other, int index)
    {
        var (a, b, pose) = (other == ConvexKind.Triangle ? triangles : cylinders)[index];
        using var library = new ConvexPairLibrary();
        var pair = ConvexPoses.Measure(a, b, pose);
        var size = pair.Reference.Size;
        var manifold = library.Run([(library.Create(a), library.Create(b), pose, (float)(ConvexPoses.Margin * size))])[0];
        Assert.NotEqual(0, manifold.Count);
        var tolerance = ConvexPairTally.Tolerance * size + 2e-6 * pair.Reference.LargerSize;
        var toA = ConvexRotation.From(pose.OrientationA);
        for (int i = 0; i < manifold.Count; ++i)
        {
            var place = toA.RotateBack(manifold[i].Offset);
            var farthest = tolerance + Math.Abs(manifold[i].Depth) * 0.5;
            Assert.InRange(a.SignedDistance(place), double.MinValue, farthest);
            Assert.InRange(b.SignedDistance(pair.Reference.Rotation.RotateBack(place - pair.LocalOffsetB)), double.MinValue, farthest);
        }
        Assert.InRange(Enumerable.Range(0, manifold.Count).Max(i => manifold[i].Depth) - pair.Depth.Depth, -tolerance, tolerance);
    }

    /// <summary>
    /// A bundle in which each kind of corners exists somewhere: of edges that start inside, of edges that end there, of B's vertices, and of
    /// segments of A's, of B's and of both. What one pair has says nothing of what the bundle has.
    /// </summary>
    [Fact]
    public void A_bundle_has_room_for_the_corners_of_all_its_pairs()
    {
        const double turned = Math.PI;
        // Triangles around the axis, and triangles on edge along X: A's bottom is at zero, B's top at the depth.
        var onA = new Triangle(new(-1, 0, 0), new(1, 0, 0), new(0, 5, 0)) { TwoSided = true };
        var onB = new Triangle(new(-1, Depth, 0), new(1, Depth, 0), new(0, -5, 0)) { TwoSided = true };
        double[] none = [];
        (Triangle A, Triangle B, double Radius, double[] X)[] pairs =
        [
            (Level(1, 0, 0), Level(10, 0, Depth), 1, none),
            (Level(10, 0, 0), Level(1, 0, Depth), 1, none),
            // A star of six points, whose middle is a hexagon.
            (Level(1, 0, 0), Level(1, turned, Depth), 1 / Math.Sqrt(3), none),
            (onA, Level(10, 0, Depth), 1, [-1, 1]),
            (Level(10, 0, 0), onB, 1, [-1, 1]),
            (onA, onB, 1, [-1, 1]),
        ];
        var found = FaceHarness<Triangle, TriangleWide, TriangleFeature, Triangle, TriangleWide, TriangleFeature>.Run(
            [.. pairs.Select(pair => new FacePair<Triangle, Triangle>(pair.A, pair.B, default, Quaternion.Identity, Quaternion.Identity,
                Vector3.UnitY, Depth, default, 0.1f))]);
        foreach (var (pair, contacts) in pairs.Zip(found, (pair, contacts) => (pair, contacts.Contacts)))
        {
            Assert.InRange(contacts.Length, pair.X.Length == 0 ? 3 : 2, 4);
            foreach (var contact in contacts)
            {
                Assert.Equal(Depth, contact.Depth, 1e-6);
                Assert.Equal(0.5 * Depth, contact.Offset.Y, 1e-6);
                Assert.Equal(pair.Radius, Math.Sqrt(contact.Offset.X * contact.Offset.X + contact.Offset.Z * contact.Offset.Z), 2e-4);
            }
            Assert.Equal(pair.X, pair.X.Length == 0 ? none : contacts.Select(contact => Math.Round(contact.Offset.X, 3)).Order());
        }
    }

    static Triangle Level(float radius, double turn, float height)
    {
        return new(At(0), At(1), At(2)) { TwoSided = true };

        Vector3 At(int corner)
        {
            var angle = turn + corner * (2 * Math.PI / 3);
            return new((float)(radius * Math.Cos(angle)), height, (float)(radius * Math.Sin(angle)));
        }
    }
}
