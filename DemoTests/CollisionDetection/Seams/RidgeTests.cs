using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What lies across an edge of a mesh that stands out a little touches there and at both of its ends.</summary>
public class RidgeTests
{
    const float Radius = .02f, HalfLength = .1f, Depth = 3e-4f;

    /// <summary>
    /// Across a ridge whose sides fall by a slope, a capsule that is .3 mm deep has its ends in the mesh as well. Two contacts carry it where the one over the
    /// ridge is where a line through them has it, to 5e-3 of its radius, .1 mm; where it stands out of that line it carries what they do not.
    /// </summary>
    [Theory]
    [InlineData(0, 2)]
    [InlineData(.0005f, 2)]
    [InlineData(.002f, 3)]
    [InlineData(.0025f, 3)]
    public void A_capsule_across_a_ridge_is_carried_by_its_ends_and_by_what_stands_out(float slope, int contacts)
    {
        using var world = new TestWorld();
        var fall = slope * 1;
        Vector3[] corners = [new(-1, -fall, -1), new(0, 0, -1), new(1, -fall, -1), new(-1, -fall, 1), new(0, 0, 1), new(1, -fall, 1)];
        var mesh = new Mesh(corners, [0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4], Vector3.One, world.Pool);
        world.Statics.Add(new StaticDescription(RigidPose.Identity, world.Simulation.Shapes.Add(mesh)));
        // The axis of a capsule is Y.
        var alongX = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, float.Pi / 2);
        var body = world.AddDynamic(new Capsule(Radius, 2 * HalfLength), 1, new RigidPose(new Vector3(0, Radius - Depth, .3f), alongX));
        world.Step();
        var found = 0;
        foreach (var constraint in world.Bodies[body].Constraints)
            found += ConstraintTypeIds.ContactCount(world.Solver.Locations[constraint.ConnectingConstraintHandle.Slot].TypeId);
        Assert.Equal(contacts, found);
        mesh.Dispose(world.Pool);
    }
}
