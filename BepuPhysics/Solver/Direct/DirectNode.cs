using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.Constraints;

/// <summary>A joint of a structure that is solved at once, and of those that are solved beside it.</summary>
struct DirectNode
{
    /// <summary>Id of its type.</summary>
    public int TypeId;
    /// <summary>Its structures.</summary>
    public int Island;
    /// <summary>Its place in the own order of its structure.</summary>
    public int Place;
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
    /// <summary>Whether its rows see linear velocities: those of joints about axes do not.</summary>
    public bool SeesLinear;
    /// <summary>Places of its bodies among those of the plan.</summary>
    public BodyNumbers Bodies;

    /// <summary>Whether it is a limit, a servo or a motor.</summary>
    internal readonly bool HasBounds => Limit != RowLimit.None;
}

/// <summary>A joint of one structure.</summary>
struct DirectMember
{
    /// <summary>Its handle.</summary>
    public ConstraintHandle Handle;
    /// <summary>Index in the type batch.</summary>
    public int Index;
}

/// <summary>A number for each body of a constraint.</summary>
[InlineArray(Solver.MaximumBodiesPerConstraint)]
struct BodyNumbers
{
    int first;
}

/// <summary>A flag for each of the structures that are solved side by side.</summary>
[InlineArray(DirectPlan.MostLanes)]
struct DirectFlags
{
    bool first;
}

/// <summary>A structure of joints that is solved at once, and equal ones that are solved beside it: ranges in the lists of the plan.</summary>
struct DirectIsland
{
    /// <summary>How many structures there are, at most <see cref="DirectPlan.Lanes"/>.</summary>
    public int MemberCount;
    /// <summary>In how many lanes they are solved.</summary>
    public readonly int Lanes => MemberCount == 1 ? 1 : MemberCount <= DirectPlan.FourLanes ? DirectPlan.FourLanes : DirectPlan.MostLanes;
    /// <summary>Its joints, in the order of elimination.</summary>
    public int FirstNode, EndNode;
    /// <summary>Its bodies, kinematic ones included.</summary>
    public int FirstBody, EndBody;
    /// <summary>Number of those that are dynamic: the first ones.</summary>
    public int DynamicCount;
    /// <summary>Its numbers.</summary>
    public int FirstNumber, EndNumber;
    /// <summary>Its rows.</summary>
    public int FirstRow, EndRow;
    /// <summary>Its blocks below the diagonal.</summary>
    public int FirstBlock, EndBlock;
    /// <summary>Pairs of its Jacobians.</summary>
    public int FirstPair, EndPair;
    /// <summary>Where in memory its equations are.</summary>
    public int Memory;
    /// <summary>Whether its joints that hold both ways have loops, or several ways to the ground.</summary>
    public bool HasLoops;
    /// <summary>Whether there are limits, servos or motors among its joints.</summary>
    public bool HasBounds;
    /// <summary>
    /// Whether any of its joints asks to be solved at once, for each structure; known where the solver chooses, when they have been looked at.
    /// </summary>
    public DirectFlags IsAskedFor;
}

/// <summary>A block below the diagonal, in the column of the joint that is eliminated first.</summary>
struct DirectBlock
{
    /// <summary>The joint that is eliminated later.</summary>
    public int Joint;
    /// <summary>Place of its numbers, row by row of the later joint.</summary>
    public int Place;
    /// <summary>Number of the later joint's rows, and place of the first of them.</summary>
    public int RowCount, FirstRow;
    /// <summary>What it is made of; nothing where only an elimination makes it.</summary>
    public int FirstCoupling, EndCoupling;
}

/// <summary>A body that two joints have in common: what makes their block.</summary>
struct DirectCoupling
{
    /// <summary>Which of their bodies it is.</summary>
    public int LaterSlot, EarlierSlot;
}

/// <summary>What is known of a joint while its structure is factored.</summary>
struct DirectState
{
    /// <summary>A bit for each structure in which it is not held.</summary>
    public int Free;
    /// <summary>Whether its pivots, and all blocks below them, are worked out.</summary>
    public bool IsColumn;
    /// <summary>Whether its blocks in the columns of joints before it are.</summary>
    public bool IsRow;
    /// <summary>Number of the blocks below it that any structure has.</summary>
    public int LiveCount;
}

