using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

/// <summary>A bundle of contact constraints of which one at least is listened to, for one step: all lanes are summed up at once.</summary>
unsafe struct ListenedBundle
{
    /// <summary>Where its descriptions, impulses and references are, while the solver runs and until a constraint comes or goes.</summary>
    public Vector<float>* Prestep, Impulses;
    /// <summary>The bodies of its constraints, A before B.</summary>
    public Vector<int>* References;
    public int ContactCount, BodyCount;
    /// <summary>Whether impulses are summed: not where nothing could be told that depends on them.</summary>
    public bool IsMeasured;
    /// <summary>Whether surfaces come together that are still apart.</summary>
    public bool Comes;

    /// <summary>Greatest speed at which surfaces approach before the step, or as they meet in it.</summary>
    public Vector<float> ApproachSpeed;
    /// <summary>Depths of the contacts when collisions were detected.</summary>
    public Few4<Vector<float>> Depths;
    /// <summary>Sums over the substeps: along the normal, contact by contact, and of friction.</summary>
    public Few4<Vector<float>> Normals;
    public Vector3Wide Friction;

    /// <summary>Notes what is so before the first substep.</summary>
    /// <param name="bodies">Bodies as the last step has left them.</param>
    /// <param name="hitSpeed">Speed of approach from which on a touch is a hit.</param>
    /// <param name="isMeasured">Whether impulses are asked for, whatever it does.</param>
    /// <returns>The state of each lane, without impulses.</returns>
    internal Vector<int> Begin(in SolverBodies bodies, float hitSpeed, bool isMeasured)
    {
        var overlap = Vector<int>.Zero;
        for (int i = 0; i < ContactCount; ++i)
        {
            Depths[i] = ((ContactPrestepWide*)Prestep)[i].Depth;
            overlap |= Vector.GreaterThan(Depths[i], Vector<float>.Zero);
            Normals[i] = Vector<float>.Zero;
        }
        var speed = Approach(bodies);
        ApproachSpeed = speed;
        Friction = default;
        var isFast = Vector.GreaterThanOrEqual(speed, new Vector<float>(hitSpeed));
        // What overlaps as in the step before touches whatever it pushes.
        IsMeasured = isMeasured || Vector.LessThanAny(isFast | ~overlap, Vector<int>.Zero);
        Comes = IsMeasured && Vector.LessThanAny(Vector.GreaterThan(speed, Vector<float>.Zero) & ~overlap, Vector<int>.Zero);
        return (overlap & new Vector<int>(ListenedState.Overlaps)) | (isFast & new Vector<int>(ListenedState.IsFast));
    }

    /// <summary>Makes the speeds of approach those at which surfaces meet that are apart. When bodies of the first substep have been integrated.</summary>
    /// <param name="bodies">Bodies, whose velocities have gained what a substep gives.</param>
    /// <param name="hitSpeed">Speed of approach from which on a touch is a hit.</param>
    /// <param name="inverseDt">One over the length of the substep, 1/s.</param>
    /// <returns>Which lanes are fast, as bits of the state.</returns>
    // A velocity is that of the middle of the substep that has ended (Simulation: positions lie on a parabola), and from there on it gains the same all along.
    internal Vector<int> Foresee(in SolverBodies bodies, float hitSpeed, float inverseDt)
    {
        var gain = Approach(bodies) - ApproachSpeed;
        var depth = Depths[0];
        for (int i = 1; i < ContactCount; ++i)
            depth = Wide.Max(depth, Depths[i]);
        var speed = ApproachSpeed + gain * new Vector<float>(0.5f);
        var square = speed * speed - gain * depth * new Vector<float>(2 * inverseDt);
        var comes = Vector.GreaterThan(ApproachSpeed, Vector<float>.Zero) & Vector.LessThan(depth, Vector<float>.Zero) &
            Vector.GreaterThan(square, Vector<float>.Zero);
        ApproachSpeed = Wide.Select(comes, Vector.SquareRoot(square), ApproachSpeed);
        return Vector.GreaterThanOrEqual(ApproachSpeed, new Vector<float>(hitSpeed)) & new Vector<int>(ListenedState.IsFast);
    }

