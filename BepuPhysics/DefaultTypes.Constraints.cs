using System.Numerics;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;

namespace BepuPhysics;

/// <summary>Types of the library.</summary>
public static partial class DefaultTypes
{
    /// <summary>Registers the constraint types of the library with a solver.</summary>
    internal static void RegisterDefaults(Solver solver)
    {
        RegisterContacts<Few1<ContactPrestepWide>, Few1<Vector<float>>>(solver, 1);
        RegisterContacts<Few2<ContactPrestepWide>, Few2<Vector<float>>>(solver, 2);
        RegisterContacts<Few3<ContactPrestepWide>, Few3<Vector<float>>>(solver, 3);
        RegisterContacts<Few4<ContactPrestepWide>, Few4<Vector<float>>>(solver, 4);
        solver.EnsureRegistered<AngularHinge>();
        solver.EnsureRegistered<AngularSwivelHinge>();
        solver.EnsureRegistered<AreaConstraint>();
        solver.EnsureRegistered<BallSocket>();
        solver.EnsureRegistered<CenterDistanceConstraint>();
        solver.EnsureRegistered<Gear>();
        solver.EnsureRegistered<Hinge>();
        solver.EnsureRegistered<Rack>();
        solver.EnsureRegistered<Slider>();
        solver.EnsureRegistered<SwivelHinge>();
        solver.EnsureRegistered<VolumeConstraint>();
        solver.EnsureRegistered<Weld>();
        solver.EnsureRegistered<CenterDistanceLimit>();
        solver.EnsureRegistered<DistanceLimit>();
        solver.EnsureRegistered<LinearAxisLimit>();
        solver.EnsureRegistered<Pulley>();
        solver.EnsureRegistered<SwingLimit>();
        solver.EnsureRegistered<TwistLimit>();
        solver.EnsureRegistered<AngularServo>();
        solver.EnsureRegistered<BallSocketServo>();
        solver.EnsureRegistered<DistanceServo>();
        solver.EnsureRegistered<LinearAxisServo>();
        solver.EnsureRegistered<OneBodyAngularServo>();
        solver.EnsureRegistered<OneBodyLinearServo>();
        solver.EnsureRegistered<PointOnLineServo>();
        solver.EnsureRegistered<TwistServo>();
        solver.EnsureRegistered<AngularAxisGearMotor>();
        solver.EnsureRegistered<AngularAxisMotor>();
        solver.EnsureRegistered<AngularMotor>();
        solver.EnsureRegistered<BallSocketMotor>();
        solver.EnsureRegistered<LinearAxisMotor>();
        solver.EnsureRegistered<OneBodyAngularMotor>();
        solver.EnsureRegistered<OneBodyLinearMotor>();
        solver.EnsureRegistered<TwistMotor>();
    }

    static void RegisterContacts<TContacts, TNormals>(Solver solver, int contactCount)
        where TContacts : unmanaged, IFew<ContactPrestepWide> where TNormals : unmanaged, IFew<Vector<float>>
    {
        solver.RegisterProcessor(ConstraintTypeIds.ConvexContact(contactCount, 1), new TypeProcessor<
            OneBody, ConvexContactPrestepWide<TContacts>, ConvexContactImpulsesWide<TNormals>, ConvexContactConstraint<OneBody, TContacts, TNormals>>());
        solver.RegisterProcessor(ConstraintTypeIds.ConvexContact(contactCount, 2), new TypeProcessor<
            TwoBodies, ConvexContactPrestepWide<TContacts>, ConvexContactImpulsesWide<TNormals>, ConvexContactConstraint<TwoBodies, TContacts, TNormals>>());
    }
}
