using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Makes sets of children agree, side by side: each round looks at the tests that all of them want next, so that bundles are full.</summary>
/// <remarks>A set changes nothing of another. Which of them are worked on together changes no bit.</remarks>
static class SeamRounds
{
    /// <summary>Works on all sets until each is done.</summary>
    /// <param name="memory">The sets.</param>
    /// <param name="registry">The tasks that test pairs.</param>
    /// <param name="pool">Source of memory.</param>
    public static unsafe void Run(ref SeamMemory memory, CollisionTaskRegistry registry, BufferPool pool)
    {
        if (memory.Touching.Count > 0)
            TriangleNeighbours.FindDirections(ref memory, pool);
        while (true)
        {
            for (int i = 0; i < memory.Sets.Count; ++i)
                Advance(ref memory, i, registry, pool);
            if (memory.Tests.Count + memory.Moved.Count == 0)
                break;
            memory.Tests.Execute();
            memory.Moved.Execute(memory.Sets.Span.Memory, registry);
        }
        LayOnPlanes(ref memory, pool);
    }

    // In two rounds more, for those that ask for them.
    static void LayOnPlanes(ref SeamMemory memory, BufferPool pool)
    {
        ref var tests = ref memory.Tests;
        for (int i = 0; i < memory.Sets.Count; ++i)
            FaceCorners.AddPlane(ref tests, View(ref memory, i), i, pool);
        if (tests.Count == 0)
            return;
        tests.Execute();
        memory.Planes.Count = 0;
        memory.Planes.EnsureCapacity(tests.FoundCount, pool);
        for (int i = 0; i < tests.FoundCount; ++i)
            memory.Planes.AddUnsafely(tests[i]);
        foreach (ref var plane in memory.Planes.AsSpan())
        {
            var first = tests.Count;
            FaceCorners.AddBalls(ref tests, View(ref memory, plane.Owner), plane, pool);
            memory.Sets[plane.Owner].Tests = new(first, tests.Count - first);
        }
        tests.Execute();
        foreach (ref var plane in memory.Planes.AsSpan())
            FaceCorners.Take(tests, View(ref memory, plane.Owner), plane);
    }

    static SeamView View(ref SeamMemory memory, int number) => new(ref memory.Sets[number], memory.Touching.AsSpan());

    static unsafe void Advance(ref SeamMemory memory, int number, CollisionTaskRegistry registry, BufferPool pool)
    {
        ref var set = ref memory.Sets[number];
        var (first, firstMoved) = (memory.Tests.Count, memory.Moved.Count);
        while (set.Stage != SeamStage.Done && memory.Tests.Count == first && memory.Moved.Count == firstMoved)
        {
            var view = new SeamView(ref set, memory.Touching.AsSpan());
            if (set.Stage == SeamStage.Foreseen)
                ForeseenContacts.Advance(ref memory.Moved, view, number, memory.Sets.Span.Memory, registry, pool);
            else
                Advance(ref memory, view, pool);
            set.Tests = new(first, memory.Tests.Count - first);
        }
    }

    static void Advance(ref SeamMemory memory, in SeamView view, BufferPool pool)
    {
        ref var set = ref view.Set;
        switch (set.Stage)
        {
            case SeamStage.DirectionsOfB or SeamStage.DirectionsOfA:
                TriangleNeighbours.AddDirections(ref memory, view, set.Stage == SeamStage.DirectionsOfA, pool);
                ++set.Stage;
                break;
            case SeamStage.NormalsOfB or SeamStage.NormalsOfA:
                TriangleNeighbours.Take(memory.Tests, view);
                ++set.Stage;
                break;
            case SeamStage.Order:
                TriangleNeighbours.Settle(view);
                ChildAgreement.Begin(view);
                break;
            default:
                ChildAgreement.Advance(ref memory.Tests, view, pool);
                break;
        }
    }
}
