using System;
using System.Linq;
using System.Numerics;
using System.Runtime.InteropServices;
using BepuPhysics;
using BepuUtilities;
using Demos.Accuracy;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.Determinism;

/// <summary>Bodies that turn slowly, or all about an axis of symmetry, are turned by shorter ways: with the bits that they have beside any others.</summary>
public class TurningNeighbourTests
{
    const int Steps = 12;
    // More than the lanes of any bundle, so that there is one without the neighbour.
    const int Others = 20;

    public enum Inertia
    {
        SameAboutXAndZ,
        SameAboutXAndY,
        SameAboutYAndZ,
        SameAboutAll,
        Different,
        Tilted,
        Any,
    }

    public static TheoryData<Inertia, int> Cases()
    {
        var cases = new TheoryData<Inertia, int>();
        foreach (var inertia in Enum.GetValues<Inertia>())
        {
            for (int seed = 1; seed <= 6; ++seed)
                cases.Add(inertia, seed);
        }
        return cases;
    }

    [Theory]
    [MemberData(nameof(Cases))]
    public void A_neighbour_that_spins_fast_changes_no_bit(Inertia inertia, int seed)
    {
        var expected = Run(inertia, seed, null);
        Assert.Equal(expected, Run(inertia, seed, New(Inertia.Different, new(seed), new Vector3(300, -700, 90))));
        Assert.Equal(expected, Run(inertia, seed, New(Inertia.Tilted, new(seed), new Vector3(1, 2, -.5f))));
        Assert.Equal(expected, Run(inertia, seed, New(Inertia.Different, new(seed), default)));
    }

    // All bits of the bodies behind the first.
    static byte[] Run(Inertia inertia, int seed, BodyDescription? neighbour)
    {
        using var world = new TestWorld(new AccuracySettings { Gravity = default, Contacts = ContactScope.None });
        var random = new Random(seed);
        var like = New(inertia, random, new Vector3(.1f, .2f, .3f));
        world.Bodies.Add(neighbour ?? like);
        // From what hardly turns in a year to what turns by a fifth of a turn in a substep.
        var handles = Enumerable.Range(0, Others).Select(_ =>
        {
            var speed = MathF.Pow(10, -9 + 11.5f * random.NextSingle());
            var axis = new Vector3(random.NextSingle() - .5f, random.NextSingle() - .5f, random.Next(4) == 0 ? 0 : random.NextSingle() - .5f);
            return world.Bodies.Add(New(inertia, random, Vector3.Normalize(axis) * (random.Next(8) == 0 ? 0 : speed)));
        }).ToArray();
        world.Step(Steps);
        return [.. handles.SelectMany(handle =>
        {
            var body = world.Bodies[handle];
            return MemoryMarshal.AsBytes<MotionState>([new() { Pose = body.Pose, Velocity = body.Velocity }]).ToArray();
        })];
    }

    static BodyDescription New(Inertia inertia, Random random, Vector3 angular)
    {
        if (inertia == Inertia.Any)
            inertia = (Inertia)random.Next((int)Inertia.Any);
        float a = .2f + random.NextSingle(), b = .2f + random.NextSingle(), c = .2f + random.NextSingle();
        var tensor = inertia switch
        {
            Inertia.SameAboutXAndZ => new Symmetric3x3 { XX = a, YY = b, ZZ = a },
            Inertia.SameAboutXAndY => new Symmetric3x3 { XX = a, YY = a, ZZ = b },
            Inertia.SameAboutYAndZ => new Symmetric3x3 { XX = b, YY = a, ZZ = a },
            Inertia.SameAboutAll => new Symmetric3x3 { XX = a, YY = a, ZZ = a },
            Inertia.Tilted => new Symmetric3x3 { XX = a, YX = .05f, YY = b, ZX = -.03f, ZY = .04f, ZZ = c },
            _ => new Symmetric3x3 { XX = a, YY = b, ZZ = c },
        };
        var turn = random.Next(3) == 0 ? Quaternion.Identity : Quaternion.Normalize(
            new(random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f, random.NextSingle() - .5f));
        var pose = new RigidPose(new Vector3(random.NextSingle(), random.NextSingle(), random.NextSingle()), turn);
        return BodyDescription.CreateDynamic(
            pose, new BodyVelocity(default, angular), new BodyInertia { InverseMass = 1, InverseInertiaTensor = tensor }, default, new(-1));
    }
}
