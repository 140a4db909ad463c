using System;
using System.Collections.Generic;
using System.Numerics;
using BepuPhysics;

namespace Demos.JointTables;

/// <summary>All linkages: open ones and closed loops, in a plane and in space, each let go from rest.</summary>
static class LinkageLibrary
{
    public static IReadOnlyList<Linkage> All { get; } = [Pendulum(), DoublePendulum(), FourBar(), SliderCrank(), Platform()];

    static Linkage Pendulum()
    {
        var linkage = new Linkage("pendulum", "a bar of 1 m from the horizontal") { WatchedOffset = new Vector3(.5f, 0, 0) };
        linkage.Pin(Linkage.World, linkage.AddBar(default, new(1, 0), 1), default);
        return linkage;
    }

    static Linkage DoublePendulum()
    {
        var linkage = new Linkage("double-pendulum", "two bars of 1 m from the horizontal")
        {
            WatchedBody = 1,
            WatchedOffset = new Vector3(.5f, 0, 0),
            IsPeriodic = false,
        };
        int upper = linkage.AddBar(default, new(1, 0), 1), lower = linkage.AddBar(new(1, 0), new(2, 0), 1);
        linkage.Pin(Linkage.World, upper, default);
        linkage.Pin(upper, lower, new(1, 0));
        return linkage;
    }

    /// <summary>Hangs from two pivots: both arms 1 m, .8 m between their lower ends and 1.2 m between the pivots.</summary>
    static Linkage FourBar()
    {
        const double arm = 1, coupler = .8, half = .6, start = 50 * Math.PI / 180;
        var linkage = new Linkage("four-bar", "two arms of 1 m and a coupler of .8 m that hang from 1.2 m") { WatchedBody = 1 };
        double x = -half + arm * Math.Sin(start), y = -arm * Math.Cos(start);
        // The right arm's end is where circles about the left one's end and the right pivot meet, to the right.
        double dx = half - x, dy = -y, distance = Math.Sqrt(dx * dx + dy * dy);
        double along = (coupler * coupler - arm * arm + distance * distance) / (2 * distance), across = Math.Sqrt(coupler * coupler - along * along);
        Vector2 leftPivot = new((float)-half, 0), rightPivot = new((float)half, 0), left = new((float)x, (float)y);
        var right = new Vector2((float)(x + (dx * along + dy * across) / distance), (float)(y + (dy * along - dx * across) / distance));
        int leftArm = linkage.AddBar(leftPivot, left, 1), bar = linkage.AddBar(left, right, 2), rightArm = linkage.AddBar(right, rightPivot, 1);
        linkage.Pin(Linkage.World, leftArm, leftPivot);
        linkage.Pin(leftArm, bar, left);
        linkage.Pin(bar, rightArm, right);
        linkage.Pin(rightArm, Linkage.World, rightPivot);
        return linkage;
    }

    /// <summary>A crank that hangs, and drives a piston along a line through its pivot.</summary>
    static Linkage SliderCrank()
    {
        const double crank = .5, rod = 1, start = 75 * Math.PI / 180;
        var linkage = new Linkage("slider-crank", "a crank of .5 m, a rod of 1 m, a piston of 1 kg") { WatchedOffset = new Vector3((float)crank / 2, 0, 0) };
        double x = crank * Math.Sin(start), y = -crank * Math.Cos(start);
        Vector2 end = new((float)x, (float)y), slider = new((float)(x + Math.Sqrt(rod * rod - y * y)), 0);
        int crankBar = linkage.AddBar(default, end, 2), rodBar = linkage.AddBar(end, slider, 1);
        int piston = linkage.AddBox(new Vector3(.2f), 1, new RigidPose(new Vector3(slider, 0)));
        linkage.Pin(Linkage.World, crankBar, default);
        linkage.Pin(crankBar, rodBar, end);
        linkage.Pin(rodBar, piston, slider);
        linkage.Guide(piston, slider);
        return linkage;
    }

    /// <summary>A Stewart platform that hangs on its legs, and of which one leg is let go: it can move in one way only.</summary>
    static Linkage Platform()
    {
        var linkage = new Linkage("platform", "a platform of 10 kg that hangs on five of six legs") { WatchedLevel = .255f };
        int body = linkage.AddBox(new Vector3(2, .2f, 2), 10, new RigidPose(new Vector3(0, -2, 0)));
        for (int i = 0; i < 5; ++i)
        {
            // Pairs of legs are near each other above and apart at the platform.
            Vector3 head = Around(1.5, i / 2 * 120 + (i % 2 == 0 ? -15 : 15)), foot = Around(1, i / 2 * 120 + (i % 2 == 0 ? -45 : 45)) - new Vector3(0, 2, 0);
            linkage.Rod(Linkage.World, body, head, foot);
        }
        return linkage;
    }

    static Vector3 Around(double radius, double degrees)
    {
        double angle = degrees * Math.PI / 180;
        return new Vector3((float)(radius * Math.Cos(angle)), 0, (float)(radius * Math.Sin(angle)));
    }
}
