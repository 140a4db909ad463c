using System;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;

namespace DemoTests.Accuracy;

/// <summary>Bad bodies and statics: poses, velocities, masses, margins, handles.</summary>
static class BadBodyInput
{
    static readonly string[] position = ["position", "pose"];
    static readonly string[] orientation = ["orientation", "pose"];
    static readonly string[] velocity = ["velocity"];
    static readonly string[] mass = ["mass", "inertia"];
    static readonly string[] inertia = ["inertia"];
    static readonly string[] margin = ["margin"];
    static readonly string[] handle = ["handle", "body", "static"];
    static readonly string[] shape = ["shape", "index"];

    delegate void Edit(ref BodyDescription description, float value);

    delegate void EditStatic(ref StaticDescription description, float value);

    public static void AddTo(BadInputList list)
    {
        Poses(list);
        Inertias(list);
        Margins(list);
        Impulses(list);
        Handles(list);
        Statics(list);
    }

    static void Poses(BadInputList list)
    {
        Described(list, "position.X", position, BadInputList.NotReasonable, static (ref d, v) => d.Pose.Position.X = v);
        Described(list, "position.Y", position, BadInputList.NotFinite, static (ref d, v) => d.Pose.Position.Y = v);
        Described(list, "position.Z", position, BadInputList.NotFinite, static (ref d, v) => d.Pose.Position.Z = v);
        Described(list, "orientation.W", orientation, BadInputList.NotReasonable, static (ref d, v) => d.Pose.Orientation.W = v);
        Described(list, "orientation.X", orientation, BadInputList.NotFinite, static (ref d, v) => d.Pose.Orientation.X = v);
        Described(list, "length of orientation", orientation, [0, .5f, 2], static (ref d, v) => d.Pose.Orientation = new(0, 0, 0, v));
        Described(list, "linear velocity.X", velocity, BadInputList.NotReasonable, static (ref d, v) => d.Velocity.Linear.X = v);
        Described(list, "linear velocity.Z", velocity, BadInputList.NotFinite, static (ref d, v) => d.Velocity.Linear.Z = v);
        Described(list, "angular velocity.Y", velocity, BadInputList.NotReasonable, static (ref d, v) => d.Velocity.Angular.Y = v);
        Described(list, "sleep threshold", ["sleep", "activity", "threshold"], [float.NaN], static (ref d, v) =>
            d.Activity.SleepThreshold = v);
    }

    static void Inertias(BadInputList list)
    {
        float[] badInverses = [.. BadInputList.NotFinite, BadInputList.Huge, -1];
        Described(list, "inverse mass", mass, badInverses, static (ref d, v) => d.LocalInertia.InverseMass = v);
        Described(list, "inverse inertia XX", inertia, badInverses, static (ref d, v) => d.LocalInertia.InverseInertiaTensor.XX = v);
        Described(list, "inverse inertia ZZ", inertia, badInverses, static (ref d, v) => d.LocalInertia.InverseInertiaTensor.ZZ = v);
        Described(list, "inverse inertia YX", inertia, BadInputList.NotReasonable, static (ref d, v) =>
            d.LocalInertia.InverseInertiaTensor.YX = v);
        // Off the diagonal more than on it: some rotation would have negative energy.
        Described(list, "indefinite inverse inertia, ZY", inertia, [100, -100], static (ref d, v) =>
            d.LocalInertia.InverseInertiaTensor.ZY = v);
        list.Add("Bodies.SetLocalInertia, inverse mass", mass, badInverses, static (w, v) =>
            w.Bodies.SetLocalInertia(w.FreeBody, new Sphere(1).ComputeInertia(1) with { InverseMass = v }));
        list.Add("BodyReference.SetLocalInertia, inverse mass", mass, badInverses, static (w, v) =>
            w.Bodies[w.FreeBody].SetLocalInertia(new Sphere(1).ComputeInertia(1) with { InverseMass = v }));
        list.Add("Sphere.ComputeInertia and Bodies.Add, mass", mass, BadInputList.NotPositive, static (w, v) =>
            w.Bodies.Add(w.HealthyBody() with { LocalInertia = new Sphere(.5f).ComputeInertia(v) }));
        list.Add("Capsule.ComputeInertia and Bodies.Add, mass", mass, BadInputList.NotPositive, static (w, v) =>
            w.Bodies.Add(w.HealthyBody() with { LocalInertia = new Capsule(.5f, 1).ComputeInertia(v) }));
        list.Add("Box.ComputeInertia and Bodies.Add, mass", mass, BadInputList.NotPositive, static (w, v) =>
            w.Bodies.Add(w.HealthyBody() with { LocalInertia = new Box(1, 2, 3).ComputeInertia(v) }));
        list.Add("CreateConvexDynamic and Bodies.Add, mass", mass, BadInputList.NotPositive, static (w, v) =>
            w.Bodies.Add(BodyDescription.CreateConvexDynamic(new Vector3(0, 9, 0), v, w.Simulation.Shapes, new Sphere(.5f))));
    }

