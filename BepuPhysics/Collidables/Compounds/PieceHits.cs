using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Trees;

namespace BepuPhysics.Collidables;

/// <summary>Tells the handler of a compound about hits on one of its children, by the number of the piece in the compound.</summary>
/// <remarks>
/// It knows the handler by address. A type with the handler's type in it would become, with compounds in compounds, a type within itself at
/// each level: without an end for whoever compiles ahead of time.
/// </remarks>
unsafe struct PieceHits : IShapeRayHitHandler
{
    readonly void* handler;
    readonly delegate*<void*, int, bool> allow;
    readonly delegate*<void*, in RayData, ref float, float, Vector3, int, void> tell;

    PieceHits(void* handler, delegate*<void*, int, bool> allow, delegate*<void*, in RayData, ref float, float, Vector3, int, void> tell)
    {
        this.handler = handler;
        this.allow = allow;
        this.tell = tell;
    }

    /// <summary>Number in the compound of the child's first piece. A convex shape is its own piece of number zero.</summary>
    public int FirstPiece;

    /// <summary>Hits for a handler that stays where it is: a local variable.</summary>
    public static PieceHits For<THandler>(ref THandler handler) where THandler : struct, IShapeRayHitHandler =>
        new(Unsafe.AsPointer(ref handler), &Allow<THandler>, &Tell<THandler>);

    /// <summary>Whether the handler wants hits on a piece of the compound.</summary>
    public readonly bool AllowsPiece(int piece) => allow(handler, piece);

    readonly bool IShapeRayHitHandler.AllowTest(int childIndex) => allow(handler, FirstPiece + childIndex);

    readonly void IShapeRayHitHandler.OnRayHit(in RayData ray, ref float maximumT, float t, Vector3 normal, int childIndex) =>
        tell(handler, ray, ref maximumT, t, normal, FirstPiece + childIndex);

    static bool Allow<THandler>(void* handler, int piece) where THandler : struct, IShapeRayHitHandler =>
        Unsafe.AsRef<THandler>(handler).AllowTest(piece);

    static void Tell<THandler>(void* handler, in RayData ray, ref float maximumT, float t, Vector3 normal, int piece)
        where THandler : struct, IShapeRayHitHandler =>
        Unsafe.AsRef<THandler>(handler).OnRayHit(ray, ref maximumT, t, normal, piece);
}
