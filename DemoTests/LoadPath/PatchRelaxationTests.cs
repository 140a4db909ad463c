using System;
using System.Numerics;
using System.Runtime.Intrinsics;
using BepuPhysics;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
using Demos.References;
using DemoTests.Support;
using Xunit;

namespace DemoTests.LoadPath;

/// <summary>A patch that is relaxed comes to what its rows come to one after the other, each on the velocities that those before it have left.</summary>
public class PatchRelaxationTests
{
    [Theory, InlineData(true), InlineData(false)]
    public unsafe void A_patch_is_solved_row_by_row(bool hasLower)
    {
        var random = new ConvexRandom(7);
        var bodies = stackalloc BodyRelaxation[3];
        for (int run = 0; run < 200; ++run)
        {
            var support = RandomSupport(random);
            bodies[0] = default;
            BodyInertia upper = RandomInertia(random), lower = hasLower ? RandomInertia(random) : default;
            var patch = new PatchRelaxation { Upper = 0, Lower = hasLower ? 1 : -1 };
            patch.Describe(support, upper, lower);
            for (int body = 1; body <= (hasLower ? 2 : 1); ++body)
            {
                bodies[body].Linear = RandomVector(random, 1).AsVector128();
                bodies[body].Angular = RandomVector(random, 1).AsVector128();
            }
            var reference = new Reference(support, upper, lower, bodies[1], bodies[hasLower ? 2 : 0]);
            reference.Solve(patch.X.AsVector3(), patch.Y.AsVector3());
            patch.Solve(bodies + 1);
            for (int i = 0; i < support.Count; ++i)
                Assert.Equal(reference.Normals[i], patch.Normals[i], 1e-4);
            Assert.Equal(reference.X, patch.Across[0], 1e-4);
            Assert.Equal(reference.Y, patch.Across[1], 1e-4);
            Assert.Equal(reference.Twist, patch.Across[2], 1e-4);
            AssertSame(reference.UpperLinear, bodies[1].Linear);
            AssertSame(reference.UpperAngular, bodies[1].Angular);
            AssertSame(hasLower ? reference.LowerLinear : default, bodies[hasLower ? 2 : 0].Linear);
            AssertSame(hasLower ? reference.LowerAngular : default, bodies[hasLower ? 2 : 0].Angular);
        }
    }

    static void AssertSame(Double3 expected, Vector128<float> actual)
    {
        var difference = expected - actual.AsVector3();
        Assert.InRange(Math.Sqrt(Double3.Dot(difference, difference)), 0, 1e-4);
    }

    static LoadSupport RandomSupport(ConvexRandom random)
    {
        var support = new LoadSupport
        {
            Count = 1 + random.Next(4),
            Open = random.Next(16),
            Friction = (float)random.Next(0, 1),
            Normal = Vector3.Normalize(RandomVector(random, 1)),
            Center = RandomVector(random, 0.5f),
            ToLower = RandomVector(random, 1),
            TwistAfter = (float)random.Next(-0.1, 0.1),
        };
        for (int i = 0; i < support.Count; ++i)
        {
            support.Arms[i] = RandomVector(random, 0.5f);
            support.After[i] = (float)random.Next(0, 1);
        }
        var friction = RandomVector(random, 0.3f);
        support.FrictionAfter = friction - support.Normal * Vector3.Dot(friction, support.Normal);
        return support;
    }

    static Vector3 RandomVector(ConvexRandom random, float size) =>
        new Vector3((float)random.Next(-1, 1), (float)random.Next(-1, 1), (float)random.Next(-1, 1)) * size;

    static BodyInertia RandomInertia(ConvexRandom random) => new()
    {
        InverseMass = (float)random.Next(0.5, 2),
        InverseInertiaTensor = new Symmetric3x3(
            (float)random.Next(3, 6), (float)random.Next(-1, 1), (float)random.Next(3, 6), (float)random.Next(-1, 1), (float)random.Next(-1, 1),
            (float)random.Next(3, 6)),
    };

