using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Reflection;
using System.Runtime.CompilerServices;

namespace DemoTests.Quality;

/// <summary>Writes the public surface of an assembly as text: a line per type and member, in order.</summary>
static class PublicApi
{
    const BindingFlags Declared =
        BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.Static | BindingFlags.Instance | BindingFlags.DeclaredOnly;

    /// <summary>Lines of all public types.</summary>
    public static IEnumerable<string> Describe(Assembly assembly)
    {
        foreach (var type in assembly.GetExportedTypes().OrderBy(type => type.FullName, StringComparer.Ordinal))
        {
            yield return $"{Kind(type)} {FullName(type)}";
            foreach (var line in Members(type).Order(StringComparer.Ordinal))
                yield return $"  {line}";
        }
    }

    static string Kind(Type type) =>
        type.IsEnum ? "enum" : type.IsInterface ? "interface" : typeof(Delegate).IsAssignableFrom(type) ? "delegate" :
        type.IsValueType ? (type.IsDefined(typeof(IsReadOnlyAttribute), false) ? "readonly struct" : "struct") :
        type is { IsAbstract: true, IsSealed: true } ? "static class" :
        type.IsAbstract ? "abstract class" : type.IsSealed ? "sealed class" : "class";

    static IEnumerable<string> Members(Type type)
    {
        if (type.IsEnum)
            return Enum.GetNames(type).Select(name => $"{name} = {Convert.ToInt64(Enum.Parse(type, name), null)}");
        // Where a type is generic, its members speak of it by its parameters, so nothing is resolved here.
        var members = type.GetInterfaces().Where(contract => contract.IsVisible).Select(contract => $": {Name(contract)}");
        members = members.Concat(type.GetFields(Declared).Where(field => IsVisible(field.Attributes)).Select(Describe));
        members = members.Concat(type.GetConstructors(Declared).Where(IsVisible).Select(constructor => $"ctor({Parameters(constructor)})"));
        return members.Concat(type.GetMethods(Declared)
            .Where(method => IsVisible(method) && !IsWrittenByCompiler(method)).Select(Describe));
    }

    static bool IsVisible(FieldAttributes attributes) =>
        (attributes & FieldAttributes.FieldAccessMask) is FieldAttributes.Public or FieldAttributes.Family or FieldAttributes.FamORAssem;

    // Explicit implementations of an interface are private and have a dot in their names.
    static bool IsVisible(MethodBase method) => method.IsPublic || method.IsFamily || method.IsFamilyOrAssembly;

    static bool IsWrittenByCompiler(MethodInfo method) =>
        method.IsDefined(typeof(CompilerGeneratedAttribute), false) && !method.IsSpecialName;

    static string Describe(FieldInfo field) => field switch
    {
        { IsLiteral: true } => $"const {Name(field.FieldType)} {field.Name} = {Text(field.GetRawConstantValue())}",
        { IsStatic: true } => $"static {Name(field.FieldType)} {field.Name}",
        { IsInitOnly: true } => $"readonly {Name(field.FieldType)} {field.Name}",
        _ => $"{Name(field.FieldType)} {field.Name}",
    };

    static string Describe(MethodInfo method)
    {
        var access = method.IsPublic ? "" : "protected ";
        var scope = method.IsStatic ? "static " : "";
        var isAbstract = method.IsAbstract ? "abstract " : "";
        var generics = method.IsGenericMethod ? $"<{string.Join(", ", method.GetGenericArguments().Select(Constrained))}>" : "";
        return $"{access}{scope}{isAbstract}{Name(method.ReturnType)} {method.Name}{generics}({Parameters(method)})";
    }

    static string Parameters(MethodBase method) => string.Join(", ", method.GetParameters().Select(Describe));

    static string Describe(ParameterInfo parameter)
    {
        var passing = !parameter.ParameterType.IsByRef ? "" : parameter.IsOut ? "out " : parameter.IsIn ? "in " : "ref ";
        var type = parameter.ParameterType.IsByRef ? Name(parameter.ParameterType.GetElementType()!) : Name(parameter.ParameterType);
        var standard = parameter.IsOptional ? $" = {Text(parameter.RawDefaultValue)}" : "";
        return $"{passing}{type} {parameter.Name}{standard}";
    }

    static string? Text(object? value) => value is null ? "default" : Convert.ToString(value, CultureInfo.InvariantCulture);

    static string Constrained(Type parameter)
    {
        var constraints = parameter.GetGenericParameterConstraints().Where(type => type != typeof(ValueType)).Select(Name);
        if ((parameter.GenericParameterAttributes & GenericParameterAttributes.NotNullableValueTypeConstraint) != 0)
            constraints = constraints.Prepend("struct");
        var list = string.Join(" & ", constraints);
        return list.Length == 0 ? parameter.Name : $"{parameter.Name} : {list}";
    }

    static string FullName(Type type)
    {
        var prefix = type.IsNested ? FullName(type.DeclaringType!) + "." : type.Namespace + ".";
        var outer = type.DeclaringType?.GetGenericArguments().Length ?? 0;
        var own = type.IsGenericTypeDefinition ? type.GetGenericArguments().Skip(outer).ToArray() : [];
        return prefix + Bare(type.Name) + (own.Length > 0 ? $"<{string.Join(", ", own.Select(Constrained))}>" : "");
    }

    static string Name(Type type)
    {
        if (type.IsByRef)
            return $"ref {Name(type.GetElementType()!)}";
        if (type.IsPointer)
            return $"{Name(type.GetElementType()!)}*";
        if (type.IsArray)
            return $"{Name(type.GetElementType()!)}[]";
        if (type.IsFunctionPointer || type.IsUnmanagedFunctionPointer)
            return "delegate*";
        return type.IsGenericType ? $"{Bare(type.Name)}<{string.Join(", ", type.GetGenericArguments().Select(Name))}>" : type.Name;
    }

    static string Bare(string name) => name.IndexOf('`', StringComparison.Ordinal) is >= 0 and var tick ? name[..tick] : name;
}