    // Greatest speed at which surfaces approach, at all contacts or at those that have pushed.
    readonly Vector<float> Approach(in SolverBodies bodies, bool pushedOnly = false)
    {
        bodies.Gather(new RowOffsets(References[0]), BodyAccess.Velocity, default, out var a);
        Unsafe.SkipInit(out SolverBodyWide b);
        b.Linear = b.Angular = default;
        if (BodyCount > 1)
            bodies.Gather(new RowOffsets(References[1]), BodyAccess.Velocity, default, out b);
        var normal = *(Vector3Wide*)(Prestep + ContactPrestepLayout.Normal(ContactCount));
        var offsetB = *(Vector3Wide*)(Prestep + ContactPrestepLayout.OffsetB(ContactCount));
        var linearB = Vector3Wide.Dot(b.Linear, normal);
        var linearA = Vector3Wide.Dot(a.Linear, normal);
        var speed = new Vector<float>(float.NegativeInfinity);
        for (int i = 0; i < ContactCount; ++i)
        {
            ref var contact = ref ((ContactPrestepWide*)Prestep)[i];
            // As ContactRow has it.
            var along = linearA + Vector3Wide.Dot(a.Angular, Vector3Wide.Cross(contact.OffsetA, normal))
                + (Vector3Wide.Dot(b.Angular, Vector3Wide.Cross(normal, contact.OffsetA - offsetB)) - linearB);
            var pushed = Vector.GreaterThan(Normals[i], Vector<float>.Zero);
            speed = Wide.Max(speed, pushedOnly ? Wide.Select(pushed, -along, speed) : -along);
        }
        return speed;
    }

    /// <summary>Adds what the present substep has pushed.</summary>
    internal void Sum()
    {
        for (int i = 0; i < ContactCount; ++i)
            Normals[i] += Impulses[i];
        Friction += *(Vector3Wide*)(Impulses + ContactPrestepLayout.FrictionImpulse(ContactCount));
    }

    /// <summary>Which lanes have pushed, and which of their hits go on, when the step ends.</summary>
    /// <param name="bodies">Bodies as the step leaves them.</param>
    /// <param name="hitSpeed">Speed of approach from which on a touch is a hit; with zero all that pushes is one, and none goes on.</param>
    /// <returns>Bits of the state.</returns>
    internal Vector<int> End(in SolverBodies bodies, float hitSpeed)
    {
        var sum = Normals[0];
        for (int i = 1; i < ContactCount; ++i)
            sum += Normals[i];
        var state = Vector.GreaterThan(sum, Vector<float>.Zero) & new Vector<int>(ListenedState.Pushes);
        var fast = Vector.GreaterThanOrEqual(ApproachSpeed, new Vector<float>(hitSpeed));
        if (hitSpeed > 0 && Vector.LessThanAny(fast, Vector<int>.Zero))
            state |= fast & GoesOn(bodies) & new Vector<int>(ListenedState.GoesOn);
        return state;
    }

    // A soft row takes some 70 % of an approach in a substep, so a hit in the last one is not over when the step is. Contacts that have not pushed yet are
    // another hit.
    readonly Vector<int> GoesOn(in SolverBodies bodies)
    {
        const float overShare = 1 / 20f;
        return Vector.GreaterThan(Approach(bodies, pushedOnly: true), ApproachSpeed * new Vector<float>(overShare));
    }
}

/// <summary>What is known of a manifold when the solver has ended, as bits.</summary>
static class ListenedState
{
    /// <summary>A contact was deeper than zero when collisions were detected.</summary>
    internal const int Overlaps = 1;
    /// <summary>It approached as fast as a hit.</summary>
    internal const int IsFast = 2;
    /// <summary>Its contacts pushed.</summary>
    internal const int Pushes = 4;
    /// <summary>It is a hit, and was not over when the step ended.</summary>
    internal const int GoesOn = 8;
}
