using System.Numerics;
using BepuPhysics;
using BepuPhysics.Characters;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
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

    public static (bool IsDown, bool IsUp) Crouch(CharacterControllers characters, BodyHandle hero, TypedIndex crouching, TypedIndex standing)
    {
        var isDown = characters.TryChangeShape(hero, crouching);
        var isUp = characters.TryChangeShape(hero, standing);
        return (isDown, isUp);
    }

    public static (ConstraintHandle Ladder, OneBodyLinearMotor Motor) BeginLadder(Simulation simulation, BodyHandle hero, float climbing)
    {
        var motor = new OneBodyLinearMotor { TargetVelocity = new Vector3(0, climbing, 0), Settings = new(20_000, 0) };
        var ladder = simulation.Solver.Add(hero, motor);
        return (ladder, motor);
    }

    public static void Climb(Simulation simulation, ConstraintHandle ladder, OneBodyLinearMotor motor, float climbing)
    {
        motor.TargetVelocity = new Vector3(0, climbing, 0);
        simulation.Solver.ApplyDescription(ladder, motor);
    }

    public static void EndLadder(Simulation simulation, ConstraintHandle ladder)
    {
        simulation.Solver.Remove(ladder);
    }
}
