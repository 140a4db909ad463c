using System;
using System.Linq;
using BepuPhysics.Constraints.Contact;
using BepuUtilities.Memory;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>The order in which loads are handed down.</summary>
public class SupportGraphTests
{
    const int Ground = -1;
    const int Gap = 3;

    readonly struct Heights(float[] heights, bool isBalanced = true, int fast = -1, int hit = -1) : IHeights, IFloors
    {
        public float Of(int body) => heights[body];

        public bool MoveAlike(int kinematic, int other) => kinematic == other;

        public bool RestsOn(int body, int kinematic) => true;

        public bool Sways(int body, int kinematic) => body != fast;

        public bool IsBalanced(in SupportLink support, int kinematic, ref StandingLoad load) => isBalanced && heights[support.Upper] < 0.5f;

        public bool IsBalanced(ReadOnlySpan<SupportLink> supports, int kinematic, ref StandingLoad load, Span<StandingLoad> parts) =>
            isBalanced && heights[supports[0].Upper] < 0.5f;

        public int CountConstraints(int body) => 2;

        public bool IsHit(int body) => body == hit;
    }

    // Each support has three contacts unless said otherwise.
    static unsafe (int[][] Islands, int SupportCount) Build(int bodyCount, (int Upper, int Lower)[] supports, float[]? heights = null, int contacts = 3,
        bool[]? slides = null, bool[]? leans = null, int spoilt = -1, bool[]? sways = null, bool[]? held = null, bool isBalanced = true, int fast = -1,
        int hit = -1)
    {
        using var pool = new BufferPool();
        SupportGraph graph = default;
        var links = supports.Select((support, i) => new SupportLink
        {
            Upper = support.Upper,
            Lower = support.Lower,
            Count = (byte)contacts,
            Slides = slides is not null && slides[i],
            Leans = leans is not null && leans[i],
            Sways = sways is not null && sways[i],
            IsWhole = sways is not null,
            WasHeld = held is null || held[i],
        }).ToArray();
        pool.Take<byte>(bodyCount, out var isSpoilt);
        isSpoilt.Clear(0, bodyCount);
        if (spoilt >= 0)
            isSpoilt[spoilt] = 1;
        var found = new SupportLink[links.Length + Gap];
        // In two pieces, as two blocks would find them.
        var half = links.Length / 2;
        links.AsSpan(0, half).CopyTo(found);
        links.AsSpan(half).CopyTo(found.AsSpan(half + Gap));
        fixed (SupportLink* memory = found)
        {
            var motions = new Heights(heights ?? new float[bodyCount], isBalanced, fast, hit);
            graph.Build(memory, [(0, half), (half + Gap, links.Length - half)], bodyCount, isSpoilt, motions, pool);
            var middle = graph.Nodes.Count / 2;
            graph.Fill(memory, middle, graph.Nodes.Count);
            graph.Fill(memory, 0, middle);
        }
        var islands = new int[graph.Islands.Count - 1][];
        for (int i = 0; i < islands.Length; ++i)
        {
            islands[i] = new int[graph.Islands[i + 1] - graph.Islands[i]];
            for (int j = 0; j < islands[i].Length; ++j)
            {
                ref var node = ref graph.Nodes[graph.Islands[i] + j];
                islands[i][j] = node.Body;
                Assert.Equal(i, graph.IslandOf(graph.Islands[i] + j));
                Assert.Equal(graph.Islands[i] + j, graph.NodeOf[node.Body]);
                for (int k = node.FirstSupport; k < node.FirstSupport + node.SupportCount; ++k)
                    Assert.Equal(node.Body, graph.Links[k].Upper);
            }
        }
        var count = graph.Links.Count;
        graph.Dispose(pool);
        pool.Return(ref isSpoilt);
        pool.AssertEmpty();
        return (islands, count);
    }

