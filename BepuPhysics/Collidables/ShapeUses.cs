using BepuUtilities;

namespace BepuPhysics.Collidables;

/// <summary>Counts bodies or statics that get their shapes.</summary>
readonly struct UsesBegin(Shapes shapes) : IForEach<TypedIndex>
{
    public void LoopBody(TypedIndex shape) => shapes.BeginUse(shape);
}

/// <summary>Counts bodies or statics that lose their shapes.</summary>
readonly struct UsesEnd(Shapes shapes) : IForEach<TypedIndex>
{
    public void LoopBody(TypedIndex shape) => shapes.EndUse(shape);
}
