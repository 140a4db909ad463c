using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>A patch as rounds of a relaxation see it: all that they need, and nothing that they would have to work out again.</summary>
/// <remarks>
/// <para>
/// Its rows are the normals of up to four contacts, and what is across: friction along two directions, and the twist. Rows lie in lanes. What impulses do to
/// the rows of their own patch is known (<see cref="AmongNormals"/>, <see cref="AcrossByNormals"/>), so the velocities of its bodies are read once, each row
/// is solved on the results of those before it, and the velocities are written once.
/// </para>
/// <para>
/// Rows are in units of impulses: what is to be taken from the impulse of a row for nothing to move along it. So the row that is solved does not change what
/// it was solved for, and its lane keeps it.
/// </para>
/// </remarks>
struct PatchRelaxation
{
    /// <summary>Nodes of its bodies, from the first of the island; that of the lower one is negative where it does not move.</summary>
    public int Upper, Lower;
    /// <summary>Inverse masses of its bodies, 1 / kg.</summary>
    public float UpperMass, LowerMass;
    /// <summary>Impulses along the normal, by contact, N s.</summary>
    public Vector128<float> Normals;
    /// <summary>Friction along the two directions, N s, and the twist, N m s.</summary>
    public Vector128<float> Across;
    /// <summary>What velocities are as impulses along the normals.</summary>
    public RelaxationRows NormalRows;
    /// <summary>What velocities are as impulses across.</summary>
    public RelaxationRows AcrossRows;
    /// <summary>What an impulse of each normal but the last is worth along those that are solved after it, and nothing along the others.</summary>
    public ThreeRowLanes AmongNormals;
    /// <summary>What an impulse of each normal is worth across.</summary>
    public FourRowLanes AcrossByNormals;
    /// <summary>The normal, from the lower to the upper body, and two directions at right angles to it.</summary>
    public Vector128<float> Normal, X, Y;
    /// <summary>Changes of angular velocity by a unit impulse of each row, normals first, of the upper and, the other way round, of the lower body.</summary>
    public SevenRowLanes UpperTurns, LowerTurns;
    /// <summary>Coulomb coefficient times the distance of each contact from where friction acts, m.</summary>
    public Vector128<float> Levers;
    /// <summary>Coulomb coefficient.</summary>
    public float Friction;
    /// <summary>What an impulse of friction along each direction is worth as a twist, m.</summary>
    public float TwistByX, TwistByY;

    /// <summary>Inverse effective masses by which impulses are weighed, to say how much a round has changed.</summary>
    public Vector128<float> NormalWeights, AcrossWeights;
    /// <summary>Impulses before the present round.</summary>
    public Vector128<float> StartNormals, StartAcross;
    /// <summary>Direction in which the next round goes on.</summary>
    public Vector128<float> DirectionNormals, DirectionAcross;