    static void AssertIslands(string expected, int[][] islands) =>
        Assert.Equal(expected, string.Join(", ", islands.Select(island => string.Join(' ', island))));

    [Fact]
    public void Nothing_is_in_an_empty_graph() => Assert.Empty(Build(5, []).Islands);

    [Fact]
    public void Bodies_come_after_what_they_rest_on()
    {
        var (islands, count) = Build(4, [(0, 3), (3, 1), (1, Ground), (2, Ground)]);
        AssertIslands("1 3 0, 2", islands);
        Assert.Equal(4, count);
    }

    /// <summary>Who stands on floors that move differently rests on none of them; who has a foot on the ground rests on that alone.</summary>
    [Fact]
    public void What_rests_on_a_floor_moves_along_with_it()
    {
        int lift = SupportLink.Floor(10), other = SupportLink.Floor(11);
        var (islands, count) = Build(9, [(0, lift), (1, 0), (1, lift), (2, other), (3, 2), (3, 0), (4, Ground), (5, 4), (5, 2), (6, 5), (7, 3), (8, 7)]);
        AssertIslands("0 1, 2, 4 5 6", islands);
        Assert.Equal(7, count);
        Assert.Equal(10, SupportLink.Floor(lift));
    }

    [Fact]
    public void What_does_not_rest_on_the_ground_is_not_in_the_graph()
    {
        var (islands, count) = Build(4, [(0, 1), (2, Ground), (3, 2), (3, 1)]);
        AssertIslands("2 3", islands);
        Assert.Equal(2, count);
    }

    [Fact]
    public void A_body_on_fewer_than_three_contacts_is_not_in_the_graph()
    {
        Assert.Empty(Build(1, [(0, Ground)], contacts: 2).Islands);
        // Nor is what rests on it, but two twos are four.
        Assert.Single(Build(2, [(0, Ground), (1, 0), (1, Ground), (0, Ground)], contacts: 2).Islands);
        Assert.Equal([1], Build(2, [(0, Ground), (1, Ground), (1, Ground)], contacts: 2).Islands.Single());
    }

    [Fact]
    public void What_slides_on_all_that_it_rests_on_is_not_in_the_graph()
    {
        Assert.Empty(Build(2, [(0, Ground), (0, Ground), (1, 0)], slides: [true, true, false]).Islands);
        AssertIslands("0 1", Build(2, [(0, Ground), (0, Ground), (1, 0)], slides: [true, false, false]).Islands);
    }

    // Two stones that stand, and two between them that hold each other: the first of them on a face that carries no load by itself.
    static readonly (int, int)[] archSupports = [(0, Ground), (3, Ground), (1, 0), (2, 1), (2, 3)];
    static readonly bool[] archLeans = [false, false, true, true, true];

    [Fact]
    public void What_leans_on_each_other_is_one_island()
    {
        var (islands, count) = Build(4, archSupports, leans: archLeans);
        Assert.Equal([0, 1, 2, 3], islands.Single().Order());
        Assert.Equal(5, count);
        // What rests on it rests on the ground.
        Assert.Equal([0, 1, 2, 3, 4], Build(5, [.. archSupports, (4, 2)], leans: [.. archLeans, false]).Islands.Single().Order());
    }

    [Fact]
    public void Nothing_leans_of_which_something_is_not_known()
    {
        for (int spoilt = 0; spoilt < 4; ++spoilt)
            AssertIslands("0, 3", Build(4, archSupports, leans: archLeans, spoilt: spoilt).Islands);
        Assert.Equal(2, Build(5, [.. archSupports, (4, Ground)], leans: [.. archLeans, false], spoilt: 4).Islands.Length);
    }

    [Fact]
    public void What_slides_on_all_that_it_leans_on_is_not_in_the_graph() =>
        AssertIslands("0, 3", Build(4, archSupports, leans: archLeans, slides: [false, false, true, true, true]).Islands);

