using System.Numerics;

namespace BepuPhysics.Constraints.Contact;

/// <summary>What the relaxation of a patch needs beside its support.</summary>
struct PatchRelaxation
{
    /// <summary>Nodes of its bodies, from the first of the island; that of the lower one is negative where it does not move.</summary>
    public int Upper, Lower;
    /// <summary>Directions at right angles to the normal.</summary>
    public Vector3 X, Y;
    /// <summary>Effective mass of each contact along the normal, kg.</summary>
    public FourFloats Masses;
    /// <summary>Effective mass of friction along the two directions, kg.</summary>
    public float MassXX, MassYX, MassYY;
    /// <summary>Effective moment of inertia about the normal, kg m2; zero where nothing turns.</summary>
    public float TwistMass;

    /// <summary>Impulses before the present round.</summary>
    public PatchImpulses Start;
    /// <summary>Direction in which the next round goes on.</summary>
    public PatchImpulses Direction;
}

/// <summary>Impulses of a patch.</summary>
struct PatchImpulses
{
    /// <summary>Along the normal, by contact, N s.</summary>
    public FourFloats Normals;
    /// <summary>Friction on the upper body, N s.</summary>
    public Vector3 Friction;
    /// <summary>Twist of the upper body about the normal, N m s.</summary>
    public float Twist;
}
