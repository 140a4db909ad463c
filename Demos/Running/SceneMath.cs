using System;
using System.Numerics;

namespace Demos.Running;

/// <summary>
/// The few rotations that placing a scene takes, in double precision and a fixed order: the initial state has to be the same bits on
/// every machine, which the framework's own quaternion products do not promise.
/// </summary>
static class SceneMath
{
    /// <summary>The vector turned by a rotation of length one.</summary>
    public static Vector3 Rotate(Vector3 v, Quaternion q)
    {
        // v + 2 w (u x v) + 2 u x (u x v), with u the vector part.
        (double x, double y, double z, double w) = (q.X, q.Y, q.Z, q.W);
        double tx = 2 * (y * v.Z - z * v.Y), ty = 2 * (z * v.X - x * v.Z), tz = 2 * (x * v.Y - y * v.X);
        return new Vector3(
            (float)(v.X + w * tx + (y * tz - z * ty)),
            (float)(v.Y + w * ty + (z * tx - x * tz)),
            (float)(v.Z + w * tz + (x * ty - y * tx)));
    }

    /// <summary>
    /// The cosine of an angle of zero to pi, by its series for an eighth of the angle and three doublings: the C runtime's is not the
    /// same bits everywhere.
    /// </summary>
    public static double Cosine(double angle)
    {
        double x = angle / 8, squared = x * x, cosine = 1;
        // Seven terms leave 3e-18 at pi / 8; each doubling multiplies what rounding left by four at most.
        for (int term = 14; term > 0; term -= 2)
            cosine = 1 - squared / (term * (term - 1)) * cosine;
        for (int doubling = 0; doubling < 3; ++doubling)
            cosine = 2 * cosine * cosine - 1;
        return cosine;
    }

    /// <summary>The cross product.</summary>
    public static Vector3 Cross(Vector3 a, Vector3 b) => new(
        (float)((double)a.Y * b.Z - (double)a.Z * b.Y),
        (float)((double)a.Z * b.X - (double)a.X * b.Z),
        (float)((double)a.X * b.Y - (double)a.Y * b.X));

    /// <summary>The shortest rotation that takes one direction to another; half a turn about some normal when they are opposite.</summary>
    public static Quaternion Between(Vector3 from, Vector3 to)
    {
        double w = 1 + ((double)from.X * to.X + (double)from.Y * to.Y + (double)from.Z * to.Z);
        Vector3 axis = Cross(from, to);
        // Below this the cross product is rounding only, and any normal will do.
        if (w < 1e-6)
        {
            axis = Math.Abs(from.X) < 0.6f ? Cross(from, Vector3.UnitX) : Cross(from, Vector3.UnitY);
            w = 0;
        }
        double length = Math.Sqrt((double)axis.X * axis.X + (double)axis.Y * axis.Y + (double)axis.Z * axis.Z + w * w);
        return new Quaternion((float)(axis.X / length), (float)(axis.Y / length), (float)(axis.Z / length), (float)(w / length));
    }

    /// <summary>The rotation that takes x and z to the given directions, which are of length one and at a right angle.</summary>
    public static Quaternion Basis(Vector3 x, Vector3 z)
    {
        Quaternion aim = Between(Vector3.UnitZ, z);
        Vector3 aimed = Rotate(Vector3.UnitX, aim);
        Quaternion turn = Between(aimed, x);
        // When x is opposite to where it was aimed, half a turn has to be about z, not about whichever normal came first.
        if (turn.W == 0)
            turn = new Quaternion(z.X, z.Y, z.Z, 0);
        return Concatenate(aim, turn);
    }

    /// <summary>The rotation that does one after another.</summary>
    public static Quaternion Concatenate(Quaternion first, Quaternion second)
    {
        (double ax, double ay, double az, double aw) = (second.X, second.Y, second.Z, second.W);
        (double bx, double by, double bz, double bw) = (first.X, first.Y, first.Z, first.W);
        return new Quaternion(
            (float)(aw * bx + ax * bw + ay * bz - az * by),
            (float)(aw * by - ax * bz + ay * bw + az * bx),
            (float)(aw * bz + ax * by - ay * bx + az * bw),
            (float)(aw * bw - ax * bx - ay * by - az * bz));
    }
}
