using System.Globalization;
using System.Numerics;
using System.Text;
using Demos.Scenes;
using Xunit;

namespace DemoTests.Runner;

public class SceneFileTests
{
    [Fact]
    public void Everything_in_a_file_is_read()
    {
        SceneDescription scene = SampleScene.Parse(SampleScene.Text);

        Assert.Equal(("sample", 10, 0.5f, 0.05f, true), (scene.Name, scene.Steps, scene.Friction, scene.Damping, scene.Sleep));
        Assert.Equal(
            ["box", "sphere", "capsule", "cylinder", "hull", "mesh"],
            scene.Shapes.ConvertAll(shape => shape.Word));
        Assert.Equal(new Vector3(0.5f, 1, 1.5f), scene.Shapes[0].Size);
        Assert.Equal(new Vector3(0.25f, 0, 0), scene.Shapes[1].Size);
        Assert.Equal(new Vector3(0.25f, 0.5f, 0), scene.Shapes[2].Size);
        Assert.Equal(new Vector3(0.5f, 0.75f, 0), scene.Shapes[3].Size);
        Assert.Equal([Vector3.Zero, Vector3.UnitX, Vector3.UnitY, Vector3.UnitZ], scene.Shapes[4].Points);
        Assert.Equal([Vector3.Zero, Vector3.UnitX, Vector3.UnitZ], scene.Shapes[5].Points);
        Assert.Equal([0, 1, 2], scene.Shapes[5].Indices);
        Assert.Equal(8, scene.Shapes[0].Line);
        Assert.Equal(4, scene.Bodies.Count);
        Assert.Equal(2, scene.Joints.Count);
    }

    [Fact]
    public void Bodies_have_their_kind_mass_and_motion()
    {
        SceneDescription scene = SampleScene.Parse(SampleScene.Text);
        SceneBody body = scene.Bodies[2];

        Assert.Equal(SceneBodyKind.Static, scene.Bodies[0].Kind);
        Assert.Equal(SceneBodyKind.Kinematic, scene.Bodies[1].Kind);
        Assert.Empty(scene.Bodies[1].Children);
        Assert.Equal((SceneBodyKind.Dynamic, 2.5f, 3, 17), (body.Kind, body.Mass, body.Group, body.Line));
        Assert.Equal(new Vector3(1, 2, 3), body.Position);
        Assert.Equal(new Vector3(4, 5, 6), body.LinearVelocity);
        Assert.Equal(new Vector3(7, 8, 9), body.AngularVelocity);
        Assert.False(body.IsCompound);
        Assert.True(scene.Bodies[3].IsCompound);
        Assert.Equal(new SceneChild(2, new Vector3(0, -1, 0), new Quaternion(0, 1, 0, 0)), scene.Bodies[3].Children[1]);
    }

    [Fact]
    public void Joints_have_their_anchors_and_limits()
    {
        SceneDescription scene = SampleScene.Parse(SampleScene.Text);
        SceneJoint joint = scene.Joints[1];

        Assert.Equal(SceneJointKind.Ball, scene.Joints[0].Kind);
        Assert.Equal((SceneJointKind.Rag, 3, 2, 21), (joint.Kind, joint.BodyA, joint.BodyB, joint.Line));
        Assert.Equal(new Vector3(1, 2, 3), joint.AnchorA);
        Assert.Equal(new Vector3(4, 5, 6), joint.AnchorB);
        Assert.Equal((0.5f, -0.25f, 0.75f), (joint.MaximumSwing, joint.MinimumTwist, joint.MaximumTwist));
    }

    [Fact]
    public void A_rotation_is_set_to_length_one_and_one_of_length_one_is_kept()
    {
        SceneDescription scene = SampleScene.Parse(SampleScene.Text);

        Assert.Equal(Quaternion.Identity, scene.Bodies[2].Orientation);
        Assert.Equal(Quaternion.Identity, scene.Bodies[0].Orientation);
    }

    [Theory]
    [InlineData("\r\n")]
    [InlineData("\t \v\f ")]
    [InlineData("\n\n  \n")]
    public void Any_white_space_separates_tokens(string separator)
    {
        string text = string.Join(separator, SampleScene.Text.Split([' ', '\n']));

        Assert.Equal(4, SampleScene.Parse(text).Bodies.Count);
    }

    [Fact]
    public void A_byte_order_mark_and_a_name_beyond_ascii_are_read()
    {
        byte[] text = [0xEF, 0xBB, 0xBF, .. Encoding.UTF8.GetBytes(SampleScene.Replace(2, 1, "глина"))];

        Assert.Equal("глина", SceneFile.Parse(text).Name);
    }

    [Fact]
    public void Numbers_do_not_depend_on_the_culture()
    {
        CultureInfo before = CultureInfo.CurrentCulture;
        try
        {
            var culture = (CultureInfo)CultureInfo.InvariantCulture.Clone();
            culture.NumberFormat.NumberDecimalSeparator = ",";
            culture.NumberFormat.NegativeSign = "~";
            CultureInfo.CurrentCulture = culture;

            SceneDescription scene = SampleScene.Parse(SampleScene.Text);

            Assert.Equal(0.05f, scene.Damping);
            Assert.Equal(-0.25f, scene.Joints[1].MinimumTwist);
        }
        finally
        {
            CultureInfo.CurrentCulture = before;
        }
    }
}
