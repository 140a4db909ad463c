using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;
using BepuPhysics;
using BepuUtilities;
using DemoTests.Quality;
using Xunit;

namespace DemoTests.Compatibility;

/// <summary>Docs/Migration.md says nothing that is not so: each of its rows has a test, and each of its names exists, or does not.</summary>
public partial class MigrationPageTests
{
    const string Page = "Docs/Migration.md";

    // What shows that a row is true, by the words that the row begins with.
    static readonly Dictionary<string, string> tests = new()
    {
        ["set.DynamicsState[i]"] = "SmallNamesTests.Dynamics_of_a_set_are_read_and_written_as_where_they_lie_in_one_place",
        ["ref var dynamics"] = "BodyReferenceTests.Dynamics_are_the_bodys_own",
        ["sweeps: their samples in time"] = "RecordedHashTests.The_hash_of_a_scene_is_what_it_was",
        ["sweeps against triangles"] = "SweepTests.Triangles_are_hit_from_their_fronts",
        ["sweeps that begin where shapes touch"] = "SweepTests.What_touches_and_leaves_or_slides_hits_nothing",
        ["hitLocation"] = "SweepTests.A_box_hits_the_ground_with_its_lowest_corner",
        ["minimumProgression"] = "SweepTests.The_parameters_of_accuracy_do_what_they_say",
        ["profiler"] = "MigrationTests.Stages_are_timed",
        ["constraint descriptions"] = "SmallNamesTests.A_description_need_not_check_itself_and_is_not_boxed",
        ["four type processors"] = "DocSamplesTests.Code_of_a_page_is_among_the_samples",
        ["pair testers"] = "DocSamplesTests.Code_of_a_page_is_among_the_samples",
        ["narrow phase callbacks"] = "MigrationTests.Ready_made_callbacks_do_not_collide_with_those_of_games",
        ["the callbacks about children"] = "CarriedPatchTests.Children_are_looked_for_every_sixteen_steps_unless_callbacks_decide_on_them",
        ["Bodies.ActiveSet.Constraints"] = "BodyConstraintsTests.Constraints_are_listed_in_the_order_in_which_they_were_added",
        ["a body of Solver.Constrained"] = "MigrationTests.Kinematic_bodies_with_constraints_are_found",
        ["batcher.CacheShapeB"] = "SmallNamesTests.A_cached_shape_is_added_directly",
        ["the constraints of the character"] = "CharacterWalkTests.It_goes_round_with_a_turning_platform",
        ["default(SpringSettings)"] = "MigrationTests.Springs_without_a_frequency_are_rigid",
        ["a frequency above"] = "MigrationTests.Frequencies_are_capped",
        ["springs below critical damping"] = "SpringStepTests.It_swings_and_hangs_as_its_settings_say",
        ["AngularMotor."] = "MotorSceneTests.An_angular_motor_turns_A_against_B",
        ["bounces"] = "SurfaceCallbacksTests.Surfaces_bounce_pair_by_pair",
        ["friction of a patch"] = "SlopeTests.Case",
        ["friction of what slides and spins"] = "SlidingSpinTests.Case",
        ["Simulation.Deterministic"] = "MigrationTests.Switches_that_are_kept_for_callers_do_nothing",
        ["AllowSubsteps"] = "FreeBodyTests.A_throw_is_a_parabola",
        ["Simulation.Clear, Dispose"] = "MigrationTests.Shared_shapes_are_left_alone",
        ["a step of another length"] = "VariableTimestepTests.The_load_of_a_joint_follows_the_length_of_the_substep",
        ["ConvexHull"] = "ConvexHullCreationTests.CopiesAreTransformed",
        ["hulls of coplanar"] = "ConvexHullCreationTests.PointsWithoutVolumeAreRefusedWithAReason",
        ["Triangle"] = "MigrationTests.Triangles_have_one_side_unless_they_ask_for_two",
        ["new Mesh("] = "MeshBuildTests.The_buffer_of_triangles_goes_back_to_the_pool_and_each_triangle_keeps_its_number",
        ["a mesh with triangles"] = "MeshBuildTests.Triangles_without_a_surface_are_left_out_and_a_mesh_of_nothing_else_is_refused",
        ["Mesh.Scale"] = "MeshBuildTests",
        ["inertia of a mesh"] = "MeshInertiaTests.What_encloses_nothing_or_is_inside_out_has_no_closed_inertia",
        ["ContactEvents"] = "ContactEventHandlerTests",
        ["deep overlaps"] = "DepthSearchAccuracyTests",
        ["shapes without a size"] = "BadInputTests.X13_IsRefused",
        ["a game's own voxels"] = "VoxelMotionTests.What_falls_on_them_moves_as_on_a_compound_of_cubes",
        ["a game's own convex shape"] = "OwnConvexTests.A_cone_stands_on_its_base",
        ["a pair of shapes"] = "BatchingTests.UnregisteredPairIsRefusedByName",
        ["bad numbers"] = "BadInputTests.X13_IsRefused",
        ["handle.Value"] = "HandleGenerationTests.A_slot_is_given_out_again_under_another_value_and_is_found_by_it",
        ["new BodyHandle(i)"] = "HandleGenerationTests.A_slot_is_given_out_again_under_another_value_and_is_found_by_it",
        ["Bodies.HandleToLocation"] = "StaleHandleTests.Tables_and_indices_out_of_range_are_refused",
        ["references to bodies"] = "StaleHandleTests.A_reference_to_no_body_throws_in_every_member",
        ["CollidableProperty"] = "StaleHandleTests.A_handle_of_no_body_is_refused_everywhere",
        ["calls into the simulation"] = "LockMatrixTests.A_call_from_a_callback_works_or_is_refused",
        ["body.Collidable.Shape"] = "ShapeUseTests.Shapes_are_not_assigned",
        ["a shape is removed before"] = "ShapeUseTests.A_shape_may_be_removed_before_those_who_have_it",
        ["a shape is removed twice"] = "ShapeUseTests.A_shape_may_be_removed_before_those_who_have_it",
        ["values of a CollidableProperty"] = "CollidablePropertyTests.There_is_room_for_what_the_simulation_has_room_for",
        ["a step of more than"] = "LimitsTests.BeyondTheLimitsEachValueIsRefusedAndNothingChanges",
        ["ref var triangle"] = "GameCodeTests.Triangles_of_a_mesh_are_as_they_were_given",
        ["tree.RefitAndRefine"] = "GameCodeTests.A_tree_is_refitted_and_refined",
        ["a game's own RayHit"] = "GameCodeTests.A_name_that_a_game_has_too_is_chosen_by_an_alias",
        ["calls after Dispose"] = "EndOfWorldTests.Whatever_comes_after_Dispose_is_refused",
        ["BroadPhase.AddActive"] = "EndOfWorldTests.The_leaves_of_a_simulation_are_its_own",
        ["where bodies are that sleep"] = "WakeTests.All_wake_when_they_are_told_to",
        ["velocity of a body that falls asleep"] = "SleepTests.A_game_puts_an_island_to_sleep",
        ["ApplyImpulse"] = "WakeTests.Exactly_the_island_wakes_to_which_something_happens",
        ["StaticReference.UpdateBounds"] = "WakeTests.A_static_whose_pose_was_written_wakes_who_is_there_with_its_bounds",
        ["BodyDescription.GetDefaultActivity"] = "LargeSleeperTests.ALargeWheelGoesOnTurning",
        ["settings of the sleeper"] = "SleepTests.Everything_settles_and_nothing_that_is_fast_sleeps",
        ["number of bodies"] = "HandleGenerationTests.More_bodies_than_there_are_slots_are_refused",
    };

