using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>The mathematics of one constraint type, for a bundle of constraints at a time.</summary>
/// <typeparam name="TBodies">Bodies that a constraint connects.</typeparam>
/// <typeparam name="TPrestep">Wide form of the constraint's description.</typeparam>
/// <typeparam name="TImpulses">Accumulated impulses, kept from step to step.</typeparam>
/// <remarks>
/// Lanes are independent constraints and stay so: what happens in a lane depends on its inputs alone. Joints do not implement this
/// but <see cref="IJoint{TBodies, TPrestep, TGeometry, TRows, TMass}"/>, from which
/// <see cref="JointConstraint{TBodies, TPrestep, TGeometry, TRows, TMass, TJoint}"/>
/// makes the two functions.
/// </remarks>
public interface IConstraint<TBodies, TPrestep, TImpulses>
    where TBodies : unmanaged, IBodySlots where TPrestep : unmanaged where TImpulses : unmanaged
{
    /// <summary>Parts of the bodies that <see cref="WarmStart"/> reads.</summary>
    static abstract BodyAccess WarmStartAccess { get; }
    /// <summary>Parts of the bodies that <see cref="Solve"/> reads.</summary>
    static abstract BodyAccess SolveAccess { get; }

    /// <summary>Whether the constraint pulls at points of its bodies, so that its load stiffens their rotation.</summary>
    static virtual bool CarriesPointLoad => false;

    /// <summary>Whether correcting the position may turn bodies far, so that it is asked once per step where it does. Only of types that make hubs.</summary>
    static virtual bool MayTurnFar => false;

    /// <summary>Whether a gap that the constraint is added with closes slowly. Only of types that <see cref="MayTurnFar"/>.</summary>
    static virtual bool ClosesGaps => false;

    /// <summary>
    /// Square of the way that a body goes, in its radii of gyration or in radians, to close what the constraint is off by; zero where that is little, or no
    /// more than its load makes of it. Asked for only where <see cref="ClosesGaps"/>.
    /// </summary>
    /// <param name="bodies">The bodies, with their velocities.</param>
    /// <param name="substep">The substep.</param>
    /// <param name="prestep">Description.</param>
    /// <param name="impulses">Accumulated impulses.</param>
    /// <param name="opens">Receives lanes in which the bodies move so that there will be more of it.</param>
    static virtual Vector<float> GapSquared(
        in TBodies bodies, in Substep substep, in TPrestep prestep, in TImpulses impulses, out Vector<int> opens)
    {
        opens = Vector<int>.Zero;
        return Vector<float>.Zero;
    }

    /// <summary>Whether several constraints of the type on one body make it a hub.</summary>
    static virtual bool MakesHubs => false;

    /// <summary>
    /// Geometric stiffness of the constraint's load on its first and its last body, and lanes in which correcting the position may turn a body far; asked for
    /// only where <see cref="CarriesPointLoad"/> or <see cref="MayTurnFar"/>.
    /// </summary>
    /// <returns>Whether there is any in any lane that a substep might not resolve.</returns>
    static virtual bool TryGetGeometricStiffness(
        in TBodies bodies, in Substep substep, in TPrestep prestep, in TImpulses impulses, out Symmetric3x3Wide stiffnessA, out Symmetric3x3Wide stiffnessB,
        out Vector<int> turnsFar)
    {
        turnsFar = Vector<int>.Zero;
        stiffnessA = stiffnessB = default;
        return false;
    }

    /// <summary>Whether the description holds places of the world, which <see cref="ShiftOrigin"/> moves.</summary>
    static virtual bool HasPlaces => false;

    /// <summary>Moves the places of the world that the description holds, if <see cref="HasPlaces"/>, to where they are seen from a new origin.</summary>
    /// <param name="prestep">The description.</param>
    /// <param name="shift">Where the new origin is, m: taken from each place. Zero in lanes that are not in use.</param>
    static virtual void ShiftOrigin(ref TPrestep prestep, in Vector3Wide shift) { }

    /// <summary>Applies the impulses that earlier substeps accumulated.</summary>
    static abstract void WarmStart(ref TBodies bodies, in Substep substep, ref TPrestep prestep, ref TImpulses impulses);

    /// <summary>Moves the velocities of the bodies towards satisfying the constraint.</summary>
    static abstract void Solve(ref TBodies bodies, in Substep substep, ref TPrestep prestep, ref TImpulses impulses);

    // What light bodies between heavy ones are found by (LinkInertia.cs): whether turning a body takes the other one along, the arms on which it
    // does, and lanes in which it does whatever they weigh.
    internal static virtual bool TakesAlong => false;

    internal static virtual Vector<int> IsFirm(in TPrestep prestep) => Vector<int>.Zero;

    internal static virtual void ReadArms(
        in TBodies bodies, in TPrestep prestep, in TImpulses impulses, out Vector3Wide armA, out Vector3Wide armB) => armA = armB = default;

    // What errors, separations and rigid errors below are told by; of the last, velocities besides.
    internal static virtual BodyAccess ErrorAccess => BodyAccess.None;

    // What a governor of substeps reads: how far the constraint is from being met, m; zero where it is met, and where it is not meant to be rigid.
    internal static virtual bool HasError => false;

    internal static virtual Vector<float> Error(in TBodies bodies, in TPrestep prestep) => Vector<float>.Zero;

    // What a game reads: how far the bodies are from where they are held, along directions and about axes; zero for what holds no place.
    internal static virtual bool HasSeparation => false;

    internal static virtual void Separation(in TBodies bodies, in TPrestep prestep, out Vector<float> linear, out Vector<float> angular) =>
        linear = angular = Vector<float>.Zero;

    // What tells whether sweeps hold the constraint (JointNeed.cs); zero where it is not meant to be rigid.
    internal static virtual void RigidError(in TBodies bodies, in Substep substep, in TPrestep prestep, out JointErrorWide error) => error = default;

    // What other solvers read. A constraint of a game's own that is no joint has no rows and is swept over.
    internal static virtual int RowCount => 0;

    internal static virtual bool IsLinear(int row) => false;

    internal static virtual RowLimit LimitOf(int row) => RowLimit.None;

    internal static virtual void ReadRows(
        in TBodies bodies, in Substep substep, in TPrestep prestep, in TImpulses impulses, Span<ConstraintRowWide> rows)
    {
    }

    internal static virtual void WriteImpulses(in TPrestep prestep, ReadOnlySpan<Vector<float>> rows, Vector<int> lanes, ref TImpulses impulses)
    {
    }
}
