using System.Numerics;
using BepuPhysics;
using BepuPhysics.Constraints;
using BepuUtilities;

namespace DemoTests.LoadPath;

/// <summary>Looks at the kinetic energy of all bodies before or after the load path.</summary>
/// <param name="bodies">The bodies.</param>
/// <param name="floor">Along with whom the observer moves; nobody if that is not said.</param>
sealed class KineticEnergy(Bodies bodies, BodyHandle? floor = null) : ISolverStage
{
    /// <summary>Of the last substep, J.</summary>
    public double Last { get; private set; }

    public int GetBlockCount(SolverPoint point) => point == SolverPoint.LastAfterWarmStart ? 1 : 0;

    public void Execute(SolverPoint point, in Substep substep, int block)
    {
        Last = 0;
        ref var set = ref bodies.ActiveSet;
        var observer = floor is { } handle ? bodies[handle].Velocity.Linear : default;
        for (int i = 0; i < set.Count; ++i)
        {
            if (set.WorldInertias[i].InverseMass == 0)
                continue;
            var velocity = set.MotionStates[i].Velocity;
            var inertia = Symmetric3x3.Invert(set.WorldInertias[i].InverseInertiaTensor);
            Last += ((velocity.Linear - observer).LengthSquared() / set.WorldInertias[i].InverseMass +
                Vector3.Dot(velocity.Angular, inertia * velocity.Angular)) / 2.0;
        }
    }
}
