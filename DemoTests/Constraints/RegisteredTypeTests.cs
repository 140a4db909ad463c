using System;
using System.Collections.Generic;
using System.Linq;
using BepuPhysics.Constraints;
using DemoTests.Accuracy;
using Xunit;

namespace DemoTests.Constraints;

/// <summary>Every constraint type of the library is in every suite: one that was forgotten is named here.</summary>
public class RegisteredTypeTests
{
    static string[] Joints => [.. RandomDescriptions.TypeIds.Where(id => id >= ConstraintTypeIds.ContactTypeCount).Select(RandomDescriptions.NameOf)];

    public static TheoryData<int> JointIds => new(RandomDescriptions.TypeIds.Where(id => id >= ConstraintTypeIds.ContactTypeCount));

    [Fact]
    public void Every_description_is_registered() =>
        AssertNone(RandomDescriptions.Descriptions.Values.Select(type => type.Name).Except(Joints), "not registered in DefaultTypes");

    [Fact]
    public void Every_joint_has_its_definition_in_doubles()
    {
        var tested = typeof(RegisteredTypeTests).Assembly.GetTypes().Where(type => !type.IsAbstract)
            .Select(DescriptionOf).OfType<Type>().Select(type => type.Name);
        AssertNone(Joints.Except(tested), "without a class that derives from JointTests or MotorTests");

        static Type? DescriptionOf(Type? type)
        {
            for (; type is not null; type = type.BaseType)
            {
                if (type.IsGenericType && type.GetGenericTypeDefinition() == typeof(JointTests<>))
                    return type.GetGenericArguments()[0];
            }
            return null;
        }
    }

    [Fact]
    public void Every_joint_has_bad_input()
    {
        var list = new BadInputList();
        BadSolverInput.AddTo(list);
        AssertNone(
            Joints.Where(name => !list.Cases.Keys.Any(key => key.StartsWith($"Solver.Add({name}),", StringComparison.Ordinal))), "not in BadSolverInput");
    }

    /// <summary>The suites that need nothing per type: rows, purity of lanes. InliningTests asks the same list.</summary>
    [Fact]
    public void Every_type_is_in_the_suites_that_go_over_types()
    {
        AssertNone(Missing(KernelPurityTests.Types()), "not in KernelPurityTests");
        AssertNone(Missing(RowTests.Types), "not in RowTests");
        var samples = new JointSamples(1);
        foreach (var id in RandomDescriptions.TypeIds)
        {
            using var bench = RowBench.New(id, samples);
            Assert.True(bench.RowCount > 0, $"{RandomDescriptions.NameOf(id)} has no rows.");
        }

        static string[] Missing(TheoryData<int> ids) =>
            [.. RandomDescriptions.TypeIds.Except(((IEnumerable<object[]>)ids).Select(row => (int)row[0])).Select(RandomDescriptions.NameOf)];
    }

    [Theory, MemberData(nameof(JointIds))]
    public void No_field_of_a_description_may_be_no_number(int typeId)
    {
        var type = RandomDescriptions.Descriptions[typeId];
        var samples = new JointSamples(typeId);
        for (int i = 0; i < 10; ++i)
        {
            var column = RandomDescriptions.Joint(type, samples);
            for (int field = 0; field < column.Length; ++field)
            {
                var bad = (float[])column.Clone();
                bad[field] = float.NaN;
                Assert.False(RandomDescriptions.Accepts(type, bad), $"{type.Name} takes NaN as its number {field}.");
            }
        }
    }

    static void AssertNone(IEnumerable<string> names, string what)
    {
        var list = string.Join(", ", names);
        Assert.True(list.Length == 0, $"{list}: {what}.");
    }
}
