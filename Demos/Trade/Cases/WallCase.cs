using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;
using BepuPhysics.Collidables;
using Demos.Accuracy;
using Demos.References;

namespace Demos.Trade.Cases;

/// <summary>A wall of bricks in running bond, half bricks at the ends of every other row: it stays where it is.</summary>
sealed class WallCase : TradeCase
{
    const int Columns = 16, Rows = 10;
    const float Length = .5f, Height = .25f, Depth = .25f;

    readonly List<(BodyHandle Body, Double3 Start)> bricks = [];

    public WallCase(AccuracySettings settings) : base(settings)
    {
        World.AddGround();
        for (int row = 0; row < Rows; ++row)
        {
            bool shifted = row % 2 == 1;
            float end = -Columns * Length / 2;
            for (int i = 0; i < (shifted ? Columns + 1 : Columns); ++i)
            {
                bool isHalf = shifted && i is 0 or Columns;
                float length = isHalf ? Length / 2 : Length;
                AddBrick(new Vector3(end + length / 2, (row + .5f) * Height, 0), length, isHalf ? 5 : 10);
                end += length;
            }
        }
    }

    public override int StepCount => 600;

    /// <summary>The deepest drop of a brick and the farthest sideways way of one; more than the length of a brick is a wall that fell.</summary>
    public override double Error
    {
        get
        {
            double loss = 0, drift = 0;
            foreach ((BodyHandle body, Double3 start) in bricks)
            {
                Double3 way = World.Position(body) - start;
                loss = Tally.Most(loss, -way.Y);
                drift = Tally.Most(drift, Math.Sqrt(way.X * way.X + way.Z * way.Z));
            }
            return OrBroken(loss + drift, Length);
        }
    }

    void AddBrick(Vector3 center, float length, float mass)
    {
        BodyHandle body = World.AddDynamic(new Box(length, Height, Depth), mass, new RigidPose(center));
        bricks.Add((body, center));
    }
}
