namespace BepuPhysics;

/// <summary>Motion and inertia of a body in one view: what is read and written through it is the body's.</summary>
/// <remarks>Valid until bodies are added or removed. For code that was written for bodies whose dynamics lie in one place; here they lie in three.</remarks>
public readonly ref struct BodyDynamicsReference
{
    readonly ref MotionState motion;

    internal BodyDynamicsReference(ref MotionState motion, ref BodyInertia local, ref BodyInertia world)
    {
        this.motion = ref motion;
        Inertia = new(ref local, ref world);
    }

    /// <summary>Pose and velocity.</summary>
    public ref MotionState Motion => ref motion;
    /// <summary>Inverse mass and inertia.</summary>
    public BodyInertiasReference Inertia { get; }
}

/// <summary>Inverse mass and inertia of a body, in its own frame and in the world.</summary>
public readonly ref struct BodyInertiasReference
{
    readonly ref BodyInertia local;
    readonly ref BodyInertia world;

    internal BodyInertiasReference(ref BodyInertia local, ref BodyInertia world)
    {
        this.local = ref local;
        this.world = ref world;
    }

    /// <summary>In the body's frame. To make the body kinematic or dynamic, use <see cref="BodyReference.SetLocalInertia"/>.</summary>
    public ref BodyInertia Local => ref local;
    /// <summary>In world axes, as the solver had it in the last substep: zero for a body that was added since, and less than the body's own about the
    /// axes that a load in point joints stiffens, and of a light link between heavy bodies.
    /// <see cref="BodyReference.ComputeInverseInertia"/> is what it is now.</summary>
    public ref readonly BodyInertia World => ref world;
}
