using System.Numerics;
using System.Runtime.CompilerServices;

namespace BepuPhysics.Constraints.Contact;

/// <summary>One number per contact of a manifold.</summary>
[InlineArray(4)]
struct FourFloats
{
    float first;
}

/// <summary>One vector per contact of a manifold.</summary>
[InlineArray(4)]
struct FourVectors
{
    Vector3 first;
}

/// <summary>One row per contact of a manifold.</summary>
[InlineArray(4)]
struct FourRows
{
    ContactRow first;
}
