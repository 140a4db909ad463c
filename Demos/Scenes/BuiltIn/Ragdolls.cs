using System.Numerics;

namespace Demos.Scenes.BuiltIn;

/// <summary>Ragdolls of eleven capsules, upright, that fall to the ground and over each other.</summary>
static class Ragdolls
{
    const int Columns = 8;

    public static BuiltInScene Scene { get; } = new("ragdolls", "64 ragdolls of 11 capsules fall down", _ => Create());

    static SceneDescription Create()
    {
        var scene = new SceneDescription { Name = Scene.Name, Steps = 360 };
        scene.AddStatic(scene.AddBox(50, 1, 50), new Vector3(0, -1, 0));
        for (int i = 0; i < Columns * Columns; ++i)
        {
            // Higher ones fall onto lower ones beside them.
            int x = i % Columns, z = i / Columns;
            new Builder(scene, new Vector3((x - 3.5f) * .9f, .1f + (x + z) % 4 * .5f, (z - 3.5f) * .9f), group: i + 1).AddRagdoll();
        }
        return scene;
    }

    sealed class Builder(SceneDescription scene, Vector3 feet, int group)
    {
        public void AddRagdoll()
        {
            int pelvis = AddPart(new(0, 1, 0), .12f, .08f, 12), chest = AddPart(new(0, 1.4f, 0), .13f, .08f, 16);
            Join(pelvis, chest, new(0, 1.2f, 0), .5f);
            Join(chest, AddPart(new(0, 1.8f, 0), .1f, .04f, 5), new(0, 1.63f, 0), .7f);
            foreach (float side in (float[])[-1, 1])
            {
                AddLimb(chest, new(side * .25f, 1.5f, 0), .06f, .15f, 2.5f);
                AddLimb(pelvis, new(side * .12f, .9f, 0), .08f, .22f, 6);
            }
        }

        // Two parts that hang down from a point of the trunk.
        void AddLimb(int trunk, Vector3 top, float radius, float half, float mass)
        {
            Vector3 down = new(0, -half, 0);
            int upper = AddPart(top + down, radius, half - radius, mass), lower = AddPart(top + down * 3, radius, half - radius, mass * .7f);
            Join(trunk, upper, top, 1.2f);
            Join(upper, lower, top + down * 2, 1);
        }

        int AddPart(Vector3 center, float radius, float halfLength, float mass) =>
            scene.AddDynamic(scene.AddCapsule(radius, halfLength), mass, feet + center, group: group);

        void Join(int a, int b, Vector3 point, float swing) => scene.Joints.Add(new SceneJoint
        {
            Kind = SceneJointKind.Rag,
            BodyA = a,
            BodyB = b,
            AnchorA = feet + point - scene.Bodies[a].Position,
            AnchorB = feet + point - scene.Bodies[b].Position,
            MaximumSwing = swing,
            MinimumTwist = -.5f,
            MaximumTwist = .5f,
        });
    }
}