    [Fact]
    public void Boxes_side_by_side_do_not_lean() =>
        AssertIslands("0, 1", Build(2, [(0, Ground), (1, Ground), (0, 1)], leans: [false, false, true]).Islands);

    [Theory, InlineData(64, 1), InlineData(65, 0)]
    public void Great_islands_do_not_lean(int bodyCount, int expected)
    {
        var supports = Enumerable.Range(0, bodyCount - 1).Select(body => (Upper: body + 1, Lower: body)).Prepend((Upper: 0, Lower: Ground)).ToArray();
        Assert.Equal(expected, Build(bodyCount, supports, leans: [.. Enumerable.Repeat(true, bodyCount)]).Islands.Length);
    }

    /// <summary>Column or not: one on the other, whatever of them sways, up to a number of them.</summary>
    [Fact]
    public void A_column_sways_as_one()
    {
        AssertIslands("0 1 2", Build(3, [(0, Ground), (1, 0), (2, 1)], sways: [false, true, false]).Islands);
        Assert.Equal([0, 1, 2], Build(3, [(2, 1), (1, 0), (0, Ground)], sways: [false, false, true]).Islands.Single().Order());
    }

    /// <summary>What leans on a column that sways does not take bodies out of it: each of them has its one support.</summary>
    [Fact]
    public void Nothing_leans_on_what_sways()
    {
        bool[] leans = [false, false, true], sways = [false, true, false];
        var (islands, count) = Build(3, [(0, Ground), (1, 0), (2, 1)], leans: leans, sways: sways);
        AssertIslands("0 1", islands);
        Assert.Equal(2, count);
        AssertIslands("0 1", Build(3, [(0, Ground), (1, 0), (1, 2)], leans: leans, sways: sways).Islands);
        // Two on one, which is a structure.
        AssertIslands("0 1 2", Build(4, [(0, Ground), (1, 0), (2, 0), (3, 1)], leans: [.. leans[..2], false, true], sways: [false, true, true, false]).Islands);
    }

    /// <summary>Two on one, one on two, and what stands on that; from the ground upwards, whatever rests there already.</summary>
    [Fact]
    public void A_structure_sways_as_one()
    {
        AssertIslands("0 1 2", Build(3, [(0, Ground), (1, 0), (2, 0)], sways: [false, true, true]).Islands);
        AssertIslands("0 1 2", Build(3, [(0, Ground), (1, Ground), (2, 0), (2, 1)], sways: [false, false, true, true]).Islands);
        AssertIslands("0 3 2 1", Build(4, [(2, 0), (2, 3), (0, Ground), (3, Ground), (1, 2)], sways: [true, true, true, false, false]).Islands);
        // What is not connected stays where it was.
        AssertIslands("0, 1 2 3", Build(4, [(0, Ground), (1, Ground), (2, 1), (3, 1)], sways: [false, false, true, true]).Islands);
    }

    /// <summary>It does not where it is not balanced, where it stands on two floors, in a circle, or on who knows what.</summary>
    [Fact]
    public void What_may_fall_over_is_no_structure()
    {
        (int, int)[] supports = [(0, Ground), (1, Ground), (2, 0), (2, 1)];
        bool[] sways = [true, true, true, true];
        AssertIslands("0 1 2", Build(3, supports, sways: sways).Islands);
        AssertIslands("", Build(3, supports, sways: sways, isBalanced: false).Islands);
        // On edges it does, and may rock, where there are three contacts to a body: eight to three are too few, and eighteen to six are enough.
        AssertIslands("", Build(3, supports, sways: sways, contacts: 2).Islands);
        (int, int)[] more = [.. supports, (3, Ground), (4, 1), (4, 3), (5, 2), (5, 4)];
        AssertIslands("0 1 3 2 4 5", Build(6, more, sways: [.. sways, .. sways, true], contacts: 2).Islands);
        AssertIslands("", Build(3, [(0, Ground), (1, SupportLink.Floor(3)), (2, 0), (2, 1)], sways: sways).Islands);
        AssertIslands("", Build(4, [(0, Ground), (1, 0), (1, 3), (2, 1), (3, 2)], sways: [true, true, true, true, true]).Islands);
        // Nothing is known of what the last one stands on.
        AssertIslands("", Build(4, [.. supports, (2, 3)], sways: [.. sways, true]).Islands);
    }

