using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities.Memory;
using DemoTests.CollisionDetection.Children;
using Xunit;
using Xunit.Abstractions;

namespace DemoTests.CollisionDetection.Seams;

/// <summary>What steps, posts and corners are made of.</summary>
public enum StepMaterial
{
    /// <summary>Separate boxes.</summary>
    Boxes,
    /// <summary>A compound of boxes.</summary>
    Compound,
    /// <summary>One mesh of large triangles.</summary>
    Mesh,
    /// <summary>One mesh of triangles of a few centimetres.</summary>
    FineMesh,
}

/// <summary>Steps, posts and corners push along the normals of their faces, whatever they are made of.</summary>
public class StepTests(ITestOutputHelper output)
{
    // Of half a degree.
    const float LeastCosine = .99996192f;

    // Blocks by their least and greatest corners. None looks out of another's side, so that their faces are those of their union.
    static void Add(ClusterWorld world, StepMaterial material, params (Vector3 Min, Vector3 Max)[] blocks)
    {
        var (shapes, pool) = (world.Simulation.Shapes, world.Simulation.BufferPool);
        if (material is StepMaterial.Mesh or StepMaterial.FineMesh)
        {
            var (vertices, indices) = (new List<Vector3>(), new List<int>());
            foreach (var (min, max) in blocks)
                AddFaces(vertices, indices, min, max, material == StepMaterial.FineMesh ? .07f : 100);
            var mesh = new Mesh(vertices.ToArray(), indices.ToArray(), Vector3.One, pool);
            world.Own(mesh);
            world.Simulation.Statics.Add(new StaticDescription(Vector3.Zero, shapes.Add(mesh)));
            return;
        }
        var children = blocks.Select(block =>
        {
            var size = block.Max - block.Min;
            return new CompoundChild(new RigidPose((block.Min + block.Max) / 2), shapes.Add(new Box(size.X, size.Y, size.Z)));
        }).ToArray();
        if (material == StepMaterial.Boxes)
        {
            foreach (var child in children)
                world.Simulation.Statics.Add(new StaticDescription(child.LocalPosition, child.ShapeIndex));
            return;
        }
        pool.Take(children.Length, out Buffer<CompoundChild> buffer);
        children.CopyTo(buffer.AsSpan());
        var compound = new Compound(buffer);
        world.Own(compound);
        world.Simulation.Statics.Add(new StaticDescription(Vector3.Zero, shapes.Add(compound)));
    }

    // All but the lower face of a block, in cells of at most a size.
    static void AddFaces(List<Vector3> vertices, List<int> indices, Vector3 min, Vector3 max, float cell)
    {
        for (int face = 0; face < 5; ++face)
        {
            // The upper face, then the four sides.
            var axis = face == 0 ? 1 : face < 3 ? 0 : 2;
            var isUpper = face % 2 == 0;
            int u = (axis + 1) % 3, v = (axis + 2) % 3;
            var (countU, countV) = ((int)MathF.Ceiling((max[u] - min[u]) / cell), (int)MathF.Ceiling((max[v] - min[v]) / cell));
            var first = vertices.Count;
            for (int i = 0; i < (countU + 1) * (countV + 1); ++i)
            {
                var (column, row) = (i % (countU + 1), i / (countU + 1));
                Vector3 vertex = default;
                vertex[axis] = isUpper ? max[axis] : min[axis];
                vertex[u] = column == countU ? max[u] : min[u] + (max[u] - min[u]) * column / countU;
                vertex[v] = row == countV ? max[v] : min[v] + (max[v] - min[v]) * row / countV;
                vertices.Add(vertex);
                if (column == countU || row == countV)
                    continue;
                var (a, b, c, d) = (first + i, first + i + 1, first + i + countU + 1, first + i + countU + 2);
                indices.AddRange(isUpper ? [a, c, b, b, c, d] : [a, b, c, b, d, c]);
            }
        }
    }

    static readonly (Vector3, Vector3) Floor = (new(-3, -1, -1), new(1, 0, 1));

    // Steps, and what normals of contacts that push are farthest from those that there may be.
    float Step(ClusterWorld world, int count, params Vector3[] normals)
    {
        var least = 1f;
        world.Behaviour.Configure = manifold =>
        {
            if (manifold is NonconvexContactManifold nonconvex)
            {
                for (int i = 0; i < nonconvex.Count; ++i)
                    Look(nonconvex.GetNormal(i), nonconvex.GetDepth(i));
            }
            else
            {
                var convex = (ConvexContactManifold)manifold;
                for (int i = 0; i < convex.Count; ++i)
                    Look(convex.Normal, convex.GetDepth(i));
            }
            return null;
        };
        for (int i = 0; i < count; ++i)
            world.Step(validate: false);
        return least;

        void Look(Vector3 normal, float depth)
        {
            if (depth <= 0)
                return;
            var cosine = normals.Max(expected => Vector3.Dot(normal, expected));
            if (cosine < least)
                output.WriteLine($"step {world.StepCount}: normal {normal}, depth {depth}");
            least = Math.Min(least, cosine);
        }
    }

    static BodyHandle AddMover(ClusterWorld world, SeamMover mover, Vector3 place, float speed)
    {
        var body = SeamMovers.Add(world, mover, speed);
        world.Simulation.Bodies[body].Pose.Position += place;
        world.Simulation.Bodies[body].Velocity.Angular = default;
        // It does not turn: what leans has other normals.
        world.Simulation.Bodies[body].SetLocalInertia(new BodyInertia { InverseMass = 1 });
        return body;
    }

