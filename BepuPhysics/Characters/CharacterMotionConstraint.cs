using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace BepuPhysics.Characters;

/// <summary>What the constraint reads of either description.</summary>
interface ICharacterMotionWide<TSelf> where TSelf : unmanaged, ICharacterMotionWide<TSelf>
{
    static abstract void Read(in TSelf wide, out StaticCharacterMotionWide goal, out Vector3Wide offsetFromSupport);
}

/// <summary>A bundle of <see cref="StaticCharacterMotion"/>, and what <see cref="DynamicCharacterMotion"/> begins with.</summary>
struct StaticCharacterMotionWide : IWide<StaticCharacterMotion>, ICharacterMotionWide<StaticCharacterMotionWide>
{
    public QuaternionWide SurfaceBasis;
    public Vector<float> MaximumHorizontalForce;
    public Vector<float> MaximumVerticalForce;
    public Vector2Wide TargetVelocity;
    public Vector<float> Depth;
    public Vector<float> RisingVelocity;
    public Vector<float> MaximumRisingForce;
    public Vector3Wide OffsetFromCharacterToSupportPoint;

    public static void Read(in StaticCharacterMotionWide wide, out StaticCharacterMotionWide goal, out Vector3Wide offsetFromSupport) =>
        (goal, offsetFromSupport) = (wide, default);
}

/// <summary>A bundle of <see cref="DynamicCharacterMotion"/>: the fields of the other, and where the support is.</summary>
struct DynamicCharacterMotionWide : IWide<DynamicCharacterMotion>, ICharacterMotionWide<DynamicCharacterMotionWide>
{
    public QuaternionWide SurfaceBasis;
    public Vector<float> MaximumHorizontalForce;
    public Vector<float> MaximumVerticalForce;
    public Vector2Wide TargetVelocity;
    public Vector<float> Depth;
    public Vector<float> RisingVelocity;
    public Vector<float> MaximumRisingForce;
    public Vector3Wide OffsetFromCharacterToSupportPoint;
    public Vector3Wide OffsetFromSupportToSupportPoint;

    public static void Read(in DynamicCharacterMotionWide wide, out StaticCharacterMotionWide goal, out Vector3Wide offsetFromSupport) =>
        (goal, offsetFromSupport) =
            (Unsafe.As<DynamicCharacterMotionWide, StaticCharacterMotionWide>(ref Unsafe.AsRef(in wide)), wide.OffsetFromSupportToSupportPoint);
}

/// <summary>Impulses on the character: along the surface's X and Z, and along its Y.</summary>
struct CharacterMotionImpulses
{
    public Vector2Wide Horizontal;
    public Vector<float> Vertical;
}

