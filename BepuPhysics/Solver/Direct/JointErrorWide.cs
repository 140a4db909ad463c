using System.Numerics;

namespace BepuPhysics.Constraints;

/// <summary>How far a bundle of joints is off that are meant to be as stiff as can be, and the arms by which that is judged. Zero for others.</summary>
struct JointErrorWide
{
    /// <summary>Lanes of joints that are meant to be as stiff as can be.</summary>
    public Vector<int> RigidMask;
    /// <summary>Length of the error along directions, m, of joints that carry bodies.</summary>
    public Vector<float> Linear;
    /// <summary>Length of the error about axes, rad.</summary>
    public Vector<float> Angular;
    /// <summary>Square of the speed, m/s, with which the error along directions turns.</summary>
    public Vector<float> LinearSlipSquared;
    /// <summary>Square of the speed, rad/s, with which the error about axes turns.</summary>
    public Vector<float> AngularSlipSquared;
    /// <summary>Square of the angular speed of the first body, rad2/s2.</summary>
    public Vector<float> TurnASquared;
    /// <summary>The same of the last body.</summary>
    public Vector<float> TurnBSquared;
    /// <summary>Square of the arm of the first body, m2; of joints that hold no points, of the distance between the first and the last body.</summary>
    public Vector<float> ArmASquared;
    /// <summary>The same of the other bodies.</summary>
    public Vector<float> ArmBSquared;
}
