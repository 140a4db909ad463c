using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using BepuPhysics.Constraints;
using Demos.Accuracy;
using Demos.References;

namespace Demos.Mechanisms;

/// <summary>A soft block of 27 balls that falls: tetrahedra keep their volume, edges pull softly, and triangles of its top keep their area.</summary>
sealed class NewtBlock : Mechanism
{
    const int Side = 3;
    const float Spacing = .5f, BallRadius = .12f;
    static readonly Vector3 start = new(-.5f, 1, -.5f);

    readonly BodyHandle[] nodes = new BodyHandle[Side * Side * Side];
    readonly List<int[]> tetrahedra = [], triangles = [];

    public NewtBlock(AccuracySettings settings) : base(settings)
    {
        World.AddGround();
        for (int i = 0; i < nodes.Length; ++i)
            nodes[i] = World.AddDynamic(new Sphere(BallRadius), 1, new RigidPose(Place(i)));
        var edge = new SpringSettings(6, .5f);
        for (int i = 0; i < nodes.Length; ++i)
        {
            foreach (int axis in (int[])[1, Side, Side * Side])
            {
                if (i / axis % Side < Side - 1)
                    Solver.Add(nodes[i], nodes[i + axis], new CenterDistanceConstraint(Spacing, edge));
            }
            if (i % Side < Side - 1 && i / Side % Side < Side - 1 && i / (Side * Side) < Side - 1)
                AddCube(i);
        }
    }

    public override int StepCount => 360;

    public override IEnumerable<Finding> Findings =>
    [
        new("volume, parts of what it was", Sum(tetrahedra, Volume) / Math.Pow((Side - 1) * Spacing, 3), .97, 1.03),
        new("area of its top, parts of what it was", Sum(triangles, Area) / Math.Pow((Side - 1) * Spacing, 2), .97, 1.03),
        new("height of its top, m", World.Position(nodes[Side * (Side - 1) + Side * Side + 1]).Y, .7, 1.3),
        new("energy gained, parts of the greatest motion", EnergyGained / GreatestMotion, 0, .01),
    ];

    static Vector3 Place(int node) => start + new Vector3(node % Side, node / Side % Side, node / (Side * Side)) * Spacing;

    // Six tetrahedra along the ways from one corner of a cube to the opposite one, an axis at a time in each order: those of neighbours fit.
    void AddCube(int corner)
    {
        int[] axes = [1, Side, Side * Side];
        for (int first = 0; first < 3; ++first)
        {
            for (int second = 0; second < 3; ++second)
            {
                if (second == first)
                    continue;
                int a = corner + axes[first], b = a + axes[second], c = corner + axes[0] + axes[1] + axes[2];
                tetrahedra.Add([corner, a, b, c]);
                Solver.Add(nodes[corner], nodes[a], nodes[b], nodes[c], new VolumeConstraint(Place(corner), Place(a), Place(b), Place(c), default));
            }
        }
        int above = corner + Side;
        if (above / Side % Side < Side - 1)
            return;
        foreach (int middle in (int[])[above + 1, above + Side * Side])
        {
            int last = above + 1 + Side * Side;
            triangles.Add([above, middle, last]);
            Solver.Add(nodes[above], nodes[middle], nodes[last], new AreaConstraint(Place(above), Place(middle), Place(last), new SpringSettings(15, 1)));
        }
    }

    double Sum(List<int[]> parts, Func<Double3[], double> measure)
    {
        double sum = 0;
        foreach (int[] part in parts)
            sum += measure(Array.ConvertAll(part, node => World.Position(nodes[node])));
        return sum;
    }

    // Half of the orders are mirror images, and what is turned inside out would count against the others only if signs were kept: it is seen by the height.
    static double Volume(Double3[] p) => Math.Abs(Double3.Dot(Double3.Cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0])) / 6;

    static double Area(Double3[] p) => Double3.Cross(p[1] - p[0], p[2] - p[0]).Length / 2;
}
