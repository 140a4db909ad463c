namespace Benchmarks.Pairs.Shared;

/// <summary>The shapes whose pairs are measured, in the order of the engines' type ids.</summary>
enum PairShapeKind
{
    Sphere,
    Capsule,
    Box,
    Triangle,
    Cylinder,
    Hull14,
    Hull32,
}
