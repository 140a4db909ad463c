namespace Demos.Towers;

/// <summary>What a structure did.</summary>
/// <param name="Structure">Its name.</param>
/// <param name="Parts">Number of its parts.</param>
/// <param name="FellAt">When a part had lost a tenth of its height, s; null where none did.</param>
/// <param name="HeightLost">How much lower the topmost part is at the end, m.</param>
/// <param name="Lean">Farthest way of a part to the side at the end, m.</param>
/// <param name="MillisecondsPerStep">Mean time of a step.</param>
sealed record TowerResult(string Structure, int Parts, float? FellAt, float HeightLost, float Lean, double MillisecondsPerStep)
{
    /// <summary>Whether it stood to the end.</summary>
    public bool Stands => FellAt is null;
}