    [Fact]
    public void Every_row_has_a_test()
    {
        var known = typeof(MigrationPageTests).Assembly.GetTypes()
            .SelectMany(type => type.GetMethods().Where(method => method.IsDefined(typeof(FactAttribute), true)))
            .SelectMany(test => new[] { $"{test.DeclaringType!.Name}.{test.Name}", test.DeclaringType.Name }).ToHashSet();
        var used = new HashSet<string>();
        foreach (var row in Rows())
        {
            var key = tests.Keys.SingleOrDefault(start => row[0].StartsWith(start, StringComparison.Ordinal));
            Assert.True(key is not null, $"{Page} has a row without a test: {row[0]}");
            Assert.True(known.Contains(tests[key]), $"There is no test {tests[key]}.");
            used.Add(key);
        }
        Assert.Equal(tests.Keys.Order(), used.Order());
    }

    static IEnumerable<string[]> Rows() => DocPages.TableRows(Page).Where(row =>
        !row[0].StartsWith("---", StringComparison.Ordinal) && row[0] is not ("there" or "what"));

    // The last cell of a row speaks of this library.
    [Fact]
    public void Names_of_this_library_exist()
    {
        var names = RepositoryFiles.Read(Page).Split('\n').Where(line => line.StartsWith('|'))
            .Select(line => line.Trim().Trim('|').Split('|')[^1]).SelectMany(QualifiedNames).Distinct().ToArray();
        Assert.True(names.Length > 10);
        Assert.All(names, name => Assert.True(Exists(name, membersToo: true), $"There is no {name}."));
    }