/// <summary>The mathematics of both, one body or two.</summary>
// u = vA + wA x rA - vB - wB x rB, the velocity of the character's supporting point against the support's; x, y, z the axes of the surface
// rB is to where the character is at the beginning of the substep. To the velocity of the support's point wB x (vA - vB) dt / 2 is added: that of the middle.
// Horizontal: [ x u ; z u ] = [ target.X ; -target.Y ], its impulse no longer than the greatest horizontal force times the substep
// Vertical: y u <= depth / substep, its impulse from minus the greatest vertical force times the substep to 0: it never pushes.
// Where the character rises, y u = rising velocity, its impulse up to the greatest rising force times the substep.
// Each row d has J = [ d, rA x d, -d, -(rB x d) ] and K between rows d and e = (1/mA + 1/mB) d e + (rA x d) IA^-1 (rA x e) + (rB x d) IB^-1 (rB x e).
readonly struct CharacterMotionConstraint<TBodies, TPrestep> : IConstraint<TBodies, TPrestep, CharacterMotionImpulses>
    where TBodies : unmanaged, IBodySlots where TPrestep : unmanaged, ICharacterMotionWide<TPrestep>
{
    public static BodyAccess WarmStartAccess => BodyAccess.Velocity | BodyAccess.Mass | BodyAccess.Displacement;
    public static BodyAccess SolveAccess => BodyAccess.Velocity | BodyAccess.Mass | BodyAccess.Displacement;

    /// <summary>A direction in the world as a row: its lever arms on both bodies.</summary>
    readonly struct Row(Vector3Wide direction, in Vector3Wide offsetA, in Vector3Wide offsetB)
    {
        readonly Vector3Wide direction = direction;
        readonly Vector3Wide angularA = Vector3Wide.Cross(offsetA, direction);
        readonly Vector3Wide angularB = Vector3Wide.Cross(offsetB, direction);

        /// <summary>The part of a velocity that is along the row.</summary>
        public Vector<float> Along(in Vector3Wide velocity) => Vector3Wide.Dot(velocity, direction);

        /// <summary>J v.</summary>
        public Vector<float> Velocity(in TBodies bodies) => Along(bodies, isMotion: false);

        /// <summary>What the bodies have moved along the row since their collision was detected.</summary>
        public Vector<float> Moved(in TBodies bodies) => Along(bodies, isMotion: true);

        Vector<float> Along(TBodies bodies, bool isMotion)
        {
            ref var a = ref BodySlots.At(ref bodies, 0);
            var sum = Vector3Wide.Dot(isMotion ? a.Translation : a.Linear, direction) + Vector3Wide.Dot(isMotion ? a.Rotation : a.Angular, angularA);
            if (TBodies.Count > 1)
            {
                ref var b = ref BodySlots.At(ref bodies, 1);
                sum -= Vector3Wide.Dot(isMotion ? b.Translation : b.Linear, direction) + Vector3Wide.Dot(isMotion ? b.Rotation : b.Angular, angularB);
            }
            return sum;
        }

        /// <summary>J M^-1 J^T between this row and another.</summary>
        public Vector<float> InverseMass(TBodies bodies, in Row other)
        {
            ref var a = ref BodySlots.At(ref bodies, 0);
            var alike = Vector3Wide.Dot(direction, other.direction);
            var sum = a.InverseMass * alike + Vector3Wide.Dot(a.InverseInertia * angularA, other.angularA);
            if (TBodies.Count > 1)
            {
                ref var b = ref BodySlots.At(ref bodies, 1);
                sum += b.InverseMass * alike + Vector3Wide.Dot(b.InverseInertia * angularB, other.angularB);
            }
            return sum;
        }

        /// <summary>v += M^-1 J^T impulse.</summary>
        public void Apply(ref TBodies bodies, Vector<float> impulse)
        {
            ref var a = ref BodySlots.At(ref bodies, 0);
            a.Linear += direction * (impulse * a.InverseMass);
            a.Angular += a.InverseInertia * (angularA * impulse);
            if (TBodies.Count > 1)
            {
                ref var b = ref BodySlots.At(ref bodies, 1);
                b.Linear -= direction * (impulse * b.InverseMass);
                b.Angular -= b.InverseInertia * (angularB * impulse);
            }
        }
    }

    static void Prepare(in TBodies bodies, in TPrestep prestep, out StaticCharacterMotionWide goal, out Row right, out Row up, out Row back)
    {
        TPrestep.Read(prestep, out goal, out var offsetB);
        // The support's point under the character, wherever that has come to: on what turns each point moves another way.
        if (TBodies.Count > 1)
        {
            ref var others = ref Unsafe.AsRef(in bodies);
            offsetB += BodySlots.At(ref others, 0).Translation - BodySlots.At(ref others, 1).Translation;
        }
        right = new(QuaternionWide.TransformUnitX(goal.SurfaceBasis), goal.OffsetFromCharacterToSupportPoint, offsetB);
        up = new(QuaternionWide.TransformUnitY(goal.SurfaceBasis), goal.OffsetFromCharacterToSupportPoint, offsetB);
        back = new(QuaternionWide.TransformUnitZ(goal.SurfaceBasis), goal.OffsetFromCharacterToSupportPoint, offsetB);
    }

    public static void WarmStart(ref TBodies bodies, in Substep substep, ref TPrestep prestep, ref CharacterMotionImpulses impulses)
    {
        Prepare(bodies, prestep, out _, out var right, out var up, out var back);
        // Forces carry over, and the length of the substep may have changed.
        var scale = new Vector<float>(substep.WarmStartScale);
        impulses.Horizontal = new(impulses.Horizontal.X * scale, impulses.Horizontal.Y * scale);
        impulses.Vertical *= scale;
        right.Apply(ref bodies, impulses.Horizontal.X);
        back.Apply(ref bodies, impulses.Horizontal.Y);
        up.Apply(ref bodies, impulses.Vertical);
    }

    public static void Solve(ref TBodies bodies, in Substep substep, ref TPrestep prestep, ref CharacterMotionImpulses impulses)
    {
        // Motors correct no position, so there is nothing to take back.
        if (substep.IsRelaxation)
            return;
        Prepare(bodies, prestep, out var goal, out var right, out var up, out var back);
        SolveHorizontal(ref bodies, substep, goal, right, back, ref impulses.Horizontal);
        SolveVertical(ref bodies, substep, goal, up, ref impulses.Vertical);
    }

    // What the support's point under the character moves faster in the middle of the substep than at its beginning. The way of a substep is straight: who took
    // the tangent on a turntable would go outwards with half of w^2 r dt.
    static Vector3Wide TurnOfSupport(ref TBodies bodies, in Substep substep)
    {
        if (TBodies.Count < 2)
            return default;
        ref var a = ref BodySlots.At(ref bodies, 0);
        ref var b = ref BodySlots.At(ref bodies, 1);
        return Vector3Wide.Cross(b.Angular, (a.Linear - b.Linear) * new Vector<float>(substep.Dt * 0.5f));
    }

    static void SolveHorizontal(
        ref TBodies bodies, in Substep substep, in StaticCharacterMotionWide goal, in Row right, in Row back, ref Vector2Wide impulses)
    {
        Symmetric2x2Wide inverseMass;
        inverseMass.XX = right.InverseMass(bodies, right);
        inverseMass.YX = right.InverseMass(bodies, back);
        inverseMass.YY = back.InverseMass(bodies, back);
        var turn = TurnOfSupport(ref bodies, substep);
        var missing = new Vector2Wide(
            goal.TargetVelocity.X - right.Velocity(bodies) + right.Along(turn), -goal.TargetVelocity.Y - back.Velocity(bodies) + back.Along(turn));
        var change = RowMatrix2.Solve(new(inverseMass), new(missing)).V;
        var previous = impulses;
        Vector2Wide wanted = new(impulses.X + change.X, impulses.Y + change.Y);
        var greatest = goal.MaximumHorizontalForce * substep.Dt;
        var length = wanted.Length();
        var factor = Vector.ConditionalSelect(Vector.GreaterThan(length, greatest), greatest / length, Vector<float>.One);
        impulses = new(wanted.X * factor, wanted.Y * factor);
        right.Apply(ref bodies, impulses.X - previous.X);
        back.Apply(ref bodies, impulses.Y - previous.Y);
    }

    static void SolveVertical(ref TBodies bodies, in Substep substep, in StaticCharacterMotionWide goal, in Row up, ref Vector<float> impulse)
    {
        // What is left of the depth may be used up within the substep.
        var depth = Wide.Max(goal.Depth - up.Moved(bodies), Vector<float>.Zero);
        var rises = Vector.GreaterThan(goal.MaximumRisingForce, Vector<float>.Zero);
        var missing = Vector.ConditionalSelect(rises, goal.RisingVelocity, depth * substep.InverseDt) - up.Velocity(bodies);
        var inverseMass = up.InverseMass(bodies, up);
        var change = Vector.ConditionalSelect(Vector.GreaterThan(inverseMass, Vector<float>.Zero), missing / inverseMass, Vector<float>.Zero);
        var previous = impulse;
        impulse = Wide.Min(Wide.Max(impulse + change, goal.MaximumVerticalForce * -substep.Dt), goal.MaximumRisingForce * substep.Dt);
        up.Apply(ref bodies, impulse - previous);
    }
}
