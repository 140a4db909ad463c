using System;
using System.Collections.Generic;

namespace Demos.References;

/// <summary>
/// Rigid bodies held by rods and by pins, under gravity along -y: the equations of motion with Lagrange multipliers, integrated by the classical
/// Runge-Kutta scheme in double precision, with what is held projected back onto its constraints after each step.
/// M a = f + J^T l,  J a = -J' v.  Rows may not depend on each other: a loop in a plane is held in the plane by nothing, since nothing takes it out of it.
/// </summary>
/// <param name="gravity">Downwards, m/s2.</param>
public sealed class ConstrainedBodies(double gravity)
{
    readonly List<ConstrainedBody> bodies = [];
    readonly List<Row> rows = [];

    /// <summary>A row: a distance between two points, or how far apart they are along an axis. Without a body a point is one of the world.</summary>
    readonly record struct Row(int A, Double3 OffsetA, int B, Double3 OffsetB, Double3 Axis, double Length)
    {
        public bool IsRod => Axis == Double3.Zero;
    }

    readonly record struct State(Double3 Position, DoubleQuaternion Orientation, Double3 Linear, Double3 Angular);

    State[] states = [];

    /// <summary>J.</summary>
    public double KineticEnergy
    {
        get
        {
            double energy = 0;
            for (int i = 0; i < bodies.Count; ++i)
            {
                Double3 spin = states[i].Orientation.RotateBack(states[i].Angular);
                energy += (bodies[i].Mass * states[i].Linear.LengthSquared + Double3.Dot(Double3.Scale(bodies[i].PrincipalInertia, spin), spin)) / 2;
            }
            return energy;
        }
    }

    /// <summary>Kinetic and potential energy, which is zero at the height of the origin, J.</summary>
    public double Energy
    {
        get
        {
            double energy = KineticEnergy;
            for (int i = 0; i < bodies.Count; ++i)
                energy += bodies[i].Mass * gravity * states[i].Position.Y;
            return energy;
        }
    }

    /// <summary>By how much a row is off at most: of a pin in m, of a rod in half the difference of squared lengths, m2.</summary>
    public double GreatestError
    {
        get
        {
            double greatest = 0;
            foreach (Row row in rows)
                greatest = Math.Max(greatest, Math.Abs(Error(row, states)));
            return greatest;
        }
    }

    /// <summary>Adds a body at rest and returns its number.</summary>
    public int Add(ConstrainedBody body)
    {
        bodies.Add(body);
        states = [.. states, new State(body.Position, body.Orientation, Double3.Zero, Double3.Zero)];
        return bodies.Count - 1;
    }

    /// <summary>Keeps the distance that two points have now. A body of -1 is the world.</summary>
    public void AddRod(int a, Double3 offsetA, int b, Double3 offsetB) =>
        rows.Add(new Row(a, offsetA, b, offsetB, Double3.Zero, (Point(b, offsetB) - Point(a, offsetA)).Length));

    /// <summary>Keeps a point on another one along an axis of the world, a unit vector. A body of -1 is the world.</summary>
    public void AddPin(int a, Double3 offsetA, int b, Double3 offsetB, Double3 axis) => rows.Add(new Row(a, offsetA, b, offsetB, axis, 0));

    /// <summary>Where a point of a body is.</summary>
    public Double3 Point(int body, Double3 offset) => body < 0 ? offset : states[body].Position + states[body].Orientation.Rotate(offset);

    /// <summary>Goes on by a duration, in seconds, in steps of at most another.</summary>
    public void Advance(double duration, double step)
    {
        int count = (int)Math.Ceiling(duration / step - 1e-9);
        for (int i = 0; i < count; ++i)
            Step(duration / count);
    }

    void Step(double h)
    {
        State[] start = states;
        Rate[] k1 = Rates(start), k2 = Rates(Moved(start, k1, h / 2)), k3 = Rates(Moved(start, k2, h / 2)), k4 = Rates(Moved(start, k3, h));
        var mean = new Rate[start.Length];
        for (int i = 0; i < mean.Length; ++i)
            mean[i] = (k1[i] + k2[i] * 2 + k3[i] * 2 + k4[i]) * (1 / 6.0);
        states = Moved(start, mean, h);
        Project();
    }