    // By the rows alone, in double precision.
    sealed class Reference(LoadSupport support, BodyInertia upper, BodyInertia lower, BodyRelaxation upperBody, BodyRelaxation lowerBody)
    {
        public readonly double[] Normals = new double[4];
        public double X, Y, Twist;
        public Double3 UpperLinear = upperBody.Linear.AsVector3(), UpperAngular = upperBody.Angular.AsVector3();
        public Double3 LowerLinear = lowerBody.Linear.AsVector3(), LowerAngular = lowerBody.Angular.AsVector3();

        readonly Double3 normal = support.Normal, toLower = support.ToLower;

        public void Solve(Double3 x, Double3 y)
        {
            double load = 0, lever = 0;
            Double3 center = support.Center;
            for (int i = 0; i < support.Count; ++i)
            {
                Double3 arm = support.Arms[i];
                Normals[i] = support.After[i];
                if ((support.Open & 1 << i) == 0)
                {
                    Normals[i] = Math.Max(0, Normals[i] - Velocity(normal, arm) / InverseMass(normal, arm, normal));
                    Push(normal * (Normals[i] - support.After[i]), arm);
                }
                load += Normals[i];
                lever += Normals[i] * Math.Sqrt(Double3.Dot(arm - center, arm - center));
            }
            double xx = InverseMass(x, center, x), xy = InverseMass(x, center, y), yy = InverseMass(y, center, y);
            double vx = Velocity(x, center), vy = Velocity(y, center), determinant = xx * yy - xy * xy;
            Double3 before = support.FrictionAfter;
            X = Double3.Dot(before, x) - (yy * vx - xy * vy) / determinant;
            Y = Double3.Dot(before, y) - (xx * vy - xy * vx) / determinant;
            var scale = Math.Min(1, support.Friction * load / Math.Sqrt(X * X + Y * Y));
            X *= scale;
            Y *= scale;
            Push(x * (X - Double3.Dot(before, x)) + y * (Y - Double3.Dot(before, y)), center);
            var inverseInertia = Double3.Dot(normal, Turn(upper, normal)) + Double3.Dot(normal, Turn(lower, normal));
            var most = support.Friction * lever;
            Twist = Math.Clamp(support.TwistAfter - Double3.Dot(normal, UpperAngular - LowerAngular) / inverseInertia, -most, most);
            UpperAngular += Turn(upper, normal * (Twist - support.TwistAfter));
            LowerAngular -= Turn(lower, normal * (Twist - support.TwistAfter));
        }

        double Velocity(Double3 direction, Double3 arm) => Double3.Dot(direction,
            UpperLinear + Double3.Cross(UpperAngular, arm) - LowerLinear - Double3.Cross(LowerAngular, arm - toLower));

        double InverseMass(Double3 impulse, Double3 arm, Double3 direction) => Double3.Dot(direction,
            impulse * (upper.InverseMass + lower.InverseMass) + Double3.Cross(Turn(upper, Double3.Cross(arm, impulse)), arm) +
            Double3.Cross(Turn(lower, Double3.Cross(arm - toLower, impulse)), arm - toLower));

        void Push(Double3 impulse, Double3 arm)
        {
            UpperLinear += impulse * upper.InverseMass;
            LowerLinear -= impulse * lower.InverseMass;
            UpperAngular += Turn(upper, Double3.Cross(arm, impulse));
            LowerAngular -= Turn(lower, Double3.Cross(arm - toLower, impulse));
        }

        static Double3 Turn(in BodyInertia inertia, Double3 torque)
        {
            var m = inertia.InverseInertiaTensor;
            return new Double3(
                m.XX * torque.X + m.YX * torque.Y + m.ZX * torque.Z, m.YX * torque.X + m.YY * torque.Y + m.ZY * torque.Z,
                m.ZX * torque.X + m.ZY * torque.Y + m.ZZ * torque.Z);
        }
    }
}
