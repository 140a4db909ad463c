using System;
using System.Numerics;
using BepuUtilities;

namespace BepuPhysics.Constraints.Contact;

/// <summary>What stands on a face of a column: its mass, where that is, how it moves and what pulls at it.</summary>
struct ColumnLoad
{
    float mass;
    Vector3 moment, momentum, pull;

    /// <summary>Adds a body.</summary>
    internal void Add(float bodyMass, Vector3 position, Vector3 velocity, Vector3 acceleration)
    {
        mass += bodyMass;
        moment += position * bodyMass;
        momentum += velocity * bodyMass;
        pull += acceleration * bodyMass;
    }

    /// <summary>
    /// Whether it would come to rest over the contacts of a face if it turned about the face as a pendulum that stands on its head: where it is, and the way
    /// that its velocity takes it until it is slowed down to nothing, are within their hull.
    /// </summary>
    /// <param name="face">The face.</param>
    /// <param name="upper">Centre of its upper body.</param>
    internal readonly bool IsOver(in LoadSupport face, Vector3 upper)
    {
        var down = pull * (1 / mass);
        var strength = Exact.Length(down);
        if (!(strength > 0))
            return false;
        down *= 1 / strength;
        var center = moment * (1 / mass) - upper - face.Center;
        var height = MathHelper.Max(0, -Exact.Dot(center, down));
        var goal = center + momentum * (MathF.Sqrt(height / strength) / mass);
        // Along what pulls at it, into the plane of the face.
        goal += down * (-Exact.Dot(goal, face.Normal) / Exact.Dot(down, face.Normal));
        goal += face.Center;
        for (int i = 0; i < face.Count; ++i)
        {
            Vector3 a = face.Arms[i], b = face.Arms[(i + 1) % face.Count], c = face.Arms[(i + 2) % face.Count];
            if (IsWithin(goal - a, goal - b, goal - c, face.Normal))
                return true;
        }
        return false;
    }

    static bool IsWithin(Vector3 toA, Vector3 toB, Vector3 toC, Vector3 normal)
    {
        float a = Exact.Dot(Exact.Cross(toA, toB), normal), b = Exact.Dot(Exact.Cross(toB, toC), normal), c = Exact.Dot(Exact.Cross(toC, toA), normal);
        return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
    }
}
