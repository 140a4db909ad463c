using System;

namespace BepuPhysics.Constraints.Contact;

/// <summary>Goes through some of all bundles of contacts, in the order in which they are swept: those of the fallback batch are not among them.</summary>
/// <param name="set">The constraints.</param>
/// <param name="start">The first of the bundles.</param>
/// <param name="end">One after the last.</param>
ref struct ContactBundles(ref ConstraintSet set, int start, int end)
{
    readonly ref ConstraintSet set = ref set;
    int batch;
    int typeBatch = -1;
    // Bundles of all type batches before this one.
    int passed;
    int bundleCount;

    /// <summary>Bundles of the present type batch that are among them.</summary>
    internal int First, End;

    /// <summary>The present type batch.</summary>
    internal readonly ref TypeBatch TypeBatch => ref set.Batches[batch].TypeBatches[typeBatch];

    /// <summary>Goes on to the next type batch that has any of them.</summary>
    internal bool MoveNext()
    {
        passed += bundleCount;
        bundleCount = 0;
        while (passed < end)
        {
            if (++typeBatch == set.Batches[batch].TypeBatches.Count)
            {
                typeBatch = -1;
                if (++batch == set.Batches.Count)
                    return false;
                continue;
            }
            bundleCount = CountOf(set.Batches[batch], typeBatch);
            First = Math.Max(start - passed, 0);
            End = Math.Min(end - passed, bundleCount);
            if (First < End)
                return true;
            passed += bundleCount;
            bundleCount = 0;
        }
        return false;
    }

    /// <summary>How many there are in all.</summary>
    internal static int Count(in ConstraintSet set)
    {
        int count = 0;
        for (int i = 0; i < set.Batches.Count; ++i)
        {
            for (int j = 0; j < set.Batches[i].TypeBatches.Count; ++j)
                count += CountOf(set.Batches[i], j);
        }
        return count;
    }

    static int CountOf(in ConstraintBatch batch, int typeBatch) =>
        batch.Kind == BatchKind.Coloured && batch.TypeBatches[typeBatch].TypeId < ConstraintTypeIds.ContactTypeCount
            ? batch.TypeBatches[typeBatch].BundleCount : 0;
}
