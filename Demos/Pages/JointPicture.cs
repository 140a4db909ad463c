using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using System.Reflection;
using BepuPhysics.Constraints;

namespace Demos.Pages;

/// <summary>
/// Draws the example of a joint. There is one drawing for all: what a field is can be told from its type and its name - offsets are arms from the centre of a
/// body, axes and velocities are arrows, rotations are frames -, and how the bodies can move is tried.
/// </summary>
sealed class JointPicture
{
    const string Names = "ABCD";
    const string Free = "#2a8f3c", Acting = "#b02a8f";
    const float ArrowLength = 0.55f, FrameLength = 0.3f;

    static readonly string[] colours = ["#1f5fa8", "#c4501b", "#6b6b6b", "#7a4aa0"];
    static readonly string[] measures = ["Distance", "Area", "Volume"];

    readonly JointFacts facts;
    readonly object description;
    readonly SvgView view;
    readonly Dictionary<FieldInfo, Vector3> anchors = [];

    public JointPicture(JointFacts facts)
    {
        this.facts = facts;
        using JointStage stage = new(facts);
        description = stage.Describe(facts);
        var places = JointStage.Places.Take(facts.BodyCount).ToArray();
        var middle = (places.Aggregate(Vector3.Max) + places.Aggregate(Vector3.Min)) / 2;
        view = new(560, facts.BodyCount > 2 ? 460 : 340, middle, 130);
        foreach (var field in facts.Fields.Where(IsPoint))
            anchors.Add(field, Place(field) + (Vector3)field.GetValue(description)!);
        Motions = JointMotion.Find(facts, AnchorOf(JointMotion.MovingBody(facts)));
    }

    /// <summary>The motions that the picture shows.</summary>
    public List<JointMotion> Motions { get; }

    /// <summary>The picture as the text of a file.</summary>
    public string ToSvg()
    {
        foreach (int body in Enumerable.Range(0, facts.BodyCount).OrderBy(i => SvgView.Nearness(JointStage.Places[i])))
        {
            view.Box(JointStage.Places[body], JointStage.Size, colours[body]);
            view.Label(JointStage.Places[body] + JointStage.Size / 2, Names[body..(body + 1)], colours[body]);
        }
        DrawLinks();
        DrawMotions();
        foreach (var (field, anchor) in anchors)
        {
            view.Line([Place(field), anchor], colours[BodyOf(field)]);
            view.Dot(anchor, colours[BodyOf(field)]);
            view.Label(anchor, field.Name, colours[BodyOf(field)]);
        }
        foreach (var field in facts.Fields)
            DrawDirections(field);
        view.Caption(facts.Kind == RowKind.Equality
            ? $"Green: how {Moving} can move, the other bodies at rest." : $"Purple: the motions of {Moving} on which it acts, the other bodies at rest.");
        return view.ToSvg();
    }

    /// <summary>Name of the body whose motions are shown.</summary>
    public char Moving => Names[JointMotion.MovingBody(facts)];

    void DrawDirections(FieldInfo field)
    {
        var body = BodyOf(field);
        var from = AnchorOf(body);
        switch (field.GetValue(description))
        {
            case Vector3 vector when !IsPoint(field) && vector != default:
                var tip = from + Vector3.Normalize(vector) * ArrowLength;
                view.Arrow(from, tip, colours[body], isDashed: field.Name.Contains("Velocity", StringComparison.Ordinal));
                view.Label(tip, field.Name, colours[body]);
                break;
            case Quaternion rotation:
                foreach (var axis in new[] { Vector3.UnitX, Vector3.UnitY, Vector3.UnitZ })
                    view.Arrow(from, from + Vector3.Transform(axis, rotation) * FrameLength, colours[body]);
                view.Label(from + Vector3.Transform(Vector3.UnitZ, rotation) * FrameLength, field.Name, colours[body]);
                break;
        }
    }

    // What measures distances, areas and volumes measures them between anchors, or centres where there are none; ropes run from anchors to wheels.
    void DrawLinks()
    {
        const string Colour = "#333333";
        var wheels = anchors.Where(pair => IsWheel(pair.Key)).ToArray();
        foreach (var (wheel, place) in wheels)
            view.Line([place, anchors.First(pair => !IsWheel(pair.Key) && pair.Key.Name[^1] == wheel.Name[^1]).Value], Colour, true);
        if (wheels.Length > 1)
            view.Line(wheels.Select(pair => pair.Value), Colour, true);
        if (facts.Fields.Any(field => measures.Any(word => field.Name.Contains(word, StringComparison.Ordinal))))
        {
            for (int i = 0; i < facts.BodyCount; ++i)
            {
                for (int j = 0; j < i; ++j)
                    view.Line([AnchorOf(i), AnchorOf(j)], Colour, true);
            }
        }
    }

    void DrawMotions()
    {
        var colour = facts.Kind == RowKind.Equality ? Free : Acting;
        foreach (var motion in Motions)
        {
            if (motion.IsTurn)
            {
                view.Turn(motion.Point, motion.Direction, 0.22f, colour);
                continue;
            }
            view.Arrow(motion.Point, motion.Point + 0.65f * motion.Direction, colour);
            view.Arrow(motion.Point, motion.Point - 0.65f * motion.Direction, colour);
        }
    }

    Vector3 Place(FieldInfo field) => IsOfBody(field) ? JointStage.Places[BodyOf(field)] : default;

    // Where a joint holds a body.
    Vector3 AnchorOf(int body) => anchors.Where(pair => IsOfBody(pair.Key) && BodyOf(pair.Key) == body).Select(pair => pair.Value)
        .DefaultIfEmpty(JointStage.Places[body]).First();

    // What is neither a direction nor a velocity.
    static bool IsPoint(FieldInfo field) => field.FieldType == typeof(Vector3) &&
        (field.Name == "Target" || field.Name.Contains("Offset", StringComparison.Ordinal) || IsWheel(field));

    static bool IsWheel(FieldInfo field) => field.Name.Contains("Wheel", StringComparison.Ordinal);

    static bool IsOfBody(FieldInfo field) => field.Name.Contains("Local", StringComparison.Ordinal);

    int BodyOf(FieldInfo field)
    {
        if (field.Name.Contains("Housing", StringComparison.Ordinal) || IsWheel(field))
            return 2;
        return facts.BodyCount > 1 && field.Name[^1] == 'B' ? 1 : 0;
    }
}
