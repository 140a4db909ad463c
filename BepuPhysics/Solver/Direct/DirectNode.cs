using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace BepuPhysics.Constraints;

/// <summary>A joint of a structure that is solved at once.</summary>
struct DirectNode
{
    /// <summary>Its handle.</summary>
    public ConstraintHandle Handle;
    /// <summary>Id of its type.</summary>
    public int TypeId;
    /// <summary>Index in the type batch.</summary>
    public int Index;
    /// <summary>Its structure.</summary>
    public int Island;
    /// <summary>Number of its rows.</summary>
    public int RowCount;
    /// <summary>Number of its bodies.</summary>
    public int BodyCount;
    /// <summary>Place of the first row.</summary>
    public int FirstRow;
    /// <summary>Place of its Jacobian: a pair for each body of each row.</summary>
    public int Jacobian;
    /// <summary>Place of its block on the diagonal.</summary>
    public int Diagonal;
    /// <summary>First of the blocks below it, those of the joints that are left when it is eliminated, and their number.</summary>
    public int FirstBlock, BlockCount;
    /// <summary>First of the places that its elimination changes.</summary>
    public int FirstTarget;
    /// <summary>What bounds its impulse.</summary>
    public RowLimit Limit;
    /// <summary>Whether it is left out of the equations, with the impulse that it has: a limit that nothing leans on, a servo at its greatest force.</summary>
    public bool IsHeld;
    /// <summary>Greatest length of its impulse; of servos and motors only.</summary>
    public double MostImpulse;
    /// <summary>Places of its bodies among those of the plan.</summary>
    public DirectBodies Bodies;

    /// <summary>Whether it is a limit, a servo or a motor.</summary>
    internal readonly bool HasBounds => Limit != RowLimit.None;
}

/// <summary>A number for each body of a joint.</summary>
[InlineArray(Solver.MaximumBodiesPerConstraint)]
struct DirectBodies
{
    int first;
}

/// <summary>A structure of joints that is solved at once: ranges in the lists of the plan.</summary>
struct DirectIsland
{
    /// <summary>Its joints, in the order of elimination.</summary>
    public int FirstNode, EndNode;
    /// <summary>Its bodies, kinematic ones included.</summary>
    public int FirstBody, EndBody;
    /// <summary>What couples its joints.</summary>
    public int FirstCoupling, EndCoupling;
    /// <summary>Its numbers.</summary>
    public int FirstNumber, EndNumber;
    /// <summary>Its rows.</summary>
    public int FirstRow, EndRow;
    /// <summary>Whether its joints that hold both ways have loops, or several ways to the ground.</summary>
    public bool HasLoops;
    /// <summary>Whether there are limits, servos or motors among its joints.</summary>
    public bool HasBounds;
    /// <summary>Whether any of its joints asks to be solved at once; known where the solver chooses, when they have been looked at.</summary>
    public bool IsAskedFor;
}

/// <summary>A row of such a joint.</summary>
struct DirectRow
{
    /// <summary>J v that it is after, m/s or rad/s.</summary>
    public double Target;
    /// <summary>Softness, as part of the joint's own K; zero where it is rigid.</summary>
    public double Softness;
    /// <summary>The accumulated impulse.</summary>
    public double Impulse;
    /// <summary>What is asked for, then the change of the impulse.</summary>
    public double X;
    /// <summary>The pivot up to which it is left out.</summary>
    public double LeastPivot;
    /// <summary>One over the pivot, or zero where the rows before say all that this one does.</summary>
    public double InversePivot;
}

/// <summary>A block below the diagonal, in the column of the joint that is eliminated first.</summary>
struct DirectBlock
{
    /// <summary>The joint that is eliminated later.</summary>
    public int Joint;
    /// <summary>Place of its numbers, row by row of the later joint.</summary>
    public int Place;
}

/// <summary>A body that two joints have in common: what makes their block.</summary>
struct DirectCoupling
{
    /// <summary>Place of the block's numbers.</summary>
    public int Place;
    /// <summary>The joint that is eliminated later, and the one before.</summary>
    public int Later, Earlier;
    /// <summary>Which of their bodies it is.</summary>
    public int LaterSlot, EarlierSlot;
}

/// <summary>A linear and an angular part; the fourth number of each is zero.</summary>
struct DirectPair
{
    /// <summary>Of the centre of mass.</summary>
    public Vector256<double> Linear;
    /// <summary>About it, world axes.</summary>
    public Vector256<double> Angular;

    /// <summary>Product by numbers.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector256<double> Multiply(in DirectPair a, in DirectPair b) => a.Linear * b.Linear + a.Angular * b.Angular;

    /// <summary>Square of the angular part.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static double AngularLengthSquared(in DirectPair pair) => Sum(pair.Angular * pair.Angular);

    /// <summary>Sum of the numbers, always in this order.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static double Sum(Vector256<double> v) => v[0] + v[1] + (v[2] + v[3]);

    /// <summary>Adds a multiple.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal void Add(in DirectPair other, double factor)
    {
        Linear += other.Linear * factor;
        Angular += other.Angular * factor;
    }
}

/// <summary>A body of such a structure.</summary>
struct DirectBody
{
    /// <summary>Linear and angular velocity.</summary>
    public DirectPair Velocity;
    /// <summary>Columns of the inverse inertia, world axes.</summary>
    public Vector256<double> InverseInertiaX, InverseInertiaY, InverseInertiaZ;
    /// <summary>1/kg.</summary>
    public double InverseMass;
    /// <summary>Index in the active set, with the mark of a kinematic one.</summary>
    public int Reference;
}
