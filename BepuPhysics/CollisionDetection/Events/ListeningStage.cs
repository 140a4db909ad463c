using System;
using System.Numerics;
using System.Runtime.CompilerServices;
using BepuPhysics.Constraints;
using BepuPhysics.Constraints.Contact;
using BepuUtilities;
using BepuUtilities.Collections;
using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Sums up what listened contacts push in the substeps of a step. Reads what the solver does, and changes nothing.</summary>
// Accumulated impulses are those of one substep. What a substep has made of them, relaxation included, is read when the next has integrated
// its bodies, before its warm start scales them, and for the last one when the bodies have moved. All lanes of a bundle are read, whether they are
// listened to or not: that is less work than to pick out one or two.
sealed unsafe class ListeningStage(Solver solver, Bodies bodies, BufferPool pool) : ISolverStage
{
    const int BundlesPerBlock = 16;
    const int BodiesPerBlock = 512;
    const int ContactTypes = 2 * ConstraintTypeIds.ContactTwoBody;

    /// <summary>Speed of approach from which on a touch is a hit.</summary>
    internal float HitSpeed;

    // Of this step, in the order in which manifolds were placed.
    QuickList<ListenedBundle> bundles;
    // Of each lane of these, bits of ListenedState.
    Buffer<int> states;
    // Of all awake bodies, where they were when collisions were detected.
    Buffer<Vector3> centers;
    // The first bundle of each type of each batch, counted through all that have contacts; and for each of these, the bundle of ours, or -1.
    Buffer<int> firstBundles;
    Buffer<int> ours;
    // For each bundle of ours, whether somebody asks for impulses whatever it does; a byte.
    Buffer<byte> measured;

    bool ISolverStage.ChangesVelocities => false;

    int BundleBlocks => BlocksOf(bundles.Count, BundlesPerBlock);

    bool ISolverStage.BeginStep() => bundles.Count > 0;

    int ISolverStage.GetBlockCount(SolverPoint point) => point switch
    {
        SolverPoint.BeforeSubsteps => BundleBlocks + BlocksOf(bodies.Awake.Count, BodiesPerBlock),
        SolverPoint.AfterIntegration or SolverPoint.AfterSubsteps => BundleBlocks,
        _ => 0,
    };

    void ISolverStage.Execute(SolverPoint point, in Substep substep, int block)
    {
        if (block >= BundleBlocks)
        {
            NoteCenters(block - BundleBlocks);
            return;
        }
        var rows = new SolverBodies(bodies.Awake);
        var end = Math.Min(bundles.Count, (block + 1) * BundlesPerBlock);
        for (int i = block * BundlesPerBlock; i < end; ++i)
        {
            ref var bundle = ref bundles[i];
            ref var state = ref Unsafe.AsRef<Vector<int>>(states.Memory + i * Vector<int>.Count);
            if (point == SolverPoint.BeforeSubsteps)
                state = bundle.Begin(rows, HitSpeed, measured[i] != 0);
            else if (point == SolverPoint.AfterIntegration && substep.Index == 0)
                state |= bundle.Comes ? bundle.Foresee(rows, HitSpeed, substep.InverseDt) : default;
            else if (bundle.IsMeasured)
                bundle.Sum();
            if (point == SolverPoint.AfterSubsteps)
                state |= bundle.End(rows, HitSpeed);
        }
    }

    void NoteCenters(int block)
    {
        var motions = bodies.Awake.MotionStates;
        var end = Math.Min(bodies.Awake.Count, (block + 1) * BodiesPerBlock);
        for (int i = block * BodiesPerBlock; i < end; ++i)
            centers[i] = motions[i].Pose.Position;
    }

    /// <summary>Makes ready for manifolds to be placed.</summary>
    internal void BeginPlaces()
    {
        bundles.Count = 0;
        ref var batches = ref solver.ActiveSet.Batches;
        MakeRoom(ref firstBundles, batches.Count * ContactTypes);
        int count = 0;
        for (int i = 0; i < batches.Count; ++i)
        {
            ref var typeBatches = ref batches[i].TypeBatches;
            for (int j = 0; j < typeBatches.Count; ++j)
            {
                if (typeBatches[j].TypeId >= ContactTypes)
                    continue;
                firstBundles[i * ContactTypes + typeBatches[j].TypeId] = count;
                count += typeBatches[j].BundleCount;
            }
        }
        MakeRoom(ref ours, count);
        ours.AsSpan()[..count].Fill(-1);
        MakeRoom(ref measured, count);
    }

    /// <summary>Finds the lane of a manifold.</summary>
    /// <returns>Whether its constraint is there and awake.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal bool Place(ref ListenedManifold manifold, bool isMeasured)
    {
        if (!solver.ConstraintExists(manifold.Constraint))
            return false;
        ref var location = ref solver.Locations[manifold.Constraint.Slot];
        if (location.SetIndex != 0)
            return false;
        var (bundle, lane) = Math.DivRem((uint)location.IndexInTypeBatch, (uint)Vector<float>.Count);
        var index = ours[firstBundles[location.BatchIndex * ContactTypes + location.TypeId] + (int)bundle];
        if (index < 0)
            index = Add(location, (int)bundle);
        if (isMeasured)
            measured[index] = 1;
        manifold.Lane = index * Vector<float>.Count + (int)lane;
        manifold.ContactCount = ConstraintTypeIds.ContactCount(location.TypeId);
        return true;
    }