    /// <summary>What moves too fast is on top, and left out; but it carries nothing.</summary>
    [Fact]
    public void What_is_fast_is_on_top_of_a_structure()
    {
        (int, int)[] supports = [(0, Ground), (1, Ground), (2, 0), (2, 1)];
        bool[] sways = [true, true, true, true];
        AssertIslands("0 1 2", Build(4, [.. supports, (3, 2)], sways: [.. sways, true], fast: 3).Islands);
        AssertIslands("", Build(3, supports, sways: sways, fast: 1).Islands);
        AssertIslands("", Build(5, [(0, Ground), (1, 0), (2, 0), (3, 1), (3, 2), (4, 3)], sways: [true, true, true, true, true, true], fast: 1).Islands);
    }

    /// <summary>What is hit is let go with all that sways with it; what rests below stays held.</summary>
    [Fact]
    public void What_is_hit_does_not_sway()
    {
        AssertIslands("0", Build(3, [(0, Ground), (1, 0), (2, 1)], sways: [false, true, true], hit: 2).Islands);
        AssertIslands("", Build(3, [(0, Ground), (1, 0), (2, 1)], sways: [true, true, true], hit: 0).Islands);
        (int, int)[] supports = [(0, Ground), (1, Ground), (2, 0), (2, 1)];
        for (int body = 0; body < 3; ++body)
            AssertIslands("", Build(3, supports, sways: [true, true, true, true], hit: body).Islands);
        AssertIslands("0 1 2", Build(4, [.. supports, (3, Ground)], sways: [true, true, true, true, true], hit: 3).Islands);
        // What rests is no concern of it.
        AssertIslands("0 1 2", Build(3, [(0, Ground), (1, 0), (2, 1)], hit: 1).Islands);
    }

    [Theory, InlineData(SupportGraph.MaximumStructure, 1), InlineData(SupportGraph.MaximumStructure + 1, 0)]
    public void A_great_structure_does_not_sway(int bodyCount, int expected)
    {
        // A broad base, and pairs on it.
        var supports = Enumerable.Range(1, bodyCount - 1).Select(body => (Upper: body, Lower: (body - 1) / 2)).Prepend((Upper: 0, Lower: Ground)).ToArray();
        Assert.Equal(expected, Build(bodyCount, supports, sways: [.. Enumerable.Repeat(true, bodyCount)]).Islands.Length);
    }

    [Theory, InlineData(SupportGraph.MaximumSupports, 1), InlineData(SupportGraph.MaximumSupports + 1, 0)]
    public void What_lies_on_too_many_is_no_structure(int supportCount, int expected)
    {
        var feet = Enumerable.Range(0, supportCount).ToArray();
        var supports = feet.Select(foot => (foot, Ground)).Concat(feet.Select(foot => (supportCount, foot))).ToArray();
        Assert.Equal(expected, Build(supportCount + 1, supports, sways: [.. Enumerable.Repeat(true, supports.Length)]).Islands.Length);
    }

    /// <summary>With faces that were not held it sways where all of it is balanced; else what is below them does, if what is on them does not rest.</summary>
    [Fact]
    public void What_was_not_held_sways_where_it_is_balanced()
    {
        (int, int)[] supports = [(0, Ground), (1, 0), (2, 1)];
        AssertIslands("0 1 2", Build(3, supports, sways: [true, true, true], held: [false, false, false]).Islands);
        AssertIslands("", Build(3, supports, sways: [true, true, true], held: [false, true, true], isBalanced: false).Islands);
        AssertIslands("0 1", Build(3, supports, sways: [true, true, true], held: [true, true, false], isBalanced: false).Islands);
        AssertIslands("0", Build(3, supports, sways: [false, true, true], held: [true, false, true], isBalanced: false).Islands);
    }

