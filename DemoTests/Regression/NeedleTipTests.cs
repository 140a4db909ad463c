using System;
using System.Numerics;
using BepuPhysics.Collidables;
using DemoTests.CollisionDetection;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// A capsule that lies across the tip of a needle has its contacts on the needle. The border that hides rounding at the edges of a face was as
/// wide at the tip as elsewhere, so that the two edges met a hundred borders beyond it: 3.5 hundredths of the capsule's size.
/// </summary>
public class NeedleTipTests
{
    const float Radius = .05f;
    const float Length = 1;
    const float Depth = 1e-5f;

    [Theory]
    [InlineData(40, .4f)]
    [InlineData(100, 1)]
    [InlineData(100, .5f)]
    [InlineData(400, 2)]
    public void Contacts_of_a_capsule_stay_on_a_needle(float length, float width)
    {
        for (int i = 0; i < 24; ++i)
        {
            // The tip is at the triangle's origin, the needle along X in one of the turns about Y, and the capsule above the tip in line with it.
            double turn = Math.Tau * i / 24;
            var along = new Vector3((float)Math.Cos(turn), 0, (float)Math.Sin(turn));
            var across = new Vector3(-along.Z, 0, along.X);
            var triangle = new Triangle(Vector3.Zero, along * length + across * width, along * length - across * width) { TwoSided = true };
            var axis = Vector3.Normalize(Vector3.UnitY + along);
            // Half a turn about the middle between Y and the needle takes the capsule's axis to the needle.
            var orientation = new Quaternion(axis, 0);
            var manifold = PairHarness.Run(new PairCase<Capsule, Triangle>(new(Radius, Length), triangle, new(0, -Radius + Depth, 0), orientation,
                Quaternion.Identity), .01f);
            Assert.Equal(2, manifold.Count);
            for (int j = 0; j < 2; ++j)
            {
                var place = manifold[j].Offset;
                Assert.Equal(Depth, manifold[j].Depth, 1e-6f * length);
                // Three borders of 3e-6 of both sizes.
                Assert.InRange(Vector3.Dot(place, along), -1e-5f * length, .5f * Length + Radius);
            }
        }
    }
}
