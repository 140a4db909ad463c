using System;
using System.Linq;
using System.Numerics;
using System.Reflection;
using BepuPhysics;
using BepuPhysics.Collidables;
using DemoTests.Support;

namespace DemoTests.Accuracy;

/// <summary>No number in each field of the descriptions and shapes that are structs of numbers, whichever fields they have.</summary>
static class BadFieldInput
{
    public static void AddTo(BadInputList list)
    {
        var still = new StaticDescription(new Vector3(0, -9, 0), default);
        Each(list, "Bodies.Add", static w => w.HealthyBody(), static (w, d) => w.Bodies.Add(d));
        Each(list, "Bodies.ApplyDescription", static w => w.HealthyBody(), static (w, d) => w.Bodies.ApplyDescription(w.FreeBody, d));
        Each(list, "Statics.Add", w => Shaped(w, still), static (w, d) => w.Simulation.Statics.Add(d));
        Shape(list, new Sphere(1));
        Shape(list, new Capsule(1, 1));
        Shape(list, new Box(1, 1, 1));
        Shape(list, new Cylinder(1, 1));
        Shape(list, new Triangle(default, Vector3.UnitX, Vector3.UnitZ));
    }

    static StaticDescription Shaped(BadInputWorld world, StaticDescription still)
    {
        still.Shape = world.Bodies[world.FreeBody].Collidable.Shape;
        return still;
    }

    static void Shape<T>(BadInputList list, T healthy) where T : unmanaged, IShape =>
        Each(list, $"Shapes.Add({typeof(T).Name})", _ => healthy, static (w, shape) => w.Simulation.Shapes.Add(shape));

    static void Each<T>(BadInputList list, string entry, Func<BadInputWorld, T> healthy, Action<BadInputWorld, T> use) where T : struct
    {
        foreach (var path in FloatFields.Of(typeof(T)))
            list.Add($"{entry}, each field, {FloatFields.Name(path)} = NaN", Words(path), w => use(w, FloatFields.With(healthy(w), path, float.NaN)));
    }

    // The message says one of the words of which the names are made, of a corner of a triangle its letter.
    static string[] Words(FieldInfo[] path) => [.. path.SelectMany(field => field.Name.Length == 1 ? [$"corner {field.Name}"] : WordsOf(field.Name))];

    static string[] WordsOf(string name) => string.Concat(name.Select(letter => char.IsUpper(letter) ? $" {letter}" : $"{letter}")).Trim().Split(' ');
}
