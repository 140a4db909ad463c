using System.Numerics;
using BepuPhysics;
using BepuPhysics.Characters;
using BepuPhysics.Collidables;
using BepuUtilities.Memory;

namespace DemoTests.Quality;

// Docs/Guides/Characters.md.
static partial class DocSamples
{
    public static (Simulation Simulation, CharacterControllers Characters, BodyHandle Hero) CreateCharacter(BufferPool pool)
    {
        var characters = new CharacterControllers(pool);
        var simulation = Simulation.Create(
            pool, new CharacterNarrowPhaseCallbacks<DefaultNarrowPhaseCallbacks>(characters, new()), new DefaultPoseIntegratorCallbacks(),
            new SolveDescription(1, 4));
        simulation.Statics.Add(new StaticDescription(new Vector3(0, -.5f, 0), simulation.Shapes.Add(new Box(100, 1, 100))));

        // Without inverse inertia nothing turns it over.
        var shape = simulation.Shapes.Add(new Capsule(.3f, 1.2f));
        var hero = simulation.Bodies.Add(BodyDescription.CreateDynamic(new Vector3(0, .9f, 0), new BodyInertia { InverseMass = 1 / 70f }, shape, .01f));
        characters.AllocateCharacter(hero).MaximumStepHeight = .4f;
        return (simulation, characters, hero);
    }

    public static void MoveCharacter(Simulation simulation, CharacterControllers characters, BodyHandle hero, Vector3 view, Vector2 input, bool jump)
    {
        ref var character = ref characters.GetCharacterByBodyHandle(hero);
        character.ViewDirection = view;
        character.TargetVelocity = input * 4;
        character.TryJump = jump;
        simulation.Timestep(1 / 60f);
    }
}