    /// <summary>Sums up what a manifold that was placed pushes, whatever it does.</summary>
    internal void Measure(in ListenedManifold manifold) => measured[manifold.Lane / Vector<float>.Count] = 1;

    [MethodImpl(MethodImplOptions.NoInlining)]
    int Add(in ConstraintLocation location, int bundle)
    {
        var index = bundles.Count;
        ours[firstBundles[location.BatchIndex * ContactTypes + location.TypeId] + bundle] = index;
        measured[index] = 0;
        ref var typeBatch = ref solver.TypeBatchAt(location);
        var processor = solver.Processor(location.TypeId);
        if (!bundles.Span.Allocated)
            bundles = new QuickList<ListenedBundle>(64, pool);
        ref var added = ref bundles.Allocate(pool);
        added.Prestep = (Vector<float>*)typeBatch.Prestep.Memory + bundle * processor.PrestepFloats;
        added.Impulses = (Vector<float>*)typeBatch.AccumulatedImpulses.Memory + bundle * processor.ImpulseFloats;
        added.References = (Vector<int>*)typeBatch.BodyReferences.Memory + bundle * processor.BodiesPerConstraint;
        (added.ContactCount, added.BodyCount) = (ConstraintTypeIds.ContactCount(location.TypeId), processor.BodiesPerConstraint);
        return index;
    }

    /// <summary>Makes room for what manifolds that were placed will have.</summary>
    internal void EndPlaces()
    {
        if (bundles.Count == 0)
            return;
        MakeRoom(ref states, bundles.Count * Vector<int>.Count);
        MakeRoom(ref centers, bodies.Awake.Count);
    }

    /// <summary>Bits of <see cref="ListenedState"/>, when the solver has ended.</summary>
    internal int StateOf(in ListenedManifold manifold) => states[manifold.Lane];

    /// <summary>Where the bodies of a manifold were when collisions were detected.</summary>
    internal ListenedPlace PlaceOf(in ListenedManifold manifold)
    {
        ref var bundle = ref BundleOf(manifold, out var lane);
        var a = centers[GatherScatter.Get(ref bundle.References[0], lane) & EncodedBody.IndexMask];
        return new()
        {
            CenterOfA = a,
            OffsetB = bundle.BodyCount > 1 ? centers[GatherScatter.Get(ref bundle.References[1], lane) & EncodedBody.IndexMask] - a : default,
        };
    }

    /// <summary>Adds what a manifold has pushed, and how fast it approached.</summary>
    internal void AddTo(ref ContactEvent told, in ListenedManifold manifold)
    {
        ref var bundle = ref BundleOf(manifold, out var lane);
        told.ApproachSpeed = MathHelper.Max(told.ApproachSpeed, GatherScatter.Get(ref bundle.ApproachSpeed, lane));
        if (!bundle.IsMeasured)
            return;
        for (int i = 0; i < manifold.ContactCount; ++i)
            told.Impulse += GatherScatter.Get(ref bundle.Normals[i], lane);
        told.FrictionImpulse += Read(ref bundle.Friction, lane);
    }

    /// <summary>Writes the contacts of a manifold, when the solver has ended.</summary>
    internal void Describe(in ListenedManifold manifold, Vector3 centerOfA, in FeatureIds features, ChildIds children, Span<EventContact> contacts)
    {
        ref var bundle = ref BundleOf(manifold, out var lane);
        var normal = Read(ref *(Vector3Wide*)(bundle.Prestep + ContactPrestepLayout.Normal(bundle.ContactCount)), lane);
        for (int i = 0; i < contacts.Length; ++i)
        {
            contacts[i] = new()
            {
                Position = centerOfA + Read(ref ((ContactPrestepWide*)bundle.Prestep)[i].OffsetA, lane),
                Normal = normal,
                Depth = GatherScatter.Get(ref bundle.Depths[i], lane),
                Impulse = GatherScatter.Get(ref bundle.Normals[i], lane),
                FeatureId = features[i],
                ChildA = children.A,
                ChildB = children.B,
            };
        }
    }

    internal void Release()
    {
        bundles.DisposeIfTaken(pool);
        pool.ReturnIfTaken(ref states);
        pool.ReturnIfTaken(ref centers);
        pool.ReturnIfTaken(ref firstBundles);
        pool.ReturnIfTaken(ref ours);
        pool.ReturnIfTaken(ref measured);
        Abandon();
    }

    internal void Abandon()
    {
        bundles = default;
        states = firstBundles = ours = default;
        centers = default;
        measured = default;
    }

    /// <summary>Forgets the step.</summary>
    internal void Forget() => bundles.Count = 0;

    ref ListenedBundle BundleOf(in ListenedManifold manifold, out int lane)
    {
        lane = manifold.Lane % Vector<float>.Count;
        return ref bundles[manifold.Lane / Vector<float>.Count];
    }

    static Vector3 Read(ref Vector3Wide wide, int lane) =>
        new(GatherScatter.Get(ref wide.X, lane), GatherScatter.Get(ref wide.Y, lane), GatherScatter.Get(ref wide.Z, lane));

    static int BlocksOf(int count, int perBlock) => (count + perBlock - 1) / perBlock;

    // What was in it is not kept.
    void MakeRoom<T>(ref Buffer<T> buffer, int count) where T : unmanaged
    {
        if (buffer.Length < count)
            pool.ResizeToAtLeast(ref buffer, count, 0);
    }
}
