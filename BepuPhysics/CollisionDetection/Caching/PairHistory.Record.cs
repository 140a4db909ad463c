using System.Numerics;
using System.Runtime.CompilerServices;
using BepuUtilities;

namespace BepuPhysics.CollisionDetection;

unsafe partial struct PairHistory
{
    /// <summary>The first row of the histories of a bundle.</summary>
    struct PoseRow
    {
        public QuaternionWide Orientation;
        public Vector3Wide Offset;
        public Vector<float> Clearance;
    }

    /// <summary>Records the outcome of the tests of a bundle.</summary>
    /// <param name="histories">All histories.</param>
    /// <param name="indices">History of each lane; negative where there is none.</param>
    /// <param name="pose">Poses of the tests.</param>
    /// <param name="flipMask">Lanes whose A is the caller's B: histories are told in the order of the caller.</param>
    /// <param name="speculativeMargin">Margins of the tests.</param>
    /// <param name="measures">What the tests know besides.</param>
    /// <param name="found">Contacts, as they were found.</param>
    /// <param name="leastCarriedCount">Number of contacts from which on they may be carried along.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static void Record<TContacts>(PairHistory* histories, Vector<int> indices, in PairPoseWide pose, Vector<int> flipMask,
        Vector<float> speculativeMargin, in PairMeasuresWide measures, ref ConvexManifoldWide<TContacts> found, int leastCarriedCount)
        where TContacts : unmanaged, IFew<ContactWide>
    {
        var recordedMask = Vector.GreaterThanOrEqual(indices, Vector<int>.Zero);
        var count = Vector<int>.Zero;
        var contactMask = Vector<int>.Zero;
        for (int i = 0; i < TContacts.Count; ++i)
        {
            var exists = found.Contacts[i].Exists;
            count -= exists;
            contactMask |= exists & new Vector<int>(1 << i);
        }
        var isApart = Vector.Equals(count, Vector<int>.Zero);
        var isCarried = Vector.GreaterThanOrEqual(count, new Vector<int>(leastCarriedCount));
        var aIsLarger = Vector.GreaterThan(measures.ReachA, measures.ReachB);
        var toLarger = QuaternionWide.Conjugate(QuaternionWide.Select(aIsLarger, pose.OrientationA, pose.OrientationB));

        // The same operations in the same order as in RetestBound.Holds: a pair that has not moved has the pose that was recorded.
        PoseRow row;
        row.Orientation = QuaternionWide.Concatenate(QuaternionWide.Select(aIsLarger, pose.OrientationB, pose.OrientationA), toLarger);
        row.Offset = toLarger * Vector3Wide.Select(aIsLarger, pose.OffsetB, -pose.OffsetB);
        row.Clearance = Wide.Select(
            isApart, -measures.Depth - (measures.ReachA + measures.ReachB) * new Vector<float>(RetestBound.Rounding), speculativeMargin);
        Transpose.Scatter(Unsafe.As<PoseRow, Rows8>(ref row), (float*)histories, Stride, indices);
        if ((isCarried & recordedMask) != Vector<int>.Zero)
            RecordContacts(histories, indices, pose, flipMask, aIsLarger, toLarger, ref found);

        var remaining = (isApart | isCarried) & new Vector<int>(RetestBound.Lifetime);
        var reach = Wide.Select(aIsLarger, measures.ReachB, measures.ReachA);
        var callersAIsLarger = aIsLarger ^ flipMask;
        var isSlow = Vector.GreaterThan(measures.Evaluations, new Vector<int>(QuickEvaluations));
        for (int lane = 0; lane < Vector<float>.Count; ++lane)
        {
            if (indices[lane] < 0)
                continue;
            ref var history = ref histories[indices[lane]];
            history.bound.Reach = reach[lane];
            history.bound.Remaining = (short)remaining[lane];
            history.bound.ContactMask = (byte)contactMask[lane];
            history.bound.AIsLarger = callersAIsLarger[lane] != 0;
            history.isSlow = isSlow[lane] != 0;
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    static void RecordContacts<TContacts>(PairHistory* histories, Vector<int> indices, in PairPoseWide pose, Vector<int> flipMask,
        Vector<int> aIsLarger, in QuaternionWide toLarger, ref ConvexManifoldWide<TContacts> found)
        where TContacts : unmanaged, IFew<ContactWide>
    {
        Unsafe.SkipInit(out CarriedContactsWide rows);
        var axes = Matrix3x3Wide.FromQuaternion(toLarger);
        var normal = Matrix3x3Wide.TransposeTimes(axes, found.Normal);
        rows.Normal = Vector3Wide.Select(flipMask, -normal, normal);
        var center = Vector3Wide.Select(aIsLarger, pose.OffsetB, Vector3Wide.Zero);
        for (int i = 0; i < TContacts.Count; ++i)
        {
            ref var contact = ref found.Contacts[i];
            rows.Positions[i] = Matrix3x3Wide.TransposeTimes(axes, contact.OffsetA - center);
            rows.Depths[i] = contact.Depth;
            rows.Features[i] = contact.FeatureId;
        }
        rows.Padding = Vector<float>.Zero;
        ref var source = ref Unsafe.As<CarriedContactsWide, Rows8>(ref rows);
        for (int i = 0; i < sizeof(CarriedContactsWide) / sizeof(Rows8); ++i)
            Transpose.Scatter(Unsafe.Add(ref source, i), (float*)&histories->contacts + i * Rows8.Count, Stride, indices);
    }
}