    readonly record struct Rate(Double3 Position, DoubleQuaternion Orientation, Double3 Linear, Double3 Angular)
    {
        public static Rate operator +(Rate a, Rate b) =>
            new(a.Position + b.Position, a.Orientation + b.Orientation, a.Linear + b.Linear, a.Angular + b.Angular);

        public static Rate operator *(Rate a, double scale) => new(a.Position * scale, a.Orientation * scale, a.Linear * scale, a.Angular * scale);
    }

    static State[] Moved(State[] from, Rate[] rates, double h)
    {
        var moved = new State[from.Length];
        for (int i = 0; i < moved.Length; ++i)
        {
            moved[i] = new State(from[i].Position + rates[i].Position * h, DoubleQuaternion.Normalize(from[i].Orientation + rates[i].Orientation * h),
                from[i].Linear + rates[i].Linear * h, from[i].Angular + rates[i].Angular * h);
        }
        return moved;
    }

    Rate[] Rates(State[] at)
    {
        var forces = new Wrench[at.Length];
        for (int i = 0; i < at.Length; ++i)
        {
            Double3 spin = at[i].Orientation.RotateBack(at[i].Angular);
            Double3 gyroscopic = at[i].Orientation.Rotate(Double3.Cross(Double3.Scale(bodies[i].PrincipalInertia, spin), spin));
            forces[i] = new Wrench(new Double3(0, -gravity * bodies[i].Mass, 0), gyroscopic);
        }
        Gradient[] gradients = Gradients(at);
        Wrench[] accelerations = Divided(at, forces);
        var wanted = new double[rows.Count];
        for (int i = 0; i < wanted.Length; ++i)
            wanted[i] = -Along(gradients[i], accelerations) - Curvature(rows[i], at);
        Apply(at, gradients, wanted, accelerations);
        var rates = new Rate[at.Length];
        for (int i = 0; i < rates.Length; ++i)
        {
            Double3 w = at[i].Angular;
            rates[i] = new Rate(at[i].Linear, new DoubleQuaternion(w.X, w.Y, w.Z, 0) * at[i].Orientation * .5,
                accelerations[i].Force, accelerations[i].Torque);
        }
        return rates;
    }

    /// <summary>Puts places and velocities back where the rows hold them, by the least change that the masses allow.</summary>
    void Project()
    {
        const int rounds = 2;
        for (int round = 0; round < rounds; ++round)
        {
            Gradient[] gradients = Gradients(states);
            var change = new Wrench[states.Length];
            var wanted = new double[rows.Count];
            for (int i = 0; i < wanted.Length; ++i)
                wanted[i] = -Error(rows[i], states);
            Apply(states, gradients, wanted, change);
            for (int i = 0; i < states.Length; ++i)
            {
                Double3 turn = change[i].Torque;
                states[i] = states[i] with
                {
                    Position = states[i].Position + change[i].Force,
                    Orientation = DoubleQuaternion.Normalize(
                        states[i].Orientation + new DoubleQuaternion(turn.X, turn.Y, turn.Z, 0) * states[i].Orientation * .5),
                };
            }
        }
        Gradient[] final = Gradients(states);
        var velocities = new Wrench[states.Length];
        for (int i = 0; i < velocities.Length; ++i)
            velocities[i] = new Wrench(states[i].Linear, states[i].Angular);
        var rest = new double[rows.Count];
        for (int i = 0; i < rest.Length; ++i)
            rest[i] = -Along(final[i], velocities);
        Apply(states, final, rest, velocities);
        for (int i = 0; i < states.Length; ++i)
            states[i] = states[i] with { Linear = velocities[i].Force, Angular = velocities[i].Torque };
    }

    /// <summary>A pair of vectors of a body: force and torque, and velocities or accelerations too.</summary>
    readonly record struct Wrench(Double3 Force, Double3 Torque);

    /// <summary>What a row has of its bodies: the same direction with different signs, and a torque for each.</summary>
    readonly record struct Gradient(int A, int B, Wrench OfA, Wrench OfB);

    Gradient[] Gradients(State[] at)
    {
        var gradients = new Gradient[rows.Count];
        for (int i = 0; i < gradients.Length; ++i)
        {
            Row row = rows[i];
            Double3 n = row.IsRod ? Place(row.B, row.OffsetB, at) - Place(row.A, row.OffsetA, at) : row.Axis;
            gradients[i] = new Gradient(row.A, row.B,
                new Wrench(-n, -Double3.Cross(Arm(row.A, row.OffsetA, at), n)), new Wrench(n, Double3.Cross(Arm(row.B, row.OffsetB, at), n)));
        }
        return gradients;
    }

