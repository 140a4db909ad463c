using System.Runtime.CompilerServices;

namespace BepuPhysics.Constraints.Contact;

/// <summary>One number per contact of a manifold.</summary>
[InlineArray(4)]
struct FourFloats
{
    float first;
}
