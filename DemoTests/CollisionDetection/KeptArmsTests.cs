using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.Running;
using DemoTests.Scenes;
using Xunit;

namespace DemoTests.CollisionDetection;

/// <summary>What a contact constraint keeps of the last step: arms, impulses and places, and when it does not.</summary>
public sealed class KeptArmsTests : IDisposable
{
    const float Half = .5f;
    // Less than a twentieth of an arm, which is .87 m long.
    const float Little = .02f;
    const float Much = .1f;
    static readonly PairMaterialProperties material = new(.5f, 2, default);
    readonly TestWorld world = new(new AccuracySettings { LoadPath = LoadPathChoice.Off });
    readonly BodyHandle lower;
    readonly BodyHandle upper;

    public KeptArmsTests()
    {
        world.AddStatic(new Box(20, 2, 20), new Vector3(0, -1, 0));
        lower = world.AddDynamic(new Box(1, 1, 1), 1, new Vector3(0, Half, 0));
        upper = world.AddDynamic(new Box(1, 1, 1), 1, new Vector3(0, 3 * Half, 0));
        world.Step(60);
    }

    public void Dispose()
    {
        world.Simulation.Validate();
        world.Dispose();
    }

    [Fact]
    public void Contacts_that_have_hardly_moved_keep_their_arms_and_impulses_and_get_new_depths()
    {
        var before = Read();
        Update(before, Moved(before, new Vector3(Little, 0, -Little), depth: .003f));
        var after = Read();
        for (int i = 0; i < 4; ++i)
        {
            Assert.Equal(before.Arms[i], after.Arms[i]);
            Assert.Equal(before.Normals[i], after.Normals[i]);
            Assert.Equal(.003f, Depth(i));
        }
        Assert.Equal(before.OffsetB, after.OffsetB);
        Assert.True(before.Normals[0] > 0);
    }

    [Fact]
    public void Contacts_that_have_moved_get_new_arms()
    {
        var before = Read();
        var manifold = Moved(before, new Vector3(Much, 0, 0));
        Update(before, manifold);
        var after = Read();
        for (int i = 0; i < 4; ++i)
            Assert.Equal(manifold[i].Offset, after.Arms[i]);
        Assert.Equal(manifold.OffsetB, after.OffsetB);
    }

    /// <summary>They are where they were about A, and elsewhere about B.</summary>
    [Fact]
    public void The_arms_about_both_bodies_count()
    {
        var before = Read();
        var manifold = Moved(before, new Vector3(.001f, 0, 0));
        manifold.OffsetB += new Vector3(Much, 0, 0);
        Update(before, manifold);
        Assert.Equal(manifold[0].Offset, Read().Arms[0]);
    }

    /// <summary>A contact that is close to the centre of B has a short arm there, and has moved by more than a twentieth of it.</summary>
    [Fact]
    public void The_shorter_of_the_two_arms_counts()
    {
        var manifold = Moved(Read(), default);
        manifold.OffsetB = .9f * manifold.Contact0.Offset;
        Update(Read(), manifold);
        var before = Read();
        Assert.Equal(manifold.OffsetB, before.OffsetB);
        manifold.Contact0.Offset.X += Little;
        Update(before, manifold);
        Assert.Equal(manifold.Contact0.Offset, Read().Arms[0]);
        Assert.Equal(before.Arms[1], Read().Arms[1]);
    }

    /// <summary>Where its centre is says nothing of a static: the same floor may be one box or a hundred.</summary>
    [Fact]
    public void The_centre_of_a_static_does_not_count()
    {
        var before = Read(pair: 0);
        Assert.False(before.KnowsB);
        var manifold = Moved(before, new Vector3(.001f, 0, 0));
        manifold.OffsetB += new Vector3(Much, 0, 0);
        Update(before, manifold, pair: 0);
        Assert.Equal(before.Arms[0], Read(pair: 0).Arms[0]);
    }

    [Fact]
    public void A_patch_that_opens_gets_new_arms()
    {
        var before = Read();
        var manifold = Moved(before, new Vector3(Little, 0, 0));
        manifold.Contact2.Depth = -1e-6f;
        Update(before, manifold);
        // Of what is apart the arm ends at the surface of A.
        for (int i = 0; i < 4; ++i)
            Assert.Equal(manifold[i].Offset - manifold.Normal * (.5f * MathF.Min(0, manifold[i].Depth)), Read().Arms[i]);
    }

    [Theory]
    [InlineData(9, true)]
    [InlineData(11, false)]
    public void A_patch_whose_normal_turns_far_gets_new_arms(double degrees, bool isKept)
    {
        var before = Read();
        var manifold = Moved(before, new Vector3(Little, 0, 0));
        var (sine, cosine) = Math.SinCos(degrees * Math.PI / 180);
        manifold.Normal = before.Normal.Y * new Vector3((float)sine, (float)cosine, 0);
        Update(before, manifold);
        Assert.Equal(isKept ? before.Arms[0] : manifold[0].Offset, Read().Arms[0]);
        Assert.Equal(manifold.Normal, Read().Normal);
    }

