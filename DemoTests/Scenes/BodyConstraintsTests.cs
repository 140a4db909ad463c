using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Xunit;

namespace DemoTests.Scenes;

/// <summary>The list of a body's constraints, beside a list that is kept with it.</summary>
public class BodyConstraintsTests
{
    const int BodyCount = 12;

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void Constraints_are_listed_in_the_order_in_which_they_were_added(int seed)
    {
        var random = new Random(seed);
        using var world = new TestWorld();
        var bodies = new List<BodyHandle>();
        var expected = new Dictionary<BodyHandle, List<(ConstraintHandle Constraint, int Slot)>>();
        for (int i = 0; i < BodyCount; ++i)
            Add();
        for (int i = 0; i < 600; ++i)
        {
            switch (random.Next(12))
            {
                case 0:
                    Remove(bodies[random.Next(bodies.Count)]);
                    Add();
                    break;
                case < 5:
                    if (expected.Values.FirstOrDefault(list => list.Count > 0) is { } list)
                        Forget(list[random.Next(list.Count)].Constraint);
                    break;
                // The first constraint of four bodies makes all edges longer.
                case < 8 when i > 200:
                    Connect([.. bodies.OrderBy(_ => random.Next()).Take(4)], handles => world.Solver.Add(handles, default(Quadruple)));
                    break;
                default:
                    Connect([.. bodies.OrderBy(_ => random.Next()).Take(2)], handles => world.Solver.Add(handles[0], handles[1], new BallSocket()));
                    break;
            }
            world.Simulation.Validate();
            foreach (var (body, list) in expected)
                Assert.Equal(list, Listed(world.Bodies[body].Constraints));
        }

        void Add()
        {
            var body = world.AddDynamic(new Sphere(.1f), 1, new RigidPose(new Vector3(bodies.Count, 0, 0)));
            bodies.Add(body);
            expected.Add(body, []);
        }

        void Remove(BodyHandle body)
        {
            world.Bodies.Remove(body);
            bodies.Remove(body);
            expected.Remove(body, out var lost);
            foreach (var (constraint, _) in lost!)
                Unlist(constraint);
        }

        void Forget(ConstraintHandle constraint)
        {
            world.Solver.Remove(constraint);
            Unlist(constraint);
        }

        void Unlist(ConstraintHandle constraint)
        {
            foreach (var list in expected.Values)
                list.RemoveAll(entry => entry.Constraint == constraint);
        }

        void Connect(BodyHandle[] handles, Func<BodyHandle[], ConstraintHandle> add)
        {
            var constraint = add(handles);
            for (int slot = 0; slot < handles.Length; ++slot)
                expected[handles[slot]].Add((constraint, slot));
        }
    }

    [Fact]
    public void A_place_behind_the_last_constraint_is_refused()
    {
        using var world = new TestWorld();
        var body = world.AddDynamic(new Sphere(.1f), 1, new RigidPose(default));
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Bodies[body].Constraints[0]);
        Assert.Throws<ArgumentOutOfRangeException>(() => world.Bodies[body].Constraints[-1]);
    }

    static List<(ConstraintHandle, int)> Listed(BodyConstraints constraints)
    {
        var list = new List<(ConstraintHandle, int)>();
        foreach (var constraint in constraints)
        {
            Assert.Equal(constraint.ConnectingConstraintHandle, constraints[list.Count].ConnectingConstraintHandle);
            list.Add((constraint.ConnectingConstraintHandle, constraint.BodyIndexInConstraint));
        }
        Assert.Equal(constraints.Count, list.Count);
        return list;
    }

    /// <summary>A constraint on four bodies that does nothing.</summary>
    public struct Quadruple : IFourBodyConstraintDescription<Quadruple>
    {
        /// <summary>One float: there must be some.</summary>
        public float Nothing;

        /// <inheritdoc/>
        public static int ConstraintTypeId => 120;

        /// <inheritdoc/>
        public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<FourBodies, Vector<float>, Rows1, Idle>();
    }

    /// <summary>Does nothing.</summary>
    public readonly struct Idle : IConstraint<FourBodies, Vector<float>, Rows1>
    {
        /// <inheritdoc/>
        public static BodyAccess WarmStartAccess => BodyAccess.Pose;
        /// <inheritdoc/>
        public static BodyAccess SolveAccess => BodyAccess.Pose;
        /// <inheritdoc/>
        public static void WarmStart(ref FourBodies bodies, in Substep substep, ref Vector<float> prestep, ref Rows1 impulses) { }
        /// <inheritdoc/>
        public static void Solve(ref FourBodies bodies, in Substep substep, ref Vector<float> prestep, ref Rows1 impulses) { }
    }
}
