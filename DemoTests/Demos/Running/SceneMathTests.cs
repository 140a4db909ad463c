using System;
using System.Numerics;
using Demos.Running;
using Xunit;

namespace DemoTests.Runner;

public class SceneMathTests
{
    static readonly Vector3[] directions =
    [
        Vector3.UnitX, Vector3.UnitY, Vector3.UnitZ, -Vector3.UnitX, -Vector3.UnitY, -Vector3.UnitZ,
        Vector3.Normalize(new Vector3(1, 2, 3)), Vector3.Normalize(new Vector3(-1, -2, -3)), Vector3.Normalize(new Vector3(1, -1e-4f, 0)),
    ];

    [Fact]
    public void The_cosine_is_that_of_the_framework_to_more_digits_than_are_used()
    {
        for (double angle = 0; angle <= Math.PI; angle += 0.001)
            Assert.InRange(SceneMath.Cosine(angle) - Math.Cos(angle), -1e-12, 1e-12);
        Assert.InRange(SceneMath.Cosine(Math.PI) + 1, -1e-12, 1e-12);
    }

    [Fact]
    public void Rotations_turn_as_the_framework_does()
    {
        var first = Quaternion.CreateFromYawPitchRoll(1, 0.5f, -2);
        var second = Quaternion.CreateFromYawPitchRoll(-0.3f, 2.5f, 0.7f);
        foreach (Vector3 direction in directions)
        {
            Near(Vector3.Transform(direction, first), SceneMath.Rotate(direction, first));
            Near(Vector3.Transform(Vector3.Transform(direction, first), second),
                SceneMath.Rotate(direction, SceneMath.Concatenate(first, second)));
        }
    }

    [Fact]
    public void The_shortest_rotation_reaches_its_aim_from_everywhere()
    {
        foreach (Vector3 from in directions)
        {
            foreach (Vector3 to in directions)
            {
                Quaternion rotation = SceneMath.Between(from, to);

                Assert.Equal(1, rotation.Length(), 5);
                Near(to, SceneMath.Rotate(from, rotation));
            }
        }
    }

    [Fact]
    public void A_basis_has_its_x_and_z_axes_where_they_were_asked_for()
    {
        foreach (Vector3 z in directions)
        {
            foreach (Vector3 other in directions)
            {
                Vector3 x = Vector3.Cross(z, other);
                if (x.Length() < 0.01f)
                    continue;
                x = Vector3.Normalize(x);

                Quaternion basis = SceneMath.Basis(x, z);

                Near(x, SceneMath.Rotate(Vector3.UnitX, basis));
                Near(z, SceneMath.Rotate(Vector3.UnitZ, basis));
            }
        }
    }

    static void Near(Vector3 expected, Vector3 actual) => Assert.True((expected - actual).Length() < 2e-3f, $"{expected} is not {actual}");
}
