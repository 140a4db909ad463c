using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>
/// Bodies in free flight that never meet: positions follow parabolas, spin follows Euler's equations. Whatever energy or momentum
/// changes is the integrator's doing.
/// </summary>
static class Newton
{
    const int Columns = 16;

    public static BuiltInScene Scene { get; } = new("newton", "256 spinning bodies in free flight, no contacts", _ => Create());

    static SceneDescription Create()
    {
        var scene = new SceneDescription { Name = Scene.Name, Steps = 240, Damping = 0, Friction = 0 };
        int[] shapes = [scene.AddBox(0.2f, 0.5f, 1), scene.AddSphere(0.5f), scene.AddCapsule(0.3f, 0.7f), scene.AddBox(0.5f, 0.5f, 0.5f)];
        for (int i = 0; i < Columns * Columns; ++i)
        {
            int x = i % Columns, z = i / Columns;
            scene.AddDynamic(shapes[i % shapes.Length], 1 + i % 7, new Vector3((x - 7.5f) * 5, 0, (z - 7.5f) * 5),
                linearVelocity: new Vector3(0, 10 + z, 0),
                angularVelocity: new Vector3(0.25f * x, 0.5f * z, 5), group: -1);
        }
        return scene;
    }
}
