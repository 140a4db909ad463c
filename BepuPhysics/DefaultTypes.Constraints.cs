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
        solver.Register<AngularHinge>();
        solver.Register<AngularSwivelHinge>();
        solver.Register<AreaConstraint>();
        solver.Register<BallSocket>();
        solver.Register<CenterDistanceConstraint>();
        solver.Register<Gear>();
        solver.Register<Hinge>();
        solver.Register<Rack>();
        solver.Register<Slider>();
        solver.Register<SwivelHinge>();
        solver.Register<VolumeConstraint>();
        solver.Register<Weld>();
        solver.Register<CenterDistanceLimit>();
        solver.Register<DistanceLimit>();
        solver.Register<LinearAxisLimit>();
        solver.Register<Pulley>();
        solver.Register<SwingLimit>();
        solver.Register<TwistLimit>();
        solver.Register<AngularServo>();
        solver.Register<BallSocketServo>();
        solver.Register<DistanceServo>();
        solver.Register<LinearAxisServo>();
        solver.Register<OneBodyAngularServo>();
        solver.Register<OneBodyLinearServo>();
        solver.Register<PointOnLineServo>();
        solver.Register<TwistServo>();
        solver.Register<AngularAxisGearMotor>();
        solver.Register<AngularAxisMotor>();
        solver.Register<AngularMotor>();
        solver.Register<BallSocketMotor>();
        solver.Register<LinearAxisMotor>();
        solver.Register<OneBodyAngularMotor>();
        solver.Register<OneBodyLinearMotor>();
        solver.Register<TwistMotor>();
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
