using System.Runtime.InteropServices;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Resistance of a body to being moved. All zero means that nothing moves it: a kinematic body.</summary>
[StructLayout(LayoutKind.Sequential, Size = 32)]
public struct BodyInertia
{
    /// <summary>Inverse of the inertia tensor around the centre of mass, 1/(kg m2).</summary>
    public Symmetric3x3 InverseInertiaTensor;
    /// <summary>Inverse of the mass, 1/kg.</summary>
    public float InverseMass;
}

/// <summary>Inverse inertia of a body in its own frame and in world space.</summary>
[StructLayout(LayoutKind.Sequential, Size = 64)]
public struct BodyInertias
{
    /// <summary>In the frame of the body.</summary>
    public BodyInertia Local;
    /// <summary>In world axes, for the current orientation; valid only while the solver runs.</summary>
    public BodyInertia World;
}

/// <summary>Everything about a body that the solver reads or writes: two cache lines.</summary>
[StructLayout(LayoutKind.Sequential, Size = 128)]
public struct BodyDynamics
{
    /// <summary>Pose and velocity.</summary>
    public MotionState Motion;
    /// <summary>Inverse mass and inertia.</summary>
    public BodyInertias Inertia;
}
