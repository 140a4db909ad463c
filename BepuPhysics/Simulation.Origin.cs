using System;
using System.Numerics;

namespace BepuPhysics;

// Another origin of the world, for worlds that are larger than what floats can tell apart.
public sealed partial class Simulation
{
    /// <summary>Makes another point the origin of the world: all that was at p is at p - shift then, and nothing else changes.</summary>
    /// <remarks>
    /// Floats are exact to a millimetre within 8 km of the origin, and to .06 mm within one. A game whose world is larger moves the origin along with the
    /// player, in a frame in which it has come far, and moves what it draws by as much. Bodies, statics, targets of
    /// <see cref="Constraints.OneBodyLinearServo"/> and the bounds that queries look at are moved; what sleeps goes on sleeping, contacts keep their impulses,
    /// and nothing begins or ends to touch. What a body has moved by less than its position could hold is not lost: near the origin it is there.
    /// <para>
    /// Takes the time of going once over all bodies, statics and nodes of the trees; no memory. Moved by whole metres, what is at rest keeps its place to the
    /// last bit as long as it comes nearer to the origin.
    /// </para>
    /// <para>
    /// Not moved is what only the game knows: places in its own callbacks (the centre of a planet), in events of the last step and in snapshots, which bring
    /// the origin back that they were saved with. A constraint of a game's own that holds places says so (<see cref="Constraints.IJoint{TBodies, TPrestep,
    /// TGeometry, TRows, TMass}.HasPlaces"/>).
    /// </para>
    /// </remarks>
    /// <param name="shift">Where the new origin is, m.</param>
    /// <exception cref="ArgumentException">
    /// The shift is not finite or beyond <see cref="Limits.MaximumPosition"/>, or something would come to be; nothing was changed.
    /// </exception>
    /// <exception cref="InvalidOperationException">A step or a query is in progress.</exception>
    public void ShiftOrigin(Vector3 shift)
    {
        BodyChecks.Position(shift, nameof(shift));
        using var change = world.ChangeOutsideOfSteps("Simulation.ShiftOrigin");
        Bodies.CheckShift(shift);
        Statics.CheckShift(shift);
        Bodies.ShiftOrigin(shift);
        Statics.ShiftOrigin(shift);
        Solver.ShiftOrigin(shift);
        BroadPhase.ShiftOrigin(shift);
    }
}
