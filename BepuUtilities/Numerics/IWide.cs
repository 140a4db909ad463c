using System.Numerics;

namespace BepuUtilities;

/// <summary>
/// Marks a struct as the wide form of <typeparamref name="TScalar"/>: the same fields in the same order, every
/// <see cref="float"/> replaced by a <see cref="Vector{T}"/> of floats (and every <see cref="int"/> by one of ints).
/// <see cref="Lanes"/> relies on nothing else.
/// </summary>
public interface IWide<TScalar> where TScalar : unmanaged;
