using BepuPhysics.Constraints;
using DemoTests.Quality;

namespace DemoTests.Compatibility;

/// <summary>A constraint of a game that does not check what it is given.</summary>
public struct UncheckedLimit : IOneBodyConstraintDescription<UncheckedLimit>
{
    /// <summary>Least height of the centre, m.</summary>
    public float MinimumHeight;
    /// <summary>Stiffness of the limit; the default is rigid.</summary>
    public SpringSettings SpringSettings;

    /// <inheritdoc/>
    public static int ConstraintTypeId => 101;

    /// <inheritdoc/>
    public static TypeProcessor CreateTypeProcessor() => new TypeProcessor<
        OneBody, HeightLimitWide, Rows1, JointConstraint<OneBody, HeightLimitWide, HeightLimitGeometry, Rows1, Rows1, HeightLimitJoint>>();
}
