using System.Numerics;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Four rows of a patch, one in each lane: along what they are, and their torques about the centres of its bodies.</summary>
/// <remarks>
/// A row with the direction n at the arms r and s about the centres of the upper and the lower body has the velocity
///   n . (v - u) + (r x n) . w - (s x n) . q
/// where v and w are those of the upper body, u and q those of the lower one.
/// </remarks>
struct RelaxationRows
{
    /// <summary>Direction.</summary>
    public Vector128<float> LinearX, LinearY, LinearZ;
    /// <summary>Torque about the centre of the upper body.</summary>
    public Vector128<float> UpperX, UpperY, UpperZ;
    /// <summary>Torque about the centre of the lower body.</summary>
    public Vector128<float> LowerX, LowerY, LowerZ;

    /// <summary>Rows along a normal, of contacts at four arms about the centre of the upper body; zero where a contact does not bear.</summary>
    internal void SetNormals(Vector3 normal, Vector128<float> x, Vector128<float> y, Vector128<float> z, Vector3 toLower, Vector128<float> bears)
    {
        (LinearX, LinearY, LinearZ) = (bears * normal.X, bears * normal.Y, bears * normal.Z);
        UpperX = y * LinearZ - z * LinearY;
        UpperY = z * LinearX - x * LinearZ;
        UpperZ = x * LinearY - y * LinearX;
        x -= Vector128.Create(toLower.X);
        y -= Vector128.Create(toLower.Y);
        z -= Vector128.Create(toLower.Z);
        LowerX = y * LinearZ - z * LinearY;
        LowerY = z * LinearX - x * LinearZ;
        LowerZ = x * LinearY - y * LinearX;
    }

    /// <summary>Rows of friction along two directions, and of the twist about the normal.</summary>
    internal void SetAcross(Vector3 normal, Vector3 x, Vector3 y, Vector3 center, Vector3 toLower)
    {
        Set(x, y, default, out LinearX, out LinearY, out LinearZ);
        Set(Exact.Cross(center, x), Exact.Cross(center, y), normal, out UpperX, out UpperY, out UpperZ);
        center -= toLower;
        Set(Exact.Cross(center, x), Exact.Cross(center, y), normal, out LowerX, out LowerY, out LowerZ);
    }

    static void Set(Vector3 a, Vector3 b, Vector3 c, out Vector128<float> x, out Vector128<float> y, out Vector128<float> z)
    {
        x = Vector128.Create(a.X, b.X, c.X, 0);
        y = Vector128.Create(a.Y, b.Y, c.Y, 0);
        z = Vector128.Create(a.Z, b.Z, c.Z, 0);
    }

    /// <summary>What a unit impulse of each row changes of the velocities of the bodies; of the lower one the other way round.</summary>
    internal readonly RelaxationRows Respond(in BodyInertia upper, in BodyInertia lower)
    {
        RelaxationRows response;
        var mass = upper.InverseMass + lower.InverseMass;
        (response.LinearX, response.LinearY, response.LinearZ) = (LinearX * mass, LinearY * mass, LinearZ * mass);
        Turn(upper.InverseInertiaTensor, UpperX, UpperY, UpperZ, out response.UpperX, out response.UpperY, out response.UpperZ);
        Turn(lower.InverseInertiaTensor, LowerX, LowerY, LowerZ, out response.LowerX, out response.LowerY, out response.LowerZ);
        return response;
    }

    static void Turn(in Symmetric3x3 inertia, Vector128<float> a, Vector128<float> b, Vector128<float> c,
        out Vector128<float> x, out Vector128<float> y, out Vector128<float> z)
    {
        x = a * inertia.XX + b * inertia.YX + c * inertia.ZX;
        y = a * inertia.YX + b * inertia.YY + c * inertia.ZY;
        z = a * inertia.ZX + b * inertia.ZY + c * inertia.ZZ;
    }

    /// <summary>Change of the angular velocity of the upper body by one row, where these are responses.</summary>
    internal readonly Vector128<float> UpperTurn(int row) => Vector128.Create(UpperX[row], UpperY[row], UpperZ[row], 0);

    /// <summary>The same of the lower body, the other way round.</summary>
    internal readonly Vector128<float> LowerTurn(int row) => Vector128.Create(LowerX[row], LowerY[row], LowerZ[row], 0);

    /// <summary>The same row in all lanes.</summary>
    internal readonly RelaxationRows Row(int row) => new()
    {
        LinearX = Vector128.Create(LinearX[row]),
        LinearY = Vector128.Create(LinearY[row]),
        LinearZ = Vector128.Create(LinearZ[row]),
        UpperX = Vector128.Create(UpperX[row]),
        UpperY = Vector128.Create(UpperY[row]),
        UpperZ = Vector128.Create(UpperZ[row]),
        LowerX = Vector128.Create(LowerX[row]),
        LowerY = Vector128.Create(LowerY[row]),
        LowerZ = Vector128.Create(LowerZ[row]),
    };

    /// <summary>Velocities along the rows, by lanes, by responses.</summary>
    internal readonly Vector128<float> Dot(in RelaxationRows response) =>
        LinearX * response.LinearX + LinearY * response.LinearY + LinearZ * response.LinearZ +
        (UpperX * response.UpperX + UpperY * response.UpperY + UpperZ * response.UpperZ) +
        (LowerX * response.LowerX + LowerY * response.LowerY + LowerZ * response.LowerZ);

    /// <summary>Velocities along the rows.</summary>
    /// <param name="apart">Velocity of the upper body less that of the lower one.</param>
    /// <param name="upper">Angular velocity of the upper body.</param>
    /// <param name="lower">Angular velocity of the lower body.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal readonly Vector128<float> Velocities(Vector128<float> apart, Vector128<float> upper, Vector128<float> lower) =>
        (LinearX * RowLanes.First(apart) + LinearY * RowLanes.Second(apart) + LinearZ * RowLanes.Third(apart)) +
        ((UpperX * RowLanes.First(upper) + UpperY * RowLanes.Second(upper) + UpperZ * RowLanes.Third(upper)) -
        (LowerX * RowLanes.First(lower) + LowerY * RowLanes.Second(lower) + LowerZ * RowLanes.Third(lower)));

    /// <summary>Multiplies each row.</summary>
    internal void Scale(Vector128<float> by) => Mix(by, Vector128<float>.Zero);

    /// <summary>Multiplies each row, and adds a multiple of the other one of the first two to each of them.</summary>
    internal void Mix(Vector128<float> by, Vector128<float> byOther)
    {
        (LinearX, LinearY, LinearZ) = (Mix(LinearX, by, byOther), Mix(LinearY, by, byOther), Mix(LinearZ, by, byOther));
        (UpperX, UpperY, UpperZ) = (Mix(UpperX, by, byOther), Mix(UpperY, by, byOther), Mix(UpperZ, by, byOther));
        (LowerX, LowerY, LowerZ) = (Mix(LowerX, by, byOther), Mix(LowerY, by, byOther), Mix(LowerZ, by, byOther));
    }

    static Vector128<float> Mix(Vector128<float> value, Vector128<float> by, Vector128<float> byOther) =>
        value * by + Vector128.Shuffle(value, Vector128.Create(1, 0, 2, 3)) * byOther;
}
