using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.Reflection;
using System.Runtime.CompilerServices;

namespace BepuUtilities.Diagnostics;

/// <summary>Compiles methods before anybody calls them.</summary>
/// <remarks>
/// For what is generic over types of a caller and cannot be run without calling them. All else is compiled best by running it.
/// </remarks>
[UnconditionalSuppressMessage("Trimming", "IL2055", Justification = Trimmed), UnconditionalSuppressMessage("Trimming", "IL2060", Justification = Trimmed)]
[UnconditionalSuppressMessage("Trimming", "IL2070", Justification = Trimmed), UnconditionalSuppressMessage("AOT", "IL3050", Justification = Ahead)]
public static class Precompilation
{
    const string Trimmed = "What was trimmed is called by nobody, and need not be compiled.";
    const string Ahead = "Does nothing where code is compiled ahead of time.";
    const BindingFlags All = BindingFlags.Instance | BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly;

    /// <summary>Compiles the methods of a type that are not generic themselves.</summary>
    /// <param name="type">The type, with all of its type arguments.</param>
    public static void Compile(Type type)
    {
        if (!RuntimeFeature.IsDynamicCodeCompiled)
            return;
        var arguments = type.GetGenericArguments();
        foreach (var method in type.GetMethods(All))
        {
            // What is in no assembly is compiled by nobody, and its library may be missing.
            var isElsewhere = (method.Attributes & MethodAttributes.PinvokeImpl) != 0 ||
                (method.GetMethodImplementationFlags() & (MethodImplAttributes.InternalCall | MethodImplAttributes.Runtime)) != 0;
            if (!method.IsAbstract && !isElsewhere && !method.ContainsGenericParameters)
                Compile(method, Handles(arguments));
        }
    }

    /// <summary>Compiles the methods of a type that are not generic themselves, and those of the types in it.</summary>
    /// <param name="type">The type, with all of its type arguments.</param>
    public static void CompileAll(Type type)
    {
        if (!RuntimeFeature.IsDynamicCodeCompiled)
            return;
        Compile(type);
        var arguments = type.GetGenericArguments();
        foreach (var nested in type.GetNestedTypes(All))
        {
            if (nested.GetGenericArguments().Length == arguments.Length && !nested.IsSubclassOf(typeof(Delegate)))
                CompileAll(arguments.Length > 0 ? nested.MakeGenericType(arguments) : nested);
        }
    }

    /// <summary>Compiles the generic methods of a name that take as many type arguments as are given.</summary>
    /// <param name="type">The type, with all of its type arguments.</param>
    /// <param name="name">Name of the methods; those that implement an interface explicitly go by the name in it.</param>
    /// <param name="methodArguments">Type arguments of the methods.</param>
    public static void Compile(Type type, string name, params Type[] methodArguments)
    {
        if (!RuntimeFeature.IsDynamicCodeCompiled)
            return;
        var handles = Handles([.. type.GetGenericArguments(), .. methodArguments]);
        foreach (var method in type.GetMethods(All))
        {
            var isNamed = method.Name == name || method.Name.EndsWith("." + name, StringComparison.Ordinal);
            if (isNamed && method.IsGenericMethodDefinition && method.GetGenericArguments().Length == methodArguments.Length)
                Compile(method.MakeGenericMethod(methodArguments), handles);
        }
    }

    static void Compile(MethodInfo method, RuntimeTypeHandle[] arguments)
    {
        // The runtime does not prepare an explicit implementation of an interface before somebody has asked for its address.
        method.MethodHandle.GetFunctionPointer();
        RuntimeHelpers.PrepareMethod(method.MethodHandle, arguments);
    }

    static RuntimeTypeHandle[] Handles(Type[] types)
    {
        var handles = new List<RuntimeTypeHandle>();
        foreach (var type in types)
            handles.Add(type.TypeHandle);
        return [.. handles];
    }
}