    /// <summary>Describes the patch of a support.</summary>
    /// <param name="support">As it was read, with the impulses that it has come to.</param>
    /// <param name="upper">Of the upper body.</param>
    /// <param name="lower">Of the lower body; zero for what nothing moves.</param>
    internal void Describe(in LoadSupport support, in BodyInertia upper, in BodyInertia lower)
    {
        UpperMass = upper.InverseMass;
        LowerMass = lower.InverseMass;
        Friction = support.Friction;
        var n = support.Normal;
        var x = MathF.Abs(n.X) < 0.7f ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0);
        x = Exact.Normalize(x - n * Exact.Dot(x, n));
        var y = Exact.Cross(n, x);
        (Normal, X, Y) = (n.AsVector128(), x.AsVector128(), y.AsVector128());
        FourFloats impulses = default, levers = default, armX = default, armY = default, armZ = default, bears = default;
        for (int i = 0; i < support.Count; ++i)
        {
            impulses[i] = support.After[i];
            levers[i] = support.Friction * Exact.Distance(support.Arms[i], support.Center);
            // What is open stays as it is.
            if ((support.Open & 1 << i) != 0)
                continue;
            (armX[i], armY[i], armZ[i]) = (support.Arms[i].X, support.Arms[i].Y, support.Arms[i].Z);
            bears[i] = 1;
        }
        Normals = Lanes(impulses);
        Levers = Lanes(levers);
        Across = Vector128.Create(Exact.Dot(support.FrictionAfter, x), Exact.Dot(support.FrictionAfter, y), support.TwistAfter, 0);
        NormalRows.SetNormals(n, Lanes(armX), Lanes(armY), Lanes(armZ), support.ToLower, Lanes(bears));
        AcrossRows.SetAcross(n, x, y, support.Center, support.ToLower);
        FindResponses(upper, lower);
    }

    static Vector128<float> Lanes(FourFloats values) => Unsafe.BitCast<FourFloats, Vector128<float>>(values);

    void FindResponses(in BodyInertia upper, in BodyInertia lower)
    {
        var byNormals = NormalRows.Respond(upper, lower);
        var byAcross = AcrossRows.Respond(upper, lower);
        for (int i = 0; i < 4; ++i)
        {
            UpperTurns[i] = byNormals.UpperTurn(i);
            LowerTurns[i] = byNormals.LowerTurn(i);
        }
        for (int i = 0; i < 3; ++i)
        {
            UpperTurns[4 + i] = byAcross.UpperTurn(i);
            LowerTurns[4 + i] = byAcross.LowerTurn(i);
        }
        // Normals, each in the unit of its own impulse.
        NormalWeights = NormalRows.Dot(byNormals);
        var moves = Vector128.GreaterThan(NormalWeights, Vector128<float>.Zero);
        NormalRows.Scale(Vector128.ConditionalSelect(moves, Vector128<float>.One / NormalWeights, Vector128<float>.Zero));
        for (int i = 0; i < 3; ++i)
        {
            var after = Vector128.GreaterThan(Vector128.Create(0, 1, 2, 3), Vector128.Create(i)).AsSingle();
            AmongNormals[i] = NormalRows.Dot(byNormals.Row(i)) & after;
        }
        // Friction, both directions at once.
        var byX = AcrossRows.Dot(byAcross.Row(0));
        var byY = AcrossRows.Dot(byAcross.Row(1));
        float xx = byX[0], yx = byX[1], yy = byY[1];
        var inverse = 1 / (xx * yy - yx * yx);
        var turn = AcrossRows.Dot(byAcross.Row(2))[2];
        var twistMass = turn > 0 ? 1 / turn : 0;
        AcrossRows.Mix(Vector128.Create(yy * inverse, xx * inverse, twistMass, 0), Vector128.Create(-yx * inverse, -yx * inverse, 0, 0));
        var weight = 2 / (xx * inverse + yy * inverse);
        AcrossWeights = Vector128.Create(weight, weight, turn > 0 ? turn : 0, 0);
        for (int i = 0; i < 4; ++i)
            AcrossByNormals[i] = AcrossRows.Dot(byNormals.Row(i));
        TwistByX = AcrossRows.Dot(byAcross.Row(0))[2];
        TwistByY = AcrossRows.Dot(byAcross.Row(1))[2];
    }

    /// <summary>Solves its rows one after the other, within their bounds.</summary>
    /// <param name="bodies">Of its island, after one that stands for what does not move.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    internal unsafe void Solve(BodyRelaxation* bodies)
    {
        var upper = bodies + Upper;
        var lower = bodies + Lower;
        var apart = upper->Linear - lower->Linear;
        Vector128<float> turnUpper = upper->Angular, turnLower = lower->Angular;
        Vector128<float> had = Normals, hadAcross = Across;
        var normals = had - NormalRows.Velocities(apart, turnUpper, turnLower);
        var across = hadAcross - AcrossRows.Velocities(apart, turnUpper, turnLower);

        var change = Bearing(RowLanes.First(normals)) - RowLanes.First(had);
        normals -= AmongNormals[0] * change;
        across -= AcrossByNormals[0] * change;
        var sum = change;
        turnUpper += UpperTurns[0] * change;
        turnLower -= LowerTurns[0] * change;

        change = Bearing(RowLanes.Second(normals)) - RowLanes.Second(had);
        normals -= AmongNormals[1] * change;
        across -= AcrossByNormals[1] * change;
        sum += change;
        turnUpper += UpperTurns[1] * change;
        turnLower -= LowerTurns[1] * change;

        change = Bearing(RowLanes.Third(normals)) - RowLanes.Third(had);
        normals -= AmongNormals[2] * change;
        across -= AcrossByNormals[2] * change;
        sum += change;
        turnUpper += UpperTurns[2] * change;
        turnLower -= LowerTurns[2] * change;

        change = Bearing(RowLanes.Fourth(normals)) - RowLanes.Fourth(had);
        across -= AcrossByNormals[3] * change;
        sum += change;
        turnUpper += UpperTurns[3] * change;
        turnLower -= LowerTurns[3] * change;

        normals = Bearing(normals);
        Normals = normals;
        var lever = RowLanes.Sum(normals * Levers);
        LimitFriction(across, Friction * RowLanes.Sum(normals), out var x, out var y);
        float changeX = x - hadAcross[0], changeY = y - hadAcross[1];
        var twist = across[2] - (TwistByX * changeX + TwistByY * changeY);
        twist = MathHelper.Max(-lever, MathHelper.Min(lever, twist));
        Across = Vector128.Create(x, y, twist, 0);
        Vector128<float> byX = Vector128.Create(changeX), byY = Vector128.Create(changeY), byTwist = Vector128.Create(twist - hadAcross[2]);
        var linear = Normal * sum + X * byX + Y * byY;
        upper->Linear += linear * Vector128.Create(UpperMass);
        upper->Angular = turnUpper + (UpperTurns[4] * byX + UpperTurns[5] * byY + UpperTurns[6] * byTwist);
        if (Lower < 0)
            return;
        lower->Linear -= linear * Vector128.Create(LowerMass);
        lower->Angular = turnLower - (LowerTurns[4] * byX + LowerTurns[5] * byY + LowerTurns[6] * byTwist);
    }

    // Friction is within its limit in any direction.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static void LimitFriction(Vector128<float> across, float limit, out float x, out float y)
    {
        (x, y) = (across[0], across[1]);
        var squared = x * x + y * y;
        if (squared <= limit * limit)
            return;
        var scale = limit / MathF.Sqrt(squared);
        x *= scale;
        y *= scale;
    }

    /// <summary>Impulses across within the bounds that normals give them.</summary>
    internal readonly Vector128<float> Limit(Vector128<float> across, Vector128<float> normals)
    {
        var lever = RowLanes.Sum(normals * Levers);
        LimitFriction(across, Friction * RowLanes.Sum(normals), out var x, out var y);
        return Vector128.Create(x, y, MathHelper.Max(-lever, MathHelper.Min(lever, across[2])), 0);
    }

    // No contact pulls.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    static Vector128<float> Bearing(Vector128<float> impulses) => RowLanes.Max(impulses, Vector128<float>.Zero);

    /// <summary>What the round has changed: the squares of the impulses over the masses that they move, by lanes.</summary>
    internal readonly Vector128<float> Change()
    {
        Vector128<float> normals = Normals - StartNormals, across = Across - StartAcross;
        return normals * normals * NormalWeights + across * across * AcrossWeights;
    }

    /// <summary>Begins the first round.</summary>
    internal void Begin()
    {
        (StartNormals, StartAcross) = (Normals, Across);
        DirectionNormals = DirectionAcross = default;
    }

    /// <summary>Goes on by a share of the direction of the rounds before, and takes what this round has changed into the direction.</summary>
    internal void Follow(Vector128<float> share)
    {
        RowLanes.Follow(ref Normals, ref StartNormals, ref DirectionNormals, share);
        RowLanes.Follow(ref Across, ref StartAcross, ref DirectionAcross, share);
    }

    /// <summary>Impulses that lanes stand for.</summary>
    internal readonly PatchImpulses Impulses(Vector128<float> normals, Vector128<float> across) => new()
    {
        Normals = Unsafe.BitCast<Vector128<float>, FourFloats>(normals),
        Friction = X.AsVector3() * across[0] + Y.AsVector3() * across[1],
        Twist = across[2],
    };
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
