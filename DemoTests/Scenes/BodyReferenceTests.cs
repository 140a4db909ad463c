using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Demos.References;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>What a body's reference reads, writes and applies.</summary>
public class BodyReferenceTests
{
    [Fact]
    public void Dynamics_are_the_bodys_own()
    {
        using var world = new AccuracyWorld(new AccuracySettings { Gravity = default });
        world.AddDynamic(new Sphere(1), 1, new RigidPose(new Vector3(9, 0, 0)));
        var body = world.Bodies[world.AddDynamic(new Box(1, 2, 3), 2, new RigidPose(new Vector3(1, 2, 3)))];
        var dynamics = body.Dynamics;
        Assert.Equal(new Vector3(1, 2, 3), dynamics.Motion.Pose.Position);
        Assert.Equal(.5f, dynamics.Inertia.Local.InverseMass);

        dynamics.Motion.Velocity.Linear = new Vector3(4, 5, 6);
        Assert.Equal(new Vector3(4, 5, 6), body.Velocity.Linear);
        dynamics.Inertia.Local.InverseMass = .25f;
        Assert.Equal(.25f, body.LocalInertia.InverseMass);

        body.Pose.Orientation = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, float.Pi / 2);
        world.Step(1 / 60f);
        // A quarter of a turn about Z: X and Y have changed places.
        var local = body.LocalInertia.InverseInertiaTensor;
        var turned = body.Dynamics.Inertia.World.InverseInertiaTensor;
        Assert.Equal(local.XX, turned.YY, 1e-5f * local.XX);
        Assert.Equal(local.YY, turned.XX, 1e-5f * local.YY);
        Assert.Equal(local.ZZ, turned.ZZ, 1e-5f * local.ZZ);
    }

    [Fact]
    public void A_body_that_moves_in_memory_takes_its_dynamics_along()
    {
        using var world = new AccuracyWorld(new AccuracySettings { Gravity = default });
        var first = world.AddDynamic(new Sphere(1), 1, new RigidPose(new Vector3(9, 0, 0)));
        var last = world.AddDynamic(new Box(1, 2, 3), 2, RigidPose.Identity);
        world.Step(1 / 60f);
        var before = world.Bodies[last].Dynamics.Inertia.World;
        world.Bodies.Remove(first);
        Assert.Equal(before, world.Bodies[last].Dynamics.Inertia.World);
        Assert.Equal(.5f, before.InverseMass);
    }

    /// <summary>Momentum and angular momentum, in double precision, rise by the impulse and its moment, whichever way it is applied.</summary>
    [Fact]
    public void Impulses_change_momenta_by_themselves()
    {
        const float mass = 2;
        var impulse = new Vector3(1, -2, .5f);
        var offset = new Vector3(.3f, .1f, -.7f);
        var orientation = Quaternion.Normalize(new(.1f, .7f, -.3f, .5f));
        using var world = new AccuracyWorld(new AccuracySettings());
        var box = new Box(1, 2, 3);
        var byReference = world.Bodies[world.AddDynamic(box, mass, new RigidPose(default, orientation))];
        byReference.ApplyImpulse(impulse, offset);
        var bySet = world.Bodies[world.AddDynamic(box, mass, new RigidPose(new Vector3(9, 0, 0), orientation))];
        BodyReference.ApplyImpulse(world.Bodies.ActiveSet, bySet.MemoryLocation.Index, impulse, offset);
        var inParts = world.Bodies[world.AddDynamic(box, mass, new RigidPose(new Vector3(18, 0, 0), orientation))];
        inParts.ApplyLinearImpulse(impulse);
        inParts.ApplyAngularImpulse(Vector3.Cross(offset, impulse));

        var moments = new Double3(mass * (4 + 9) / 12.0, mass * (1 + 9) / 12.0, mass * (1 + 4) / 12.0);
        var turn = (DoubleQuaternion)orientation;
        foreach (var body in new[] { byReference, bySet, inParts })
        {
            var linear = (Double3)body.Velocity.Linear * mass;
            var angular = turn.Rotate(Double3.Scale(moments, turn.RotateBack((Double3)body.Velocity.Angular)));
            Assert.True((linear - (Double3)impulse).Length < 1e-6, $"momentum {linear}");
            Assert.True((angular - Double3.Cross((Double3)offset, (Double3)impulse)).Length < 1e-6, $"angular momentum {angular}");
        }
    }
}
