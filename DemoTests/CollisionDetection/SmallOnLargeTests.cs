using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;
using Demos.References;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>
/// A coin on a large floor: its contacts are as deep as the coin's face lies below the floor there, to the rounding of the coin's size and not
/// of the floor's, whether the search begins cold or where it ended before. A coin that rests is kicked by what its depth jumps.
/// </summary>
public class SmallOnLargeTests
{
    const float Radius = .5f;
    const float HalfLength = .015f;
    const float Depth = 1e-5f;

    [Theory]
    [InlineData(2)]
    [InlineData(20)]
    [InlineData(200)]
    [InlineData(2000)]
    [InlineData(20_000)]
    public void Contacts_are_as_exact_as_the_smaller_shape(float extent)
    {
        var floor = Lanes.Broadcast<Box, BoxWide>(new Box(extent, 2, extent));
        var coin = Lanes.Broadcast<Cylinder, CylinderWide>(new Cylinder(Radius, 2 * HalfLength));
        var random = new Random(1);
        DepthSearchStateWide state = default;
        for (int i = 0; i < 500; ++i)
        {
            if (i % 10 == 0)
                state = default;
            var place = new Vector3(Unit() * .4f, 1 + HalfLength - Depth, Unit() * .4f);
            double tilt = 1e-5, turn = 3 * Unit();
            var orientation = Quaternion.Normalize(new((float)(tilt * Unit()), (float)Math.Sin(turn), (float)(tilt * Unit()), (float)Math.Cos(turn)));
            Check(floor, coin, place, orientation, ref state);
        }

        float Unit() => 2 * random.NextSingle() - 1;
    }

    static void Check(in BoxWide floor, in CylinderWide coin, Vector3 place, Quaternion orientation, ref DepthSearchStateWide state)
    {
        QuaternionWide.Broadcast(orientation, out var orientationWide);
        QuaternionWide.Broadcast(Quaternion.Identity, out var identity);
        var offset = Vector3Wide.Broadcast(place);
        var axes = Matrix3x3Wide.FromQuaternion(orientationWide);
        var margin = new Vector<float>(.01f);
        DepthSearch<BoxWide, BoxSupport, CylinderWide, CylinderSupport>.Find(floor, coin, offset, axes, margin, ref state, out var found);
        FaceManifold<BoxWide, BoxFeature, CylinderWide, CylinderFeature>.Build(floor, coin, offset, axes, found.Normal, found.Depth, found.PointOnA,
            found.Near, margin, Matrix3x3Wide.FromQuaternion(identity), out var manifold);

        var axis = ((DoubleQuaternion)orientation).Rotate(new(0, 1, 0));
        int count = 0;
        for (int i = 0; i < 4; ++i)
        {
            ref var contact = ref manifold.Contacts[i];
            if (contact.Exists[0] == 0)
                continue;
            ++count;
            // The lower face of the coin: axis . (q - place) = -HalfLength.
            double x = contact.OffsetA.X[0] - place.X, z = contact.OffsetA.Z[0] - place.Z;
            double height = place.Y - (HalfLength + axis.X * x + axis.Z * z) / axis.Y;
            Assert.Equal(1 - height, contact.Depth[0], 1e-6 * Radius);
        }
        Assert.Equal(4, count);
    }
}