    /// <summary>What is too high for a column is a structure.</summary>
    [Theory, InlineData(128), InlineData(129)]
    public void A_great_column_sways_as_one(int bodyCount)
    {
        var supports = Enumerable.Range(0, bodyCount - 1).Select(body => (Upper: body + 1, Lower: body)).Prepend((Upper: 0, Lower: Ground)).ToArray();
        var island = Assert.Single(Build(bodyCount, supports, sways: [.. Enumerable.Repeat(true, bodyCount)]).Islands);
        Assert.Equal(Enumerable.Range(0, bodyCount), island);
    }

    // Three planks of which each lies on the next: the lowest is taken first, and what it lies on itself is left out.
    [Fact]
    public void A_circle_is_cut_at_its_lowest_body()
    {
        var (islands, count) = Build(3, [(0, 1), (1, 2), (2, 0), (0, Ground), (1, Ground), (2, Ground)], [3, 1, 2]);
        AssertIslands("1 0 2", islands);
        Assert.Equal(5, count);
    }

    [Fact]
    public void Random_graphs_are_ordered()
    {
        var random = new Random(7);
        for (int sample = 0; sample < 200; ++sample)
        {
            var bodyCount = 1 + random.Next(30);
            var supports = Enumerable.Range(0, random.Next(60)).Select(_ => (Upper: random.Next(bodyCount), Lower: random.Next(-1, bodyCount)))
                .Where(support => support.Upper != support.Lower).ToArray();
            var heights = Enumerable.Range(0, bodyCount).Select(_ => random.NextSingle()).ToArray();
            var (islands, _) = Build(bodyCount, supports, heights);
            var all = islands.SelectMany(island => island).ToArray();
            Assert.Equal(all.Length, all.Distinct().Count());
            // What rests on the ground itself is always in; what is in rests on the ground, or on something earlier in its island.
            Assert.All(supports.Where(support => support.Lower == Ground), support => Assert.Contains(support.Upper, all));
            foreach (var island in islands)
            {
                for (int i = 0; i < island.Length; ++i)
                {
                    var earlier = island[..i];
                    Assert.Contains(supports, support => support.Upper == island[i] && (support.Lower == Ground || earlier.Contains(support.Lower)));
                }
            }
        }
    }

