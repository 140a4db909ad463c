namespace BepuPhysics.Constraints;

/// <summary>Ids of the constraint types of the library. Contacts come first, so that they can be told from joints by their id.</summary>
public static class ConstraintTypeIds
{
    /// <summary>Ids below this one are contacts.</summary>
    public const int ContactTypeCount = 22;

    internal const int ContactTwoBody = 4;
    internal const int BallSocket = 22;
    internal const int AngularHinge = 23;
    internal const int AngularSwivelHinge = 24;
    internal const int SwingLimit = 25;
    internal const int TwistServo = 26;
    internal const int TwistLimit = 27;
    internal const int TwistMotor = 28;
    internal const int AngularServo = 29;
    internal const int AngularMotor = 30;
    internal const int Weld = 31;
    internal const int VolumeConstraint = 32;
    internal const int DistanceServo = 33;
    internal const int DistanceLimit = 34;
    internal const int CenterDistanceConstraint = 35;
    internal const int AreaConstraint = 36;
    internal const int PointOnLineServo = 37;
    internal const int LinearAxisServo = 38;
    internal const int LinearAxisMotor = 39;
    internal const int LinearAxisLimit = 40;
    internal const int AngularAxisMotor = 41;
    internal const int OneBodyAngularServo = 42;
    internal const int OneBodyAngularMotor = 43;
    internal const int OneBodyLinearServo = 44;
    internal const int OneBodyLinearMotor = 45;
    internal const int SwivelHinge = 46;
    internal const int Hinge = 47;
    internal const int BallSocketMotor = 52;
    internal const int BallSocketServo = 53;
    internal const int AngularAxisGearMotor = 54;
    internal const int CenterDistanceLimit = 55;
    // From here on, bepuphysics2 has none.
    internal const int Slider = 56;
    internal const int Gear = 57;
    internal const int Rack = 58;
    internal const int Pulley = 59;
    // Registered by character controllers alone.
    internal const int StaticCharacterMotion = 60;
    internal const int DynamicCharacterMotion = 61;

    /// <summary>Type id of a convex contact constraint.</summary>
    /// <param name="contactCount">Number of contacts, 1 to 4.</param>
    /// <param name="bodyCount">Number of bodies, 1 or 2.</param>
    internal static int ConvexContact(int contactCount, int bodyCount) => (bodyCount - 1) * 4 + contactCount - 1;

    /// <summary>Number of contacts of a convex contact constraint.</summary>
    internal static int ContactCount(int typeId) => typeId % 4 + 1;
}
