using System;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace DemoTests.Accuracy;

/// <summary>Bad shapes: sizes by constructor and by field, indices.</summary>
static class BadShapeInput
{
    static readonly string[] radius = ["radius"];
    static readonly string[] length = ["length"];
    static readonly string[] shape = ["shape", "index"];

    public static void AddTo(BadInputList list)
    {
        float[] notLength = [.. BadInputList.NotFinite, BadInputList.Huge, -1];
        list.Add("Shapes.Add(Sphere), radius", radius, BadInputList.NotPositive, static (w, v) => w.Simulation.Shapes.Add(new Sphere(v)));
        list.Add("Shapes.Add(Sphere), radius field", radius, BadInputList.NotPositive, static (w, v) =>
            w.Simulation.Shapes.Add(new Sphere { Radius = v }));
        list.Add("Shapes.Add(Capsule), radius", radius, BadInputList.NotPositive, static (w, v) =>
            w.Simulation.Shapes.Add(new Capsule(v, 1)));
        list.Add("Shapes.Add(Capsule), length", length, notLength, static (w, v) => w.Simulation.Shapes.Add(new Capsule(.5f, v)));
        list.Add("Shapes.Add(Capsule), half length field", length, notLength, static (w, v) =>
            w.Simulation.Shapes.Add(new Capsule { Radius = .5f, HalfLength = v }));
        list.Add("Shapes.Add(Box), width", ["width"], BadInputList.NotPositive, static (w, v) => w.Simulation.Shapes.Add(new Box(v, 1, 1)));
        list.Add("Shapes.Add(Box), height", ["height"], BadInputList.NotPositive, static (w, v) =>
            w.Simulation.Shapes.Add(new Box(1, v, 1)));
        list.Add("Shapes.Add(Box), length", length, BadInputList.NotPositive, static (w, v) => w.Simulation.Shapes.Add(new Box(1, 1, v)));
        list.Add("Shapes.Add(Box), half height field", ["height"], BadInputList.NotPositive, static (w, v) =>
            w.Simulation.Shapes.Add(new Box { HalfWidth = 1, HalfHeight = v, HalfLength = 1 }));
        Indexed("Remove", static (w, s) => w.Simulation.Shapes.Remove(s));
        Indexed("UpdateBounds", static (w, s) => w.Simulation.Shapes.UpdateBounds(BepuPhysics.RigidPose.Identity, s, out _));

        void Indexed(string entry, Action<BadInputWorld, TypedIndex> use)
        {
            list.Add($"Shapes.{entry}, index beyond the shapes", shape, w => use(w, new TypedIndex(0, 5000)));
            list.Add($"Shapes.{entry}, type that does not exist", shape, w => use(w, new TypedIndex(77, 0)));
            list.Add($"Shapes.{entry}, removed shape", shape, w => use(w, w.RemovedShape));
            list.Add($"Shapes.{entry}, shape of other Shapes", shape, w => use(w, ShapeOfOtherShapes()));
        }
    }

    /// <summary>Valid where it was made, where there are more shapes of its type than in the world of the cases.</summary>
    public static TypedIndex ShapeOfOtherShapes()
    {
        var pool = new BufferPool();
        var others = new Shapes(pool, 8);
        TypedIndex last = default;
        for (int i = 0; i < 1000; ++i)
            last = others.Add(new Sphere(1));
        others.Dispose();
        pool.AssertEmpty();
        pool.Clear();
        return last;
    }
}