    static void Margins(BadInputList list)
    {
        float[] bad = [float.NaN, float.NegativeInfinity, -1];
        Described(list, "minimum speculative margin", margin, [.. bad, float.PositiveInfinity], static (ref d, v) =>
            d.Collidable.MinimumSpeculativeMargin = v);
        Described(list, "maximum speculative margin", margin, bad, static (ref d, v) => d.Collidable.MaximumSpeculativeMargin = v);
        Described(list, "maximum below minimum speculative margin", margin, [.5f], static (ref d, v) =>
            (d.Collidable.MinimumSpeculativeMargin, d.Collidable.MaximumSpeculativeMargin) = (2 * v, v));
    }

    static void Impulses(BadInputList list)
    {
        string[] impulse = ["impulse"];
        list.Add("ApplyImpulse, impulse.X", impulse, BadInputList.NotReasonable, static (w, v) =>
            w.Bodies[w.FreeBody].ApplyImpulse(new Vector3(v, 0, 0), Vector3.UnitY));
        list.Add("ApplyImpulse, offset.Y", ["offset"], BadInputList.NotReasonable, static (w, v) =>
            w.Bodies[w.FreeBody].ApplyImpulse(Vector3.UnitX, new Vector3(0, v, 0)));
        list.Add("ApplyLinearImpulse, impulse.Z", impulse, BadInputList.NotReasonable, static (w, v) =>
            w.Bodies[w.FreeBody].ApplyLinearImpulse(new Vector3(0, 0, v)));
        list.Add("ApplyAngularImpulse, impulse.X", [.. impulse, "angular"], BadInputList.NotReasonable, static (w, v) =>
            w.Bodies[w.FreeBody].ApplyAngularImpulse(new Vector3(v, 0, 0)));
    }

    static void Handles(BadInputList list)
    {
        BodyUse("Remove", static (w, h) => w.Bodies.Remove(h));
        BodyUse("GetDescription", static (w, h) => w.Bodies.GetDescription(h, out _));
        BodyUse("ApplyDescription", static (w, h) => w.Bodies.ApplyDescription(h, w.HealthyBody()));
        BodyUse("SetShape", static (w, h) => w.Bodies.SetShape(h, w.Bodies[w.OtherBody].Collidable.Shape));
        BodyUse("SetLocalInertia", static (w, h) => w.Bodies.SetLocalInertia(h, new Sphere(1).ComputeInertia(1)));
        BodyUse("UpdateBounds", static (w, h) => w.Bodies.UpdateBounds(h));
        BodyUse("the indexer and ApplyLinearImpulse", static (w, h) => w.Bodies[h].ApplyLinearImpulse(Vector3.UnitX));
        Shaped(list, "Bodies.Add", static (w, s) => w.Bodies.Add(w.HealthyBody() with { Collidable = new CollidableDescription(s) }));
        Shaped(list, "Bodies.ApplyDescription", static (w, s) =>
            w.Bodies.ApplyDescription(w.FreeBody, w.HealthyBody() with { Collidable = new CollidableDescription(s) }));
        Shaped(list, "Bodies.SetShape", static (w, s) => w.Bodies.SetShape(w.FreeBody, s));

        void BodyUse(string entry, Action<BadInputWorld, BodyHandle> use)
        {
            foreach (int value in new[] { -1, 100_000, int.MaxValue })
                list.Add($"Bodies.{entry}, handle {value}", handle, w => use(w, new BodyHandle(value)));
            list.Add($"Bodies.{entry}, handle of a removed body", handle, w => use(w, w.RemovedBody));
        }
    }