    public static TheoryData<StepMaterial, SeamMover, float> Steps
    {
        get
        {
            var data = new TheoryData<StepMaterial, SeamMover, float>();
            foreach (var material in Enum.GetValues<StepMaterial>())
            {
                foreach (var height in new[] { .05f, .2f })
                {
                    data.Add(material, SeamMover.Box, height);
                    data.Add(material, SeamMover.StandingCylinder, height);
                }
                // What is round must not be higher than the step.
                data.Add(material, SeamMover.SmallSphere, .2f);
            }
            return data;
        }
    }

    /// <summary>What slides against a step stands there, pushed up by the floor and back by the step.</summary>
    [Theory, MemberData(nameof(Steps))]
    public void A_step_stops_what_slides(StepMaterial material, SeamMover mover, float height)
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = .03f;
        Add(world, material, Floor, (new(1, -1, -1), new(2, height, 1)));
        var radius = mover == SeamMover.Box ? .25f : mover == SeamMover.SmallSphere ? .1f : .3f;
        var body = AddMover(world, mover, new(-.4f, 0, .1f), 1.5f);
        // Friction alone would let it go 3.7 m.
        var y = world.Simulation.Bodies[body].Pose.Position.Y;
        var cosine = Step(world, 180, Vector3.UnitY, -Vector3.UnitX);
        var pose = world.Simulation.Bodies[body].Pose.Position;
        output.WriteLine($"{pose} {cosine}");
        Assert.InRange(pose.X, 1 - radius - 3e-2f, 1 - radius + 1e-3f);
        Assert.InRange(world.Simulation.Bodies[body].Velocity.Linear.Length(), 0, 1e-3f);
        Assert.InRange(pose.Y, y - 1e-3f, y + 1e-3f);
        Assert.InRange(cosine, LeastCosine, 1.001f);
    }

    /// <summary>
    /// What was put against a step that is as high as half of it stands there, though the top of the step is as deep in it as in something that was pressed
    /// through that.
    /// </summary>
    [Theory, InlineData(SeamMover.Box, .25f), InlineData(SeamMover.StandingCylinder, .2f)]
    public void A_step_that_is_half_as_high_lifts_nothing(SeamMover mover, float height)
    {
        var radius = mover == SeamMover.Box ? .25f : .3f;
        foreach (var material in new[] { StepMaterial.Mesh, StepMaterial.FineMesh })
        {
            foreach (var depth in new[] { -1e-5f, 0, 1e-6f, 1e-5f, 5e-5f, 1e-4f, 1e-3f })
            {
                using var world = new ClusterWorld(isCluster: true);
                Add(world, material, Floor, (new(1, -1, -1), new(2, height, 1)));
                var body = AddMover(world, mover, new(1 - radius + depth, 0, .1f), 0);
                var y = world.Simulation.Bodies[body].Pose.Position.Y;
                Step(world, 30, Vector3.UnitY, -Vector3.UnitX);
                output.WriteLine($"{material}, {depth} deep: {world.Simulation.Bodies[body].Pose.Position}");
                Assert.InRange(world.Simulation.Bodies[body].Pose.Position.Y, y - 1e-3f, y + 1e-3f);
            }
        }
    }

    /// <summary>A box in a corner of a floor and two walls is pushed by these three, and by nothing between them.</summary>
    [Theory, InlineData(StepMaterial.Boxes), InlineData(StepMaterial.Compound), InlineData(StepMaterial.Mesh), InlineData(StepMaterial.FineMesh)]
    public void A_corner_has_three_normals(StepMaterial material)
    {
        using var world = new ClusterWorld(isCluster: true);
        world.Behaviour.Friction = .3f;
        Add(world, material, Floor, (new(1, -1, -1), new(2, 1, 1)), (new(-3, -1, 1), new(2, 1, 2)));
        var body = AddMover(world, SeamMover.Box, new(.6f, .02f, .6f), 0);
        world.Simulation.Bodies[body].Velocity.Linear = new(1.5f, 0, 1.2f);
        var cosine = Step(world, 180, Vector3.UnitY, -Vector3.UnitX, -Vector3.UnitZ);
        var moved = world.Simulation.Bodies[body];
        output.WriteLine($"{moved.Pose.Position} {cosine}");
        Assert.InRange((moved.Pose.Position - new Vector3(.75f, .25f, .75f)).Length(), 0, 5e-3f);
        Assert.InRange(moved.Velocity.Linear.Length(), 0, 1e-3f);
        Assert.InRange(cosine, LeastCosine, 1.001f);
    }

    /// <summary>The top of a post that is narrower than what comes down on it is flat.</summary>
    [Theory, InlineData(StepMaterial.Boxes), InlineData(StepMaterial.Compound), InlineData(StepMaterial.Mesh), InlineData(StepMaterial.FineMesh)]
    public void A_box_rests_on_the_top_of_a_fence_post(StepMaterial material)
    {
        using var world = new ClusterWorld(isCluster: true);
        Add(world, material, (new(-3, -1, -1), new(3, -.8f, 1)), (new(-.1f, -1, -.1f), new(.1f, 0, .1f)));
        var body = AddMover(world, SeamMover.Box, new(.02f, .02f, .03f), 0);
        var cosine = Step(world, 180, Vector3.UnitY);
        var moved = world.Simulation.Bodies[body];
        output.WriteLine($"{moved.Pose.Position} {cosine}");
        Assert.InRange((moved.Pose.Position - new Vector3(.02f, .2499f, .03f)).Length(), 0, 1e-3f);
        Assert.InRange(moved.Velocity.Linear.Length(), 0, 1e-3f);
        Assert.InRange(cosine, LeastCosine, 1.001f);
    }
}
