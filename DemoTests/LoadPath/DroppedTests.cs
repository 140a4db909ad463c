using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using BepuPhysics;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>What falls onto each other, layer by layer, stays where it was put: what has landed is not a rigid anvil for what comes.</summary>
public class DroppedTests
{
    const int Count = 24;

    // Layers with a gap of the same height below each, and all of them a little out of place.
    sealed class Pile(LoadPathWorld world, Random random)
    {
        readonly List<(BodyHandle Body, Vector3 Start)> bodies = [];
        readonly float gap = .2f + .15f * random.NextSingle();
        float top;

        public void AddLayer(Vector3 size, float mass, params Vector2[] places)
        {
            top += gap;
            foreach (var place in places.DefaultIfEmpty())
            {
                var start = new Vector3(place.X + Aside(), top + size.Y / 2, place.Y + Aside());
                bodies.Add((world.Add(start, size, mass), start));
            }
            top += size.Y;
        }

        float Aside() => (random.NextSingle() - .5f) * .01f;

        /// <summary>How far the one that went farthest is aside of its place, m.</summary>
        public float Land()
        {
            world.Run(10);
            return bodies.Max(body =>
            {
                var way = world.Position(body.Body) - body.Start;
                return MathF.Sqrt(way.X * way.X + way.Z * way.Z);
            });
        }
    }

    static int CountBeyond(float limit, int seeds, Action<Pile> add, int substeps = 4, float contactFrequency = 0) => Enumerable.Range(0, seeds).Count(seed =>
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded, substeps: substeps);
        world.Simulation.Solver.ContactFrequency = contactFrequency;
        var pile = new Pile(world, new Random(5000 + seed));
        add(pile);
        return pile.Land() > limit;
    });

    // Three storeys of four posts and a slab.
    static void AddHouse(Pile pile)
    {
        for (int storey = 0; storey < 3; ++storey)
        {
            pile.AddLayer(new(.2f, .8f, .2f), 1, new(-.4f, -.8f), new(.4f, -.8f), new(-.4f, .8f), new(.4f, .8f));
            pile.AddLayer(new(1, .2f, 2), 5);
        }
    }

    [Fact]
    public void Houses_stand_that_fall_storey_by_storey() => Assert.InRange(CountBeyond(.1f, Count, AddHouse), 0, 4);

    /// <summary>More substeps make contacts stiffer, and those throw: with sixteen nearly all houses fall, and with a frequency for contacts none.</summary>
    [Fact]
    public void Contacts_of_a_frequency_throw_no_house() =>
        Assert.InRange(CountBeyond(.1f, Count, AddHouse, substeps: 16, contactFrequency: 30), 0, 1);

    /// <summary>Ten slabs, of which those on top come down with 8 m/s.</summary>
    [Fact]
    public void Slabs_lie_where_they_fall()
    {
        var thrown = CountBeyond(.08f, 2 * Count, pile =>
        {
            for (int i = 0; i < 10; ++i)
                pile.AddLayer(new(1, .2f, 1), 1);
        });

        Assert.InRange(thrown, 0, 3);
    }

    /// <summary>Boxes of 10, 1, 10, 1 and 100 kg: the light ones are crushed.</summary>
    [Fact]
    public void Heavy_boxes_on_light_ones_fall_seldom()
    {
        var fallen = CountBeyond(.5f, Count, pile =>
        {
            foreach (var mass in new[] { 10f, 1, 10, 1, 100 })
                pile.AddLayer(Vector3.One, mass);
        });

        Assert.InRange(fallen, 0, 11);
    }

    /// <summary>A tower that sways is held on, and loses nothing, whatever light thing hits it: that makes no part of it much faster.</summary>
    [Fact]
    public void A_light_thing_that_hits_a_tower_does_not_let_it_go()
    {
        using var world = new LoadPathWorld(LoadPathMode.WhereNeeded);
        var boxes = Enumerable.Range(0, 30).Select(i => world.Add(
            new Vector3(0, .5f + i, 0), Vector3.One, 1, i == 29 ? new Vector3(.5f, 0, 0) : default)).ToArray();
        for (int hit = 0; hit < 8; ++hit)
            world.Add(new Vector3(-.6f - hit * .5f, 25, .4f), new Vector3(.1f), .01f, new Vector3(10, 0, 0));
        world.Run(5);
        for (int i = 0; i < boxes.Length; ++i)
            Assert.InRange(world.Position(boxes[i]).Y, .499f + i, .501f + i);
    }
}
