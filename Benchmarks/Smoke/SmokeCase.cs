using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Reflection;
using BenchmarkDotNet.Attributes;

namespace Benchmarks.Smoke;

/// <summary>One benchmark method with one choice of its parameters, found and called as BenchmarkDotNet does.</summary>
sealed class SmokeCase
{
    const BindingFlags Members = BindingFlags.Public | BindingFlags.Static | BindingFlags.Instance;

    readonly MethodInfo method;
    readonly (PropertyInfo Property, object? Value)[] parameters;

    SmokeCase(MethodInfo method, (PropertyInfo, object?)[] parameters) => (this.method, this.parameters) = (method, parameters);

    Type Owner => method.ReflectedType!;

    /// <summary>Class, method and parameters.</summary>
    public string Name
    {
        get
        {
            IEnumerable<string> values = parameters.Select(choice =>
                string.Create(CultureInfo.InvariantCulture, $"{choice.Property.Name}: {choice.Value}"));
            return $"{Owner.Name}.{method.Name}({string.Join(", ", values)})";
        }
    }

    /// <summary>All cases of an assembly, in an order that does not change from run to run.</summary>
    public static IEnumerable<SmokeCase> FindAll(Assembly assembly) =>
        from type in assembly.GetExportedTypes()
        where !type.IsAbstract
        orderby type.FullName
        from method in type.GetMethods(Members)
        where method.IsDefined(typeof(BenchmarkAttribute))
        from choice in Choices(type)
        select new SmokeCase(method, choice);

    static List<(PropertyInfo, object?)[]> Choices(Type type)
    {
        var choices = new List<(PropertyInfo, object?)[]> { Array.Empty<(PropertyInfo, object?)>() };
        foreach (PropertyInfo property in type.GetProperties(Members))
        {
            if (Values(type, property) is { } values)
                choices = [.. from choice in choices from value in values select choice.Append((property, value)).ToArray()];
        }
        return choices;
    }

    static object?[]? Values(Type type, PropertyInfo property)
    {
        if (property.GetCustomAttribute<ParamsAttribute>() is { } listed)
            return listed.Values;
        if (property.GetCustomAttribute<ParamsSourceAttribute>() is not { } source)
            return null;
        object? values = type.GetProperty(source.Name, Members)?.GetValue(null);
        return values is System.Collections.IEnumerable sequence
            ? [.. sequence.Cast<object?>()]
            : throw new InvalidOperationException($"{type.Name}.{source.Name} has to be a static property with values.");
    }

    /// <summary>Setup, one call, cleanup; the cleanup also after a failure.</summary>
    public void Run()
    {
        object instance = Activator.CreateInstance(Owner)!;
        foreach ((PropertyInfo property, object? value) in parameters)
            property.SetValue(instance, value);
        (instance as IShortened)?.Shorten();
        try
        {
            CallAll<GlobalSetupAttribute>(instance);
            CallAll<IterationSetupAttribute>(instance);
            Call(method, instance);
        }
        finally
        {
            CallAll<IterationCleanupAttribute>(instance);
            CallAll<GlobalCleanupAttribute>(instance);
        }
    }

    void CallAll<TAttribute>(object instance) where TAttribute : TargetedAttribute
    {
        foreach (MethodInfo candidate in Owner.GetMethods(Members))
        {
            if (candidate.GetCustomAttribute<TAttribute>() is { } attribute
                && (attribute.Targets is not { Length: > 0 } targets || targets.Contains(method.Name)))
                Call(candidate, instance);
        }
    }

    static void Call(MethodInfo method, object instance) => method.Invoke(instance, BindingFlags.DoNotWrapExceptions, null, null, null);
}
