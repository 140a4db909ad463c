using System;
using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>
/// Spheres, cylinders and capsules that roll down a slope of 20 degrees, straight on: each kind at its own rate, g sin a / (1 + I / m r2),
/// whatever its size.
/// </summary>
static class Rolling
{
    const int Lanes = 10;
    const float AngleDegrees = 20;

    public static BuiltInScene Scene { get; } = new("rolling", "30 spheres, cylinders and capsules that roll down a slope", _ => Create());

    static SceneDescription Create()
    {
        var scene = new SceneDescription { Name = Scene.Name, Steps = 180, Damping = 0 };
        // About z: down the slope is towards -x.
        double half = AngleDegrees * Math.PI / 360;
        (float sine, float cosine) = ((float)Math.Sin(half), (float)Math.Cos(half));
        var tilt = new Quaternion(0, 0, sine, cosine);
        var along = new Vector3(1 - 2 * sine * sine, 2 * sine * cosine, 0);
        var up = new Vector3(-along.Y, along.X, 0);
        scene.AddStatic(scene.AddBox(60, 0.5f, 20), up * -0.5f, tilt);
        // Their axes lie across the slope, along z.
        float quarter = (float)Math.Sqrt(0.5);
        var lying = new Quaternion(quarter, 0, 0, quarter);
        for (int i = 0; i < Lanes; ++i)
        {
            float radius = 0.1f + 0.05f * i;
            AddRow(scene, scene.AddSphere(radius), i, 0, Quaternion.Identity);
            AddRow(scene, scene.AddCylinder(radius, 0.4f), i, 4, lying);
            AddRow(scene, scene.AddCapsule(radius, 0.25f), i, 8, lying);
            void AddRow(SceneDescription target, int shape, int lane, float ahead, Quaternion orientation) =>
                target.AddDynamic(shape, 1, along * (40 - ahead) + up * radius + new Vector3(0, 0, (lane - (Lanes - 1) * 0.5f) * 3), orientation);
        }
        return scene;
    }
}