/// <summary>Whether a joint is left out of the equations, with the impulse that it has.</summary>
struct DirectHold<TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
{
    /// <summary>Mask of the structures in which it is: a limit that nothing leans on, a servo at its greatest force.</summary>
    public TNumbers IsHeld;
    /// <summary>Greatest length of its impulse; of servos and motors only.</summary>
    public TNumbers MostImpulse;
}

/// <summary>A row of such a joint.</summary>
struct DirectRow<TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
{
    /// <summary>J v that it is after, m/s or rad/s.</summary>
    public TNumbers Target;
    /// <summary>Softness, as part of the joint's own K; zero where it is rigid.</summary>
    public TNumbers Softness;
    /// <summary>The accumulated impulse.</summary>
    public TNumbers Impulse;
    /// <summary>What is asked for, then the change of the impulse.</summary>
    public TNumbers X;
    /// <summary>The pivot up to which it is left out.</summary>
    public TNumbers LeastPivot;
    /// <summary>One over the pivot, or zero where the rows before say all that this one does.</summary>
    public TNumbers InversePivot;
}

/// <summary>A linear and an angular part.</summary>
struct DirectPair<TVectors, TNumbers> where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
{
    /// <summary>Of the centre of mass.</summary>
    public TVectors Linear;
    /// <summary>About it, world axes.</summary>
    public TVectors Angular;

    /// <summary>Product by numbers.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static TVectors Multiply(in DirectPair<TVectors, TNumbers> a, in DirectPair<TVectors, TNumbers> b) =>
        a.Linear * b.Linear + a.Angular * b.Angular;

    /// <summary>Adds a multiple.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal void Add(in DirectPair<TVectors, TNumbers> other, TNumbers factor)
    {
        Linear += other.Linear * factor;
        Angular += other.Angular * factor;
    }

    /// <summary>Adds a multiple where a mask is set, of which there is any.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal void Add(in DirectPair<TVectors, TNumbers> other, TNumbers factor, TNumbers mask)
    {
        Linear = TVectors.Choose(mask, Linear + other.Linear * factor, Linear);
        Angular = TVectors.Choose(mask, Angular + other.Angular * factor, Angular);
    }
}

/// <summary>A body of such a structure.</summary>
struct DirectBody<TVectors, TNumbers> where TVectors : unmanaged, IVectors<TVectors, TNumbers> where TNumbers : unmanaged, INumbers<TNumbers>
{
    /// <summary>Linear and angular velocity.</summary>
    public DirectPair<TVectors, TNumbers> Velocity;
    /// <summary>Columns of the inverse inertia, world axes.</summary>
    public TVectors InverseInertiaX, InverseInertiaY, InverseInertiaZ;
    /// <summary>1/kg.</summary>
    public TNumbers InverseMass;

    /// <summary>The inverse inertia in a structure, world axes.</summary>
    internal Symmetric3x3 ReadInertia(int lane)
    {
        var x = DirectLane.Read<TVectors, TNumbers>(ref InverseInertiaX, lane);
        var y = DirectLane.Read<TVectors, TNumbers>(ref InverseInertiaY, lane);
        var z = DirectLane.Read<TVectors, TNumbers>(ref InverseInertiaZ, lane);
        return new() { XX = x.X, YX = x.Y, YY = y.Y, ZX = x.Z, ZY = y.Z, ZZ = z.Z };
    }

    /// <summary>Sets the inverse inertia in a structure, world axes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal void WriteInertia(int lane, in Symmetric3x3 tensor)
    {
        DirectLane.Write<TVectors, TNumbers>(ref InverseInertiaX, lane, tensor.XX, tensor.YX, tensor.ZX);
        DirectLane.Write<TVectors, TNumbers>(ref InverseInertiaY, lane, tensor.YX, tensor.YY, tensor.ZY);
        DirectLane.Write<TVectors, TNumbers>(ref InverseInertiaZ, lane, tensor.ZX, tensor.ZY, tensor.ZZ);
    }
}