    static void Statics(BadInputList list)
    {
        DescribedStatic("position.X", position, BadInputList.NotReasonable, static (ref d, v) => d.Pose.Position.X = v);
        DescribedStatic("position.Z", position, BadInputList.NotFinite, static (ref d, v) => d.Pose.Position.Z = v);
        DescribedStatic("orientation.Y", orientation, BadInputList.NotReasonable, static (ref d, v) => d.Pose.Orientation.Y = v);
        DescribedStatic("length of orientation", orientation, [0, .5f, 2], static (ref d, v) => d.Pose.Orientation = new(0, 0, 0, v));
        StaticUse("Remove", static (w, h) => w.Simulation.Statics.Remove(h));
        StaticUse("GetDescription", static (w, h) => w.Simulation.Statics.GetDescription(h, out _));
        StaticUse("ApplyDescription", static (w, h) => w.Simulation.Statics.ApplyDescription(h, w.HealthyStatic()));
        StaticUse("SetShape", static (w, h) => w.Simulation.Statics.SetShape(h, w.Bodies[w.OtherBody].Collidable.Shape));
        StaticUse("UpdateBounds", static (w, h) => w.Simulation.Statics.UpdateBounds(h));
        Shaped(list, "Statics.Add", static (w, s) => w.Simulation.Statics.Add(w.HealthyStatic() with { Shape = s }));
        Shaped(list, "Statics.ApplyDescription", static (w, s) =>
            w.Simulation.Statics.ApplyDescription(w.Ground, w.HealthyStatic() with { Shape = s }));
        Shaped(list, "Statics.SetShape", static (w, s) => w.Simulation.Statics.SetShape(w.Ground, s));

        void StaticUse(string entry, Action<BadInputWorld, StaticHandle> use)
        {
            foreach (int value in new[] { -1, 100_000, int.MaxValue })
                list.Add($"Statics.{entry}, handle {value}", handle, w => use(w, new StaticHandle(value)));
            list.Add($"Statics.{entry}, handle of a removed static", handle, w => use(w, w.RemovedStatic));
        }

        void DescribedStatic(string subject, string[] words, float[] values, EditStatic edit)
        {
            list.Add($"Statics.Add, {subject}", words, values, (w, v) =>
            {
                var description = w.HealthyStatic();
                edit(ref description, v);
                w.Simulation.Statics.Add(description);
            });
            list.Add($"Statics.ApplyDescription, {subject}", words, values, (w, v) =>
            {
                var description = w.HealthyStatic();
                edit(ref description, v);
                w.Simulation.Statics.ApplyDescription(w.Ground, description);
            });
        }
    }

    /// <summary>The same bad description at both of its doors.</summary>
    static void Described(BadInputList list, string subject, string[] words, float[] values, Edit edit)
    {
        list.Add($"Bodies.Add, {subject}", words, values, (w, v) =>
        {
            var description = w.HealthyBody();
            edit(ref description, v);
            w.Bodies.Add(description);
        });
        list.Add($"Bodies.ApplyDescription, {subject}", words, values, (w, v) =>
        {
            var description = w.HealthyBody();
            edit(ref description, v);
            w.Bodies.ApplyDescription(w.FreeBody, description);
        });
    }

    /// <summary>Shapes that this simulation does not have.</summary>
    static void Shaped(BadInputList list, string entry, Action<BadInputWorld, TypedIndex> use)
    {
        list.Add($"{entry}, index beyond the shapes", shape, w => use(w, new TypedIndex(0, 5000)));
        list.Add($"{entry}, type that does not exist", shape, w => use(w, new TypedIndex(77, 0)));
        list.Add($"{entry}, removed shape", shape, w => use(w, w.RemovedShape));
        list.Add($"{entry}, shape of other Shapes", shape, w => use(w, BadShapeInput.ShapeOfOtherShapes()));
    }
}
