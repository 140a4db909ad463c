using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Numerics;
using Demos.Scenes;
using Xunit;

namespace DemoTests.Runner;

public class BuiltInSceneTests
{
    public static TheoryData<string> Names => new(SceneLibrary.Scenes.Select(scene => scene.Name));

    [Theory]
    [MemberData(nameof(Names))]
    public void A_built_in_scene_is_what_a_file_could_hold(string name)
    {
        SceneDescription scene = SceneLibrary.Load(name, seed: 1);

        Assert.Equal(name, scene.Name);
        Assert.True(scene.Steps > 0);
        foreach (SceneBody body in scene.Bodies)
        {
            Assert.All(body.Children, child => Assert.InRange(child.Shape, 0, scene.Shapes.Count - 1));
            Assert.Equal(1, body.Orientation.Length(), 5);
            Assert.True(float.IsFinite((body.Position + body.LinearVelocity + body.AngularVelocity).Length()));
            Assert.Equal(body.Kind == SceneBodyKind.Dynamic, body.Mass > 0);
        }
        foreach (SceneJoint joint in scene.Joints)
        {
            Assert.InRange(joint.BodyA, 0, scene.Bodies.Count - 1);
            Assert.InRange(joint.BodyB, 0, scene.Bodies.Count - 1);
        }
    }

    [Theory]
    [MemberData(nameof(Names))]
    public void A_seed_makes_the_same_scene_each_time(string name)
    {
        SceneDescription one = SceneLibrary.Load(name, seed: 7), other = SceneLibrary.Load(name, seed: 7);

        Assert.Equal(one.Bodies.ConvertAll(body => (body.Position, body.Orientation)),
            other.Bodies.ConvertAll(body => (body.Position, body.Orientation)));
    }

    /// <summary>Scenes whose summary says so.</summary>
    [Fact]
    public void Scenes_by_lot_depend_on_the_seed_and_no_others()
    {
        foreach (BuiltInScene scene in SceneLibrary.Scenes)
        {
            List<Quaternion> one = scene.Create(1).Bodies.ConvertAll(body => body.Orientation);
            List<Quaternion> other = scene.Create(2).Bodies.ConvertAll(body => body.Orientation);

            Assert.Equal(!scene.Summary.Contains("--seed", StringComparison.Ordinal), one.SequenceEqual(other));
        }
    }

    [Fact]
    public void Pyramids_are_those_of_the_comparison()
    {
        SceneDescription scene = SceneLibrary.Load("pyramids", seed: 1);

        Assert.Equal((300, 0.5f, 0.05f, false), (scene.Steps, scene.Friction, scene.Damping, scene.Sleep));
        Assert.Equal(4201, scene.Bodies.Count);
        Assert.Equal(new Vector3(200, 1, 200), scene.Shapes[scene.Bodies[0].Children[0].Shape].Size);
        Assert.Equal(new Vector3(0, -1, 0), scene.Bodies[0].Position);
        Assert.Equal(new Vector3(-10.45f, 0.5f, -47.5f), scene.Bodies[1].Position);
        Assert.Equal(new Vector3(-9.35f, 0.5f, -47.5f), scene.Bodies[2].Position);
        Assert.Equal(new Vector3(-9.9f, 1.5f, -47.5f), scene.Bodies[21].Position);
        Assert.Equal(new Vector3(0, 19.5f, 47.5f), scene.Bodies[^1].Position);
    }

    [Fact]
    public void The_great_pyramid_is_that_of_the_comparison()
    {
        SceneDescription scene = SceneLibrary.Load("great-pyramid", seed: 1);

        Assert.Equal(5051, scene.Bodies.Count);
        Assert.Equal(new Vector3(-54.45f, 0.5f, 0), scene.Bodies[1].Position);
        Assert.Equal(new Vector3(0, 99.5f, 0), scene.Bodies[^1].Position);
    }

    [Fact]
    public void The_lattice_is_that_of_the_comparison()
    {
        SceneDescription scene = SceneLibrary.Load("cloth-lattice", seed: 1);

        Assert.Equal((120, 16384, 64770), (scene.Steps, scene.Bodies.Count, scene.Joints.Count));
        Assert.Equal([0, 127, 127 * 128, 128 * 128 - 1],
            Enumerable.Range(0, scene.Bodies.Count).Where(i => scene.Bodies[i].Kind == SceneBodyKind.Kinematic));
        Assert.All(scene.Bodies, body => Assert.Equal(-1, body.Group));
        Assert.Equal(new Vector3(-111.125f, 0, -111.125f), scene.Bodies[0].Position);
        // Every joint begins closed.
        Assert.All(scene.Joints, joint => Assert.Equal(scene.Bodies[joint.BodyA].Position + joint.AnchorA,
            scene.Bodies[joint.BodyB].Position + joint.AnchorB));
        Assert.Equal([(0, 128), (0, 1), (0, 129), (1, 129)], scene.Joints.Take(4).Select(joint => (joint.BodyA, joint.BodyB)));
    }

    [Fact]
    public void An_unknown_name_is_refused_and_a_missing_file_is_said_to_be_missing()
    {
        var error = Assert.Throws<SceneException>(() => SceneLibrary.Load("nothing-like-it", 1));

        Assert.Contains("'nothing-like-it'", error.Message, StringComparison.Ordinal);
        Assert.Throws<FileNotFoundException>(() => SceneLibrary.Load("nothing-like-it.scene", 1));
    }
}