    /// <summary>Depths and features go to the places of their contacts, whose order does not change.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Contacts_in_another_order_are_found_by_feature_or_by_place(bool areRenamed)
    {
        var before = Read();
        var moved = Moved(before, new Vector3(.001f, 0, 0));
        var manifold = moved;
        int[] order = [2, 0, 3, 1];
        for (int i = 0; i < 4; ++i)
        {
            manifold[i] = moved[order[i]] with
            {
                Depth = .001f * (1 + i),
                FeatureId = areRenamed ? 7000 + i : before.Features[order[i]],
            };
        }
        Update(before, manifold);
        var after = Read();
        for (int i = 0; i < 4; ++i)
        {
            Assert.Equal(before.Arms[order[i]], after.Arms[order[i]]);
            Assert.Equal(before.Normals[order[i]], after.Normals[order[i]]);
            Assert.Equal(.001f * (1 + i), Depth(order[i]));
            Assert.Equal(areRenamed ? 7000 + i : before.Features[order[i]], after.Features[order[i]]);
        }
    }

    /// <summary>The others keep theirs, and the new one is as they were when they got theirs.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    public void Contacts_that_are_elsewhere_get_new_arms_less_the_drift_of_the_others(int elsewhere)
    {
        var before = Read();
        var drift = new Vector3(Little, .001f, -Little);
        var manifold = Moved(before, drift);
        for (int i = 0; i < elsewhere; ++i)
            manifold[i] = manifold[i] with { Offset = before.Arms[i] * new Vector3(.7f, 1, 1) + drift, FeatureId = 7000 + i };
        Update(before, manifold);
        var after = Read();
        for (int i = 0; i < 4; ++i)
        {
            var arm = i < elsewhere ? before.Arms[i] * new Vector3(.7f, 1, 1) : before.Arms[i];
            Assert.Equal(0, (after.Arms[i] - arm).Length(), 6);
            Assert.Equal(before.Normals[i], after.Normals[i]);
        }
        Assert.Equal(before.OffsetB, after.OffsetB);
    }

    /// <summary>The place that is nearest to both has room for one.</summary>
    [Fact]
    public void Two_contacts_that_are_elsewhere_take_two_places()
    {
        var before = Read();
        var manifold = Moved(before, default);
        manifold.Contact0.Offset = before.Arms[0] * new Vector3(.7f, 1, 1);
        manifold.Contact1.Offset = before.Arms[0] * new Vector3(.8f, 1, 1);
        Update(before, manifold);
        var after = Read();
        Assert.Equal(manifold.Contact0.Offset, after.Arms[0]);
        Assert.Equal(manifold.Contact1.Offset, after.Arms[1]);
    }

    [Fact]
    public void One_contact_alone_keeps_no_patch()
    {
        var before = Read();
        var manifold = Moved(before, new Vector3(Little, 0, 0));
        for (int i = 0; i < 3; ++i)
            manifold[i] = manifold[i] with { Offset = before.Arms[i] * new Vector3(.7f, 1, 1) };
        Update(before, manifold);
        Assert.Equal(manifold[3].Offset, Read().Arms[3]);
    }

    [Fact]
    public void The_force_of_a_patch_points_where_it_did_while_its_normal_turns()
    {
        var before = Read();
        var manifold = Moved(before, default);
        manifold.Normal = Vector3.Normalize(before.Normal + new Vector3(.01f, 0, .02f));
        Update(before, manifold);
        var after = Read();
        var was = before.Normal * Load(before) + before.Friction;
        var now = after.Normal * Load(after) + after.Friction;
        // To the square of the angle.
        Assert.Equal(0, (now - was).Length() / Load(before), 3);
        Assert.Equal(0, Vector3.Dot(after.Friction, after.Normal), 6);
    }

    [Fact]
    public void A_changed_material_takes_effect_at_once()
    {
        var before = Read();
        new ContactConstraint(world.Solver, Manifold().Constraint, 4)
            .Update(Moved(before, default), new PairMaterialProperties(.25f, 7, new SpringSettings(15, .5f)), default, ref Manifold().Features);
        Assert.Equal(before.Arms[0], Read().Arms[0]);
        Assert.Equal([.25f, new SpringSettings(15, .5f).AngularFrequency, 1, 7], [Material(0), Material(1), Material(2), Material(3)]);
    }

    /// <summary>By the narrow phase: the constraint of three contacts is another one, of another type.</summary>
    [Fact]
    public void Arms_go_over_to_a_constraint_of_another_number_of_contacts()
    {
        var before = Read();
        var manifold = Moved(before, new Vector3(Little, 0, 0));
        manifold.Count = 3;
        manifold.OffsetB += new Vector3(Little, 0, 0);
        Replace(ref before, manifold);
        var after = Read();
        Assert.Equal(3, after.Count);
        for (int i = 0; i < 3; ++i)
            Assert.Equal(before.Arms[i], after.Arms[i]);
        Assert.Equal(before.OffsetB, after.OffsetB);
        Assert.Equal(Load(before), Load(after), 4);
        manifold.Count = 4;
        Replace(ref after, manifold);
        var last = Read();
        // The fourth had none in between: its own, less the drift.
        for (int i = 0; i < 4; ++i)
            Assert.Equal(0, (before.Arms[i] - last.Arms[i]).Length(), 6);
    }