    static double Error(Row row, State[] at)
    {
        Double3 apart = Place(row.B, row.OffsetB, at) - Place(row.A, row.OffsetA, at);
        return row.IsRod ? (apart.LengthSquared - row.Length * row.Length) / 2 : Double3.Dot(row.Axis, apart);
    }

    // What is left of the second derivative of a row's error where no body is accelerated.
    static double Curvature(Row row, State[] at)
    {
        Double3 inwards = Inwards(row.B, row.OffsetB, at) - Inwards(row.A, row.OffsetA, at);
        if (!row.IsRod)
            return Double3.Dot(row.Axis, inwards);
        Double3 apart = Place(row.B, row.OffsetB, at) - Place(row.A, row.OffsetA, at);
        return (Speed(row.B, row.OffsetB, at) - Speed(row.A, row.OffsetA, at)).LengthSquared + Double3.Dot(apart, inwards);
    }

    static Double3 Place(int body, Double3 offset, State[] at) => body < 0 ? offset : at[body].Position + Arm(body, offset, at);

    static Double3 Arm(int body, Double3 offset, State[] at) => body < 0 ? Double3.Zero : at[body].Orientation.Rotate(offset);

    static Double3 Speed(int body, Double3 offset, State[] at) =>
        body < 0 ? Double3.Zero : at[body].Linear + Double3.Cross(at[body].Angular, Arm(body, offset, at));

    static Double3 Inwards(int body, Double3 offset, State[] at) =>
        body < 0 ? Double3.Zero : Double3.Cross(at[body].Angular, Double3.Cross(at[body].Angular, Arm(body, offset, at)));

    static double Along(Gradient row, Wrench[] motion) => Along(row.A, row.OfA, motion) + Along(row.B, row.OfB, motion);

    static double Along(int body, Wrench part, Wrench[] motion) =>
        body < 0 ? 0 : Double3.Dot(part.Force, motion[body].Force) + Double3.Dot(part.Torque, motion[body].Torque);

    Wrench[] Divided(State[] at, Wrench[] forces)
    {
        var divided = new Wrench[forces.Length];
        for (int i = 0; i < forces.Length; ++i)
            divided[i] = Divided(i, at, forces[i]);
        return divided;
    }

    Wrench Divided(int body, State[] at, Wrench wrench)
    {
        if (body < 0)
            return default;
        Double3 inertia = bodies[body].PrincipalInertia, local = at[body].Orientation.RotateBack(wrench.Torque);
        return new Wrench(wrench.Force * (1 / bodies[body].Mass),
            at[body].Orientation.Rotate(new Double3(local.X / inertia.X, local.Y / inertia.Y, local.Z / inertia.Z)));
    }

    /// <summary>Changes motions by what the rows give them so that each row changes by what it wants.</summary>
    void Apply(State[] at, Gradient[] gradients, double[] wanted, Wrench[] motion)
    {
        int count = gradients.Length;
        var matrix = new double[count, count];
        var responses = new (Wrench A, Wrench B)[count];
        for (int j = 0; j < count; ++j)
        {
            Gradient row = gradients[j];
            responses[j] = (Divided(row.A, at, row.OfA), Divided(row.B, at, row.OfB));
            for (int i = 0; i < count; ++i)
                matrix[i, j] = Coupling(gradients[i], row.A, responses[j].A) + Coupling(gradients[i], row.B, responses[j].B);
        }
        double[] impulses = LinearSystem.Solve(matrix, wanted);
        for (int j = 0; j < count; ++j)
        {
            Add(gradients[j].A, responses[j].A, impulses[j]);
            Add(gradients[j].B, responses[j].B, impulses[j]);
        }

        void Add(int body, Wrench response, double impulse)
        {
            if (body >= 0)
                motion[body] = new Wrench(motion[body].Force + response.Force * impulse, motion[body].Torque + response.Torque * impulse);
        }
    }

    static double Coupling(Gradient row, int body, Wrench response)
    {
        double sum = 0;
        if (body >= 0 && row.A == body)
            sum += Double3.Dot(row.OfA.Force, response.Force) + Double3.Dot(row.OfA.Torque, response.Torque);
        if (body >= 0 && row.B == body)
            sum += Double3.Dot(row.OfB.Force, response.Force) + Double3.Dot(row.OfB.Torque, response.Torque);
        return sum;
    }
}