    /// <summary>
    /// A graph that has been built of other supports before, or of the same, is as one that is new: in 400 steps of which most change one thing at most,
    /// a support's ends, its number of contacts, whether it slides, heights, where the pieces end, or the number of bodies.
    /// </summary>
    [Theory]
    [InlineData(1, true), InlineData(2, true), InlineData(3, false)]
    public unsafe void A_graph_that_was_built_before_is_as_a_new_one(int seed, bool hasCircles)
    {
        using var pool = new BufferPool();
        var random = new Random(seed);
        var links = new SupportLink[40];
        for (int i = 0; i < links.Length; ++i)
            links[i] = RandomLink(random, 20, hasCircles);
        var heights = new float[30];
        int bodyCount = 20, half = 20, same = 0;
        pool.Take<byte>(30, out var spoilt);
        spoilt.Clear(0, 30);
        SupportGraph kept = default;
        string last = "";
        for (int step = 0; step < 400; ++step)
        {
            switch (random.Next(10))
            {
                case 0:
                    links[random.Next(links.Length)] = RandomLink(random, 20, hasCircles);
                    break;
                case 1:
                    ref var counted = ref links[random.Next(links.Length)];
                    counted.Count = (byte)(5 - counted.Count);
                    break;
                case 2:
                    ref var sliding = ref links[random.Next(links.Length)];
                    sliding.Slides = !sliding.Slides;
                    break;
                case 3:
                    heights[random.Next(20)] = random.NextSingle();
                    break;
                case 4:
                    half = random.Next(1, links.Length);
                    break;
                case 5:
                    bodyCount = 50 - bodyCount;
                    break;
                case 6:
                    ref var leaning = ref links[random.Next(links.Length)];
                    leaning.Leans = !leaning.Leans;
                    break;
                case 7:
                    var body = random.Next(20);
                    spoilt[body] = (byte)(1 - spoilt[body]);
                    break;
                case 8:
                    ref var swaying = ref links[random.Next(links.Length)];
                    swaying.IsWhole = swaying.Sways = !swaying.Sways;
                    swaying.WasHeld = random.Next(2) > 0;
                    break;
            }
            var found = new SupportLink[links.Length + Gap];
            links.AsSpan(0, half).CopyTo(found);
            links.AsSpan(half).CopyTo(found.AsSpan(half + Gap));
            SupportGraph fresh = default;
            fixed (SupportLink* memory = found)
            {
                (int, int)[] pieces = [(0, half), (half + Gap, links.Length - half)];
                BuildAndFill(ref fresh, memory, pieces, bodyCount, spoilt, heights, pool);
                BuildAndFill(ref kept, memory, pieces, bodyCount, spoilt, heights, pool);
            }
            var expected = Describe(fresh, bodyCount);
            Assert.Equal(expected, Describe(kept, bodyCount));
            same += expected == last ? 1 : 0;
            last = expected;
            fresh.Dispose(pool);
        }
        Assert.InRange(same, 100, 390);
        kept.Dispose(pool);
        pool.Return(ref spoilt);
        pool.AssertEmpty();
    }

    static SupportLink RandomLink(Random random, int bodyCount, bool hasCircles)
    {
        var upper = random.Next(bodyCount);
        var lower = random.Next(-3, hasCircles ? bodyCount : upper);
        return new() { Upper = upper, Lower = lower == upper ? Ground : Math.Max(Ground, lower), Count = (byte)random.Next(2, 4), Radius = 1 };
    }

    static unsafe void BuildAndFill(
        ref SupportGraph graph, SupportLink* found, (int, int)[] pieces, int bodyCount, Buffer<byte> spoilt, float[] heights, BufferPool pool)
    {
        graph.Build(found, pieces, bodyCount, spoilt, new Heights(heights), pool);
        graph.Fill(found, 0, graph.Nodes.Count);
        // What a step does to nodes.
        for (int i = 0; i < graph.Nodes.Count; ++i)
        {
            Assert.False(graph.Nodes[i].HasLoad || graph.Nodes[i].IsActive || graph.Nodes[i].NeedsWork);
            Assert.Equal(default, graph.Nodes[i].Linear + graph.Nodes[i].Angular);
            ref var node = ref graph.Nodes[i];
            node.HasLoad = node.IsActive = node.NeedsWork = true;
            node.Radius += 1;
            node.Linear = node.Angular = new(1, 2, 3);
        }
    }

    static string Describe(in SupportGraph graph, int bodyCount)
    {
        var lines = new System.Text.StringBuilder();
        foreach (var island in graph.Islands)
            lines.Append(island).Append(' ');
        for (int i = 0; i < bodyCount; ++i)
            lines.Append(graph.NodeOf[i]).Append(',');
        foreach (ref var node in graph.Nodes.AsSpan())
        {
            lines.Append($"|{node.Body} {node.Floor} {node.FirstSupport} {node.SupportCount} {node.Radius} {node.Leans} {node.IsRelaxed}");
            lines.Append($" {node.IsOfColumn} {node.MayBeColumn}");
        }
        foreach (ref var link in graph.Links.AsSpan())
            lines.Append($"|{link.Upper} {link.Lower} {link.Count} {link.Slides}");
        return lines.ToString();
    }
}