    [Fact]
    public void Names_that_are_not_there_yet_are_not_there()
    {
        var section = RepositoryFiles.Read(Page).Split("## Not there yet")[1].Split("##")[0];
        var present = new List<string>();
        foreach (var line in section.Split("\n- ", StringSplitOptions.RemoveEmptyEntries))
        {
            // A line that is about what there is says so.
            if (!line.Contains("other than", StringComparison.Ordinal) && !line.Contains("behaves as", StringComparison.Ordinal))
                present.AddRange(QualifiedNames(line).Where(name => Exists(name, membersToo: false)));
        }
        Assert.Empty(present);
    }

    // The joints of bepuphysics2 by the ids that they have there.
    static readonly (int Id, string Name)[] joints =
    [
        (22, "BallSocket"), (23, "AngularHinge"), (24, "AngularSwivelHinge"), (25, "SwingLimit"), (26, "TwistServo"), (27, "TwistLimit"),
        (28, "TwistMotor"), (29, "AngularServo"), (30, "AngularMotor"), (31, "Weld"), (32, "VolumeConstraint"), (33, "DistanceServo"),
        (34, "DistanceLimit"), (35, "CenterDistanceConstraint"), (36, "AreaConstraint"), (37, "PointOnLineServo"), (38, "LinearAxisServo"),
        (39, "LinearAxisMotor"), (40, "LinearAxisLimit"), (41, "AngularAxisMotor"), (42, "OneBodyAngularServo"), (43, "OneBodyAngularMotor"),
        (44, "OneBodyLinearServo"), (45, "OneBodyLinearMotor"), (46, "SwivelHinge"), (47, "Hinge"), (52, "BallSocketMotor"),
        (53, "BallSocketServo"), (54, "AngularAxisGearMotor"), (55, "CenterDistanceLimit"),
    ];

    /// <summary>The page lists no joints as missing, so all of them are there, by their names and ids.</summary>
    [Fact]
    public void All_joints_are_there()
    {
        var here = typeof(Simulation).Assembly.GetExportedTypes().Where(type => type.IsValueType && type.GetInterfaces()
            .Any(contract => contract.Name.StartsWith("IConstraintDescription", StringComparison.Ordinal)));
        var ids = here.ToDictionary(type => type.Name, type => (int)type.GetProperty("ConstraintTypeId")!.GetValue(null)!);
        Assert.All(joints, joint => Assert.Equal(joint.Id, ids.GetValueOrDefault(joint.Name)));
    }

    static IEnumerable<string> QualifiedNames(string cell) => BacktickedNames().Matches(cell).Select(match => match.Groups["name"].Value)
        .Where(name => char.IsUpper(name[0]));

    // A name by itself is a type, or a member of what the row is about.
    static bool Exists(string name, bool membersToo)
    {
        var types = typeof(Simulation).Assembly.GetExportedTypes().Concat(typeof(BoundingBox).Assembly.GetExportedTypes())
            .Append(typeof(ArgumentException)).Append(typeof(InvalidOperationException)).Append(typeof(ObjectDisposedException)).ToArray();
        var parts = name.Split('.');
        return parts.Length == 1
            ? types.Any(type => Bare(type) == name || (membersToo && HasMember(type, name)))
            : types.Any(type => Bare(type) == parts[^2] && HasMember(type, parts[^1]));
    }

    static bool HasMember(Type type, string name) =>
        type.GetMember(name, BindingFlags.Public | BindingFlags.Instance | BindingFlags.Static).Length > 0;

    static string Bare(Type type) => type.Name.Split('`')[0];

    [GeneratedRegex(@"`(?<name>[\w.]+)(?:<[^`]*>)?`")]
    private static partial Regex BacktickedNames();
}
