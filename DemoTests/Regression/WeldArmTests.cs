using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Regression;

/// <summary>
/// A weld holds the centre of the body that is easier to turn, and those who asked only how far it is off had not read which that is: what the stack had
/// there before decided, and with it whether the weld asked to be solved at once.
/// </summary>
public class WeldArmTests
{
    [Theory]
    [InlineData(true, 1), InlineData(true, -1), InlineData(false, 1), InlineData(false, -1)]
    public void What_a_weld_is_off_by_does_not_depend_on_what_the_stack_had(bool isLightFirst, float painted)
    {
        using var world = new TestWorld(new AccuracySettings { Gravity = default, Contacts = ContactScope.None });
        var (light, heavy) = (new Sphere(.1f), new Sphere(1));
        var a = isLightFirst ? world.AddDynamic(light, .1f, RigidPose.Identity) : world.AddDynamic(heavy, 100, RigidPose.Identity);
        var place = new RigidPose(Vector3.UnitX);
        var b = isLightFirst ? world.AddDynamic(heavy, 100, place) : world.AddDynamic(light, .1f, place);
        var weld = world.Solver.Add(a, b, new Weld { LocalOffset = Vector3.UnitX, LocalOrientation = Quaternion.Identity });
        world.Step();
        // B turns about its own centre: off by the chord if A is what is held, at an arm of B, and not at all if B is.
        const float turn = .1f;
        world.Bodies[b].Pose.Orientation = Quaternion.CreateFromAxisAngle(Vector3.UnitZ, turn);
        var expected = isLightFirst ? 2 * MathF.Sin(turn / 2) : 0;

        ref var location = ref world.Solver.Locations[weld.Slot];
        ref var batch = ref world.Solver.ActiveSet.Batches[location.BatchIndex].TypeBatches[0];
        var processor = world.Solver.Processor(location.TypeId);
        var bodies = new SolverBodies(world.Bodies.Awake);
        var substep = new Substep(0, TestWorld.Dt);
        Paint(painted);
        processor.ReadRigidErrors(ref batch, bodies, substep, 0, out var errors);
        Assert.Equal(expected, errors.Linear[0], 1e-6f);
        Paint(painted);
        Assert.Equal(expected, processor.GreatestError(ref batch, bodies, substep, 0, 1), 1e-6f);
        Paint(painted);
        Assert.Equal(expected, world.Solver.GetSeparation(weld).Linear, 1e-6f);
    }

    // The same in all that the calls to come may take for a body: then neither is easier to turn, or both are.
    [MethodImpl(MethodImplOptions.NoInlining)]
    static void Paint(float value)
    {
        Span<float> stack = stackalloc float[1 << 14];
        stack.Fill(value);
        Assert.Equal(value, stack[stack.Length / 2]);
    }
}
