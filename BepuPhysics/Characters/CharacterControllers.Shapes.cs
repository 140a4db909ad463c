using System;
using System.Numerics;
using BepuPhysics.Collidables;
using BepuPhysics.CollisionDetection;
using BepuUtilities;

namespace BepuPhysics.Characters;

// What depends on the shape of a character, and another shape for it.
public sealed partial class CharacterControllers
{
    // Contacts rest a little inside, and a ceiling that is lower by so little only presses on the head: as a part of the height.
    const float Squeeze = 5e-3f;

    /// <summary>
    /// Gives a character another shape, as to crouch or to stand up again, with its feet where they are, if there is room. Its body goes up or down
    /// by what that takes, and wakes.
    /// </summary>
    /// <remarks>
    /// There is room where the new shape is nowhere deeper in anything that the character's layers meet than by .5 % of its height, or than the present one is
    /// already, and where nothing is above the head on the way there. Sensors take no room. The inertia stays as it is.
    /// </remarks>
    /// <param name="bodyHandle">Body of the character.</param>
    /// <param name="shape">The new shape: a sphere, capsule, box, cylinder or hull, as the present one must be.</param>
    /// <returns>Whether there was room; if not, nothing was changed.</returns>
    /// <exception cref="ArgumentException">The body is no character, or one of the shapes is none of these; nothing was changed.</exception>
    /// <exception cref="InvalidOperationException">A step, a change or a query is in progress; nothing was changed.</exception>
    public bool TryChangeShape(BodyHandle bodyHandle, TypedIndex shape)
    {
        ref readonly var character = ref GetCharacterByBodyHandle(bodyHandle);
        var body = BodyOf(character);
        var now = new Fit { Characters = this, Character = character, Pose = body.Pose, Up = Exact.Rotate(character.LocalUp, body.Pose.Orientation) };
        RequireUse(body.Collidable.Shape, ref now, nameof(bodyHandle));
        var then = now;
        then.Feet = now.Bottom;
        RequireUse(shape, ref then, nameof(shape));
        if (then.Depth > Math.Max(Squeeze * (then.Top - then.Bottom), now.Depth))
            return false;
        var headroom = new Headroom { Of = now, Rise = then.Top - now.Top - Squeeze * (then.Top - then.Bottom) };
        if (headroom.Rise > 0)
            RequireUse(body.Collidable.Shape, ref headroom, nameof(bodyHandle));
        if (headroom.IsBlocked)
            return false;
        body.SetShape(shape);
        body.Awake = true;
        body.Pose = then.Pose;
        body.UpdateBounds();
        return true;
    }

    void RequireUse<TUse>(TypedIndex shape, ref TUse use, string name) where TUse : struct, IConvexUse
    {
        if (!TryUse(shape, ref use))
            throw new ArgumentException($"Shape {shape} is no sphere, capsule, box, cylinder or hull.", name);
    }

    /// <summary>What is done with a convex shape of any type.</summary>
    interface IConvexUse
    {
        void Use<TShape>(in TShape shape) where TShape : unmanaged, IConvexShape;
    }

    // False for shapes that are made of others, and that characters therefore do not have.
    bool TryUse<TUse>(TypedIndex index, ref TUse use) where TUse : struct, IConvexUse
    {
        var shapes = Simulation.Shapes;
        if (index.Type == Sphere.TypeId)
            use.Use(shapes.GetShape<Sphere>(index.Index));
        else if (index.Type == Capsule.TypeId)
            use.Use(shapes.GetShape<Capsule>(index.Index));
        else if (index.Type == Box.TypeId)
            use.Use(shapes.GetShape<Box>(index.Index));
        else if (index.Type == Cylinder.TypeId)
            use.Use(shapes.GetShape<Cylinder>(index.Index));
        else if (index.Type == ConvexHull.TypeId)
            use.Use(shapes.GetShape<ConvexHull>(index.Index));
        else
            return false;
        return true;
    }

    // How far the shape reaches along a direction.
    static float Reach<TShape>(in TShape shape, in RigidPose pose, Vector3 direction) where TShape : unmanaged, IConvexShape
    {
        shape.ComputeBounds(
            Exact.Concatenate(pose.Orientation, QuaternionEx.GetQuaternionBetweenNormalizedVectors(direction, Vector3.UnitY)), out _, out var max);
        return max.Y;
    }

    /// <summary>How a shape stands where a character is.</summary>
    struct Fit : IConvexUse
    {
        public CharacterControllers Characters;
        public CharacterController Character;
        public Vector3 Up;
        /// <summary>Where the shape is: first as the body, then so that its bottom is at the feet.</summary>
        public RigidPose Pose;
        /// <summary>Where the bottom is to be, if that is given, along <see cref="Up"/>, m.</summary>
        public float? Feet;
        /// <summary>Ends of the shape along <see cref="Up"/>, m.</summary>
        public float Bottom, Top;
        /// <summary>How deep it is in what it overlaps most, m.</summary>
        public float Depth;

        public void Use<TShape>(in TShape shape) where TShape : unmanaged, IConvexShape
        {
            var (down, up) = (Reach(shape, Pose, -Up), Reach(shape, Pose, Up));
            if (Feet is float feet)
                Pose.Position += Up * (feet + down - Exact.Dot(Pose.Position, Up));
            var center = Exact.Dot(Pose.Position, Up);
            (Bottom, Top) = (center - down, center + up);
            var simulation = Characters.Simulation;
            var deepest = new DeepestContact { Self = simulation.Bodies[Character.BodyHandle].CollidableReference, Events = simulation.Events };
            simulation.FindContacts(shape, Pose, 0, Characters.pool, ref deepest, simulation.Layers[Character.BodyHandle]);
            Depth = deepest.Depth;
        }
    }

    /// <summary>Whether something is above a shape: what has a front only is not seen from behind, where the new shape may begin.</summary>
    struct Headroom : IConvexUse
    {
        public Fit Of;
        public float Rise;
        public bool IsBlocked;

        public void Use<TShape>(in TShape shape) where TShape : unmanaged, IConvexShape => IsBlocked = Of.Characters.Sweep(
            shape, Of.Pose, Of.Up * Rise, Of.Character, ignoresOverlaps: true, meetsBodies: true).Exists;
    }

    struct DeepestContact : IShapeContactHandler
    {
        public CollidableReference Self;
        public CollisionEvents Events;
        public float Depth;

        public readonly bool AllowTest(CollidableReference collidable) => collidable != Self && !Events.IsSensor(collidable);

        public readonly bool AllowTest(CollidableReference collidable, int childIndex) => true;

        public void OnContacts<TManifold>(CollidableReference collidable, ref TManifold manifold)
            where TManifold : unmanaged, IContactManifold<TManifold>
        {
            for (int i = 0; i < manifold.Count; ++i)
                Depth = Math.Max(Depth, manifold.GetDepth(i));
        }
    }
}