    /// <summary>What the load path held touches within twice its band, which is a thousandth of the half metre from a centre to the contacts.</summary>
    [Theory]
    [InlineData(true, -9e-4f, true)]
    [InlineData(true, -1.1e-3f, false)]
    [InlineData(false, -9e-4f, false)]
    [InlineData(false, 1e-4f, true)]
    public void What_was_held_touches_within_its_band(bool wasHeld, float depth, bool isKept)
    {
        var before = Read();
        Material(1) = wasHeld ? -0f : 0;
        Update(before, Moved(before, new Vector3(Little, 0, 0), depth));
        Assert.Equal(isKept, before.Arms[0] == Read().Arms[0]);
        Assert.False(float.IsNegative(Material(1)));
        // The same where the constraint is another one.
        before.WasHeld = wasHeld;
        var manifold = Moved(before, new Vector3(-Little, 0, 0), depth);
        manifold.Count = 3;
        Replace(ref before, manifold);
        Assert.Equal(isKept, before.Arms[0] == Read().Arms[0]);
    }

    /// <summary>What a step does, with a body that was put elsewhere between two steps.</summary>
    [Theory]
    [InlineData(Little, true)]
    [InlineData(Much, false)]
    public void A_pose_that_a_game_writes_is_kept_arms_only_where_it_is_hardly_another(float way, bool isKept)
    {
        var before = Read();
        world.Bodies[upper].Pose.Position.X += way;
        world.Step();
        Assert.Equal(isKept, before.Arms[0] == Read().Arms[0]);
        Assert.Equal(isKept, before.OffsetB == Read().OffsetB);
    }

    [Fact]
    public void Bodies_that_are_put_elsewhere_together_keep_their_arms()
    {
        var before = Read();
        foreach (var body in new[] { lower, upper })
            world.Bodies[body].Pose.Position += new Vector3(4, 0, 4);
        world.Step();
        Assert.Equal(before.Arms[0], Read().Arms[0]);
    }

    ref CachedManifold Manifold(int pair = 1) => ref world.Simulation.NarrowPhase.Pairs.Pairs.Values[Index(pair)].Single;

    // 0 is that of the floor.
    int Index(int pair)
    {
        ref var pairs = ref world.Simulation.NarrowPhase.Pairs.Pairs;
        for (int i = 0; i < pairs.Count; ++i)
        {
            if ((pairs.Keys[i].B.Mobility == CollidableMobility.Static) == (pair == 0))
                return i;
        }
        throw new InvalidOperationException("There is no such pair.");
    }

    ContactConstraint Constraint(int pair = 1) =>
        new(world.Solver, Manifold(pair).Constraint, ConstraintTypeIds.ContactCount(Manifold(pair).ConstraintTypeId));

    ContactPatch Read(int pair = 1)
    {
        Constraint(pair).ReadPatch(Manifold(pair).Features, out var patch);
        return patch;
    }

    void Update(in ContactPatch before, in ConvexContactManifold manifold, int pair = 1)
    {
        Assert.Equal(4, before.Count);
        Constraint(pair).Update(manifold, material, default, ref Manifold(pair).Features);
    }

    // As the flush of the narrow phase does.
    void Replace(ref ContactPatch before, in ConvexContactManifold manifold)
    {
        ref var cached = ref Manifold();
        world.Solver.RemoveWithoutNotice(cached.Constraint);
        cached.ConstraintTypeId = ConstraintTypeIds.ConvexContact(manifold.Count, 2);
        var old = cached.Constraint;
        cached.Constraint = world.Solver.AddUnwritten([lower, upper], cached.ConstraintTypeId);
        Assert.Equal(old.Slot, cached.Constraint.Slot);
        Constraint().WriteNew(ref before, manifold, material, default, ref cached.Features);
    }

    // The contacts of a patch after the patch has moved about both bodies.
    static ConvexContactManifold Moved(in ContactPatch patch, Vector3 way, float depth = .001f)
    {
        var manifold = new ConvexContactManifold { Count = patch.Count, OffsetB = patch.OffsetB, Normal = patch.Normal };
        for (int i = 0; i < patch.Count; ++i)
            manifold[i] = new Contact { Offset = patch.Arms[i] + way, Depth = depth, FeatureId = patch.Features[i], Normal = patch.Normal };
        return manifold;
    }

    static float Load(in ContactPatch patch)
    {
        float load = 0;
        for (int i = 0; i < patch.Count; ++i)
            load += patch.Normals[i];
        return load;
    }

    float Depth(int contact) => PrestepFloat(contact * 4 + 3);

    // Of four contacts: friction, frequency, damping, recovery.
    ref float Material(int field) => ref PrestepFloat(22 + field);

    ref float PrestepFloat(int field)
    {
        ref var location = ref world.Solver.Locations[Manifold().Constraint.Slot];
        return ref world.Solver.Processor(location.TypeId).PrestepFloat(ref world.Solver.TypeBatchAt(location), location.IndexInTypeBatch, field);
    }
}
